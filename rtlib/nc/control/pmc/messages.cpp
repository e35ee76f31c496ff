// Changes of messages, looked for in every slot (see messages.h).
#include "rtlib/nc/control/pmc/messages.h"

namespace rung::nc {

bool PmcMessages::isAsSeen(const uint8_t* block, const Showing& showing) const noexcept {
  if (!hasSeen_ || showing != seenShowing_) return false;
  const uint8_t* seen = seen_.data();
  for (const Piece& piece : places_->pieces) {
    if (std::memcmp(block + piece.offset, seen, piece.size()) != 0) return false;
    seen += piece.size();
  }
  return true;
}

void PmcMessages::see(const uint8_t* block, const Showing& showing) noexcept {
  uint8_t* seen = seen_.data();
  for (const Piece& piece : places_->pieces) {
    std::memcpy(seen, block + piece.offset, piece.size());
    seen += piece.size();
  }
  hasSeen_ = true;
  seenShowing_ = showing;
}

uint8_t PmcMessages::bitsOf(const runtime::Instance& instance, const Showing& showing, uint32_t byte) const noexcept {
  return showing.display && byte < places_->bytes ? instance.memory().readByte(places_->area, byte) : uint8_t{0};
}

// A message that continues ends, too, if another program or another language gives it another number or text.
bool PmcMessages::nextChange(const runtime::Instance& instance, const Showing& showing, bool begins,
                             rung_message& message) noexcept {
  for (uint32_t byte = 0; byte < kMostBytes; ++byte) {
    if (!begins && reported_[byte] == 0) continue;
    const uint8_t bits = bitsOf(instance, showing, byte);
    uint8_t left = begins ? bits & static_cast<uint8_t>(~reported_[byte]) : reported_[byte];
    for (; left != 0; left &= static_cast<uint8_t>(left - 1)) {
      const auto bit = static_cast<uint32_t>(std::countr_zero(left));
      Known& reported = reportedAs_[8 * byte + bit];
      const Known now = known(8 * byte + bit + 1, showing.shift);
      const bool continues = (bits >> bit & 1) != 0 && now == reported;
      if (begins ? now.number == 0 : continues) continue;
      if (begins) reported = now;
      reported_[byte] = static_cast<uint8_t>(reported_[byte] ^ 1u << bit);
      message = {.op = begins ? RUNG_MESSAGE_SHOW : RUNG_MESSAGE_CLEAR, .number = reported.number};
      if (isListed()) message.value = reported.key;
      return true;
    }
  }
  return false;
}

// Ends come first: the number of a message that ends may be that of one that begins.
bool PmcMessages::nextChange(const runtime::Instance& instance, rung_message& message) noexcept {
  if (places_ == nullptr) return false;
  const Showing now = showing(instance);
  if (isAsSeen(instance.block().data(), now)) return false;
  if (nextChange(instance, now, false, message) || nextChange(instance, now, true, message)) return true;
  see(instance.block().data(), now);
  return false;
}

void PmcMessages::writeStates(const runtime::Instance& instance) const noexcept {
  if (places_ == nullptr || places_->states.empty()) return;
  const Showing now = showing(instance);
  for (const uint32_t byte : places_->states) {
    uint8_t shown = bitsOf(instance, now, byte);
    for (uint32_t bit = 0; bit < 8; ++bit)
      if (known(8 * byte + bit + 1, now.shift).number == 0) shown = static_cast<uint8_t>(shown & ~(1u << bit));
    instance.memory().writeByte(places_->area, kFirstState + byte, shown);
  }
}

bool PmcMessages::shows(const runtime::Instance& instance, std::span<const ShownMessage> these) const noexcept {
  size_t count = 0;
  const bool same = forShown(instance, [&](uint32_t key, uint32_t number) {
    if (count == these.size() || these[count].number != number) return false;
    return these[count++].value == (isListed() ? key : 0);
  });
  return same && count == these.size();
}

} // namespace rung::nc

// Changes of messages, looked for in every slot (see messages.h).
#include "rtlib/nc/control/pmc/messages.h"

namespace rung::nc {

void PmcMessages::Look::take(const uint8_t* block, std::span<const Piece> pieces, const Showing& showing) noexcept {
  uint8_t* bytes = bytes_.data();
  for (const Piece& piece : pieces) {
    std::memcpy(bytes, block + piece.offset, piece.size());
    bytes += piece.size();
  }
  has_ = true;
  showing_ = showing;
}

uint8_t PmcMessages::bitsOf(const runtime::Instance& instance, const Showing& showing, uint32_t byte) const noexcept {
  return showing.display && byte < places_->bytes ? instance.memory().readByte(places_->area, byte) : uint8_t{0};
}

// Whether none of eight bytes, the first of which has this number, is that of a message reported as shown.
bool PmcMessages::isNoneReported(uint32_t byte) const noexcept {
  if (byte % kWord != 0) return false;
  uint64_t word = 0;
  std::memcpy(&word, &reported_[byte], sizeof word);
  return word == 0;
}

// A message that continues ends, too, if another program or another language gives it another number or text.
bool PmcMessages::findChange(const runtime::Instance& instance, const Showing& showing, bool begins,
                             rung_message& message) noexcept {
  const uint32_t end = begins ? places_->bytes : kMostBytes;
  for (uint32_t byte = 0; byte < end; ++byte) {
    if (!begins && isNoneReported(byte)) {
      byte += kWord - 1;
      continue;
    }
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

bool PmcMessages::nextChange(const runtime::Instance& instance, rung_message& message) noexcept {
  if (places_ == nullptr) return false;
  const Showing now = showing(instance);
  if (allReported_.isSame(instance.block().data(), places_->pieces, now)) return false;
  return findChange(instance, now, message);
}

// Ends come first: the number of a message that ends may be that of one that begins.
bool PmcMessages::findChange(const runtime::Instance& instance, const Showing& showing,
                             rung_message& message) noexcept {
  if (findChange(instance, showing, false, message) || findChange(instance, showing, true, message)) return true;
  allReported_.take(instance.block().data(), places_->pieces, showing);
  return false;
}

void PmcMessages::writeStates(const runtime::Instance& instance) noexcept {
  if (places_ == nullptr || places_->states.empty()) return;
  const uint8_t* block = instance.block().data();
  const Showing now = showing(instance);
  if (stated_.isSame(block, places_->pieces, now) && states_.isSame(block, places_->states, now)) return;
  for (const Piece& piece : places_->states) {
    for (uint32_t byte = piece.first; byte < piece.first + piece.count; ++byte) {
      const uint8_t requested = bitsOf(instance, now, byte);
      uint8_t shown = requested;
      for (uint32_t left = requested; left != 0; left &= left - 1) {
        const auto bit = static_cast<uint32_t>(std::countr_zero(left));
        if (known(8 * byte + bit + 1, now.shift).number == 0) shown = static_cast<uint8_t>(shown & ~(1u << bit));
      }
      instance.memory().writeByte(places_->area, kFirstState + byte, shown);
    }
  }
  stated_.take(block, places_->pieces, now);
  states_.take(block, places_->states, now);
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

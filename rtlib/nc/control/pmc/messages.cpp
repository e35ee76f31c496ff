// Changes of messages, looked for in every slot (see messages.h).
#include "rtlib/nc/control/pmc/messages.h"

namespace rung::nc {

bool PmcMessages::isAsSeen(const uint8_t* block, bool display) const noexcept {
  if (!hasSeen_ || display != seenDisplay_) return false;
  const uint8_t* seen = seen_.data();
  for (const Piece& piece : places_->pieces) {
    if (std::memcmp(block + piece.offset, seen, piece.size()) != 0) return false;
    seen += piece.size();
  }
  return true;
}

void PmcMessages::see(const uint8_t* block, bool display) noexcept {
  uint8_t* seen = seen_.data();
  for (const Piece& piece : places_->pieces) {
    std::memcpy(seen, block + piece.offset, piece.size());
    seen += piece.size();
  }
  hasSeen_ = true;
  seenDisplay_ = display;
}

bool PmcMessages::nextChange(const runtime::Instance& instance, rung_message& message) noexcept {
  if (places_ == nullptr) return false;
  const bool display = displays(instance);
  if (isAsSeen(instance.block().data(), display)) return false;
  const uint32_t moved = shift(instance);
  for (uint32_t byte = 0; byte < places_->bytes; ++byte) {
    const uint8_t bits = display ? instance.memory().readByte(places_->area, byte) : uint8_t{0};
    for (uint8_t changed = bits ^ known_[byte]; changed != 0; changed = bits ^ known_[byte]) {
      const auto bit = static_cast<uint32_t>(std::countr_zero(changed));
      known_[byte] = static_cast<uint8_t>(known_[byte] ^ 1u << bit);
      const Known found = known(8 * byte + bit + 1, moved);
      if (found.number == 0) continue;
      message = {.op = (bits >> bit & 1) != 0 ? RUNG_MESSAGE_SHOW : RUNG_MESSAGE_CLEAR, .number = found.number};
      if (isListed()) message.value = found.key;
      return true;
    }
  }
  see(instance.block().data(), display);
  return false;
}

void PmcMessages::writeStates(const runtime::Instance& instance) const noexcept {
  if (places_ == nullptr || places_->states.empty()) return;
  const bool display = displays(instance);
  const uint32_t moved = shift(instance);
  for (const uint32_t byte : places_->states) {
    uint8_t shown = display ? instance.memory().readByte(places_->area, byte) : uint8_t{0};
    for (uint32_t bit = 0; bit < 8; ++bit)
      if (known(8 * byte + bit + 1, moved).number == 0) shown = static_cast<uint8_t>(shown & ~(1u << bit));
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

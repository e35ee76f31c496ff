// Changes of messages, looked for in every slot (see messages.h).
#include "rtlib/nc/control/pmc/messages.h"

namespace rung::nc {

void PmcMessages::Look::take(const uint8_t* block, std::span<const Piece> pieces, bool display) noexcept {
  uint8_t* bytes = bytes_.data();
  for (const Piece& piece : pieces) {
    std::memcpy(bytes, block + piece.offset, piece.size());
    bytes += piece.size();
  }
  has_ = true;
  display_ = display;
}

bool PmcMessages::nextChange(const runtime::Instance& instance, rung_message& message) noexcept {
  if (places_ == nullptr) return false;
  const bool display = displays(instance);
  if (reported_.isSame(instance.block().data(), places_->pieces, display)) return false;
  return findChange(instance, display, message);
}

bool PmcMessages::findChange(const runtime::Instance& instance, bool display, rung_message& message) noexcept {
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
  reported_.take(instance.block().data(), places_->pieces, display);
  return false;
}

void PmcMessages::writeStates(const runtime::Instance& instance) noexcept {
  if (places_ == nullptr || places_->states.empty()) return;
  const uint8_t* block = instance.block().data();
  const bool display = displays(instance);
  const uint32_t moved = shift(instance);
  const bool isSame = moved == statedShift_ && stated_.isSame(block, places_->pieces, display) &&
                      states_.isSame(block, places_->states, display);
  if (isSame) return;
  for (const Piece& piece : places_->states) {
    for (uint32_t byte = piece.first; byte < piece.first + piece.count; ++byte) {
      const uint8_t requested = display ? instance.memory().readByte(places_->area, byte) : uint8_t{0};
      uint8_t shown = requested;
      for (uint32_t left = requested; left != 0; left &= left - 1) {
        const auto bit = static_cast<uint32_t>(std::countr_zero(left));
        if (known(8 * byte + bit + 1, moved).number == 0) shown = static_cast<uint8_t>(shown & ~(1u << bit));
      }
      instance.memory().writeByte(places_->area, kFirstState + byte, shown);
    }
  }
  statedShift_ = moved;
  stated_.take(block, places_->pieces, display);
  states_.take(block, places_->states, display);
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

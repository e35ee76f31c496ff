// Copying by a plan, between two scans (see state_transfer.h; transfer_plan.cpp makes the plan).
#include "rtlib/host/state_transfer.h"

#include <cstring>

namespace rung::host {

namespace {

uint8_t packed(const uint8_t* bits) noexcept {
  uint64_t bytes;
  std::memcpy(&bytes, bits, sizeof bytes);
  return static_cast<uint8_t>((bytes & 0x0101010101010101u) * 0x0102040810204080u >> 56);
}

// Byte b keeps bit b alone; the sum carries it to the top of its byte.
void unpack(uint8_t byte, uint8_t* bits) noexcept {
  const uint64_t chosen = (byte * 0x0101010101010101u) & 0x8040201008040201u;
  const uint64_t bytes = ((chosen + 0x00406070787C7E7Fu) >> 7) & 0x0101010101010101u;
  std::memcpy(bits, &bytes, sizeof bytes);
}

} // namespace

// A mechanism that does not wait is at its beginning, which every program has; one that is gone and does not wait is no
// loss either.
const char* StateTransfer::waiting(const uint8_t* from) const noexcept {
  for (const Points& points : points_) {
    uint32_t number;
    std::memcpy(&number, from + points.from, sizeof number);
    if (number != 0 && (number >= points.count || numbers_[points.first + number] == RUNG_NONE)) return points.key;
  }
  return nullptr;
}

void StateTransfer::run(const uint8_t* from, uint8_t* to) const noexcept {
  for (const Move& move : moves_) {
    const uint8_t* source = from + move.from;
    uint8_t* target = to + move.to;
    switch (move.kind) {
    case MoveKind::Copy: std::memcpy(target, source, move.count); break;
    case MoveKind::Pack:
      for (uint32_t i = 0; i < move.count; ++i) target[i] = packed(source + size_t{8} * i);
      break;
    case MoveKind::Unpack:
      for (uint32_t i = 0; i < move.count; ++i) unpack(source[i], target + size_t{8} * i);
      break;
    case MoveKind::Bit: {
      const uint32_t bit = (*source >> move.fromBit) & 1u;
      *target = static_cast<uint8_t>((*target & ~(1u << move.toBit)) | (bit << move.toBit));
      break;
    }
    }
  }
  for (const Points& points : points_) {
    uint32_t number;
    std::memcpy(&number, from + points.from, sizeof number);
    if (points.to == RUNG_NONE || number >= points.count) continue;
    number = numbers_[points.first + number];
    std::memcpy(to + points.to, &number, sizeof number);
  }
}

} // namespace rung::host

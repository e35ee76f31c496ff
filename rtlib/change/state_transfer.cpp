// Copying by a plan, between two scans (see state_transfer.h; transfer_plan.cpp makes the plan).
#include "rtlib/change/state_transfer.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "rtlib/core/bits.h"

namespace rung::runtime {

// A mechanism that does not wait is at its beginning, which every program has; if it was removed, nothing is lost,
// either.
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
      for (uint32_t i = 0; i < move.count; ++i) target[i] = core::packBits(source + size_t{8} * i);
      break;
    case MoveKind::Unpack:
      for (uint32_t i = 0; i < move.count; ++i) core::unpackBits(source[i], target + size_t{8} * i);
      break;
    case MoveKind::Bit: {
      const uint32_t bit = (*source >> move.fromBit) & 1u;
      *target = static_cast<uint8_t>((*target & ~(1u << move.toBit)) | (bit << move.toBit));
      break;
    }
    }
  }
  for (const Holder& holder : holders_) {
    const uint8_t* slot = from + holder.slot;
    if (std::any_of(slot, slot + holder.slotBytes, [](uint8_t byte) { return byte != 0; }))
      std::memset(to + holder.held, 0, holder.heldBytes);
  }
  for (const Points& points : points_) {
    uint32_t number;
    std::memcpy(&number, from + points.from, sizeof number);
    if (points.to == RUNG_NONE || number >= points.count) continue;
    number = numbers_[points.first + number];
    std::memcpy(to + points.to, &number, sizeof number);
  }
}

void StateTransfer::countBytes() {
  bytes_ = 0;
  for (const Move& move : moves_) bytes_ += bytesOf(move);
}

std::vector<bool> StateTransfer::written(uint32_t bytes) const {
  std::vector<bool> written(bytes);
  for (const Move& move : moves_)
    if (move.kind != MoveKind::Bit) std::fill_n(written.begin() + move.to, bytesOf(move), true);
  return written;
}

// If several moves write the same bytes, the last one counts.
std::vector<bool> StateTransfer::staying(uint32_t bytes) const {
  std::vector<bool> staying(bytes);
  const auto mark = [&](uint32_t first, uint64_t count, bool stays) {
    std::fill_n(staying.begin() + first, count, stays);
  };
  for (const Move& move : moves_) mark(move.to, bytesOf(move), move.kind == MoveKind::Copy && move.from == move.to);
  for (const Holder& holder : holders_) mark(holder.held, holder.heldBytes, false);
  for (const Points& points : points_)
    if (points.to != RUNG_NONE) mark(points.to, sizeof(uint32_t), false);
  return staying;
}

StateTransfer StateTransfer::without(const std::vector<bool>& staying) const {
  StateTransfer rest = *this;
  rest.moves_.clear();
  for (const Move& move : moves_) {
    if (move.kind != MoveKind::Copy || move.from != move.to) {
      rest.moves_.push_back(move);
      continue;
    }
    for (const rung_span& span : leaving(staying, move.to, move.count))
      rest.moves_.push_back({.from = span.offset, .to = span.offset, .count = span.size});
  }
  rest.countBytes();
  return rest;
}

std::vector<rung_span> StateTransfer::leaving(const std::vector<bool>& staying, uint32_t first, uint32_t count) {
  std::vector<rung_span> spans;
  for (uint32_t i = first; i < first + count; ++i) {
    if (staying[i]) continue;
    if (i > first && !staying[i - 1])
      ++spans.back().size;
    else
      spans.push_back({i, 1});
  }
  return spans;
}

} // namespace rung::runtime

// See input_bits.h.
#include "rtlib/record/input_bits.h"

#include <algorithm>

namespace rung::runtime {

InputBits::InputBits(std::span<const uint8_t> masks) : masks_(masks.begin(), masks.end()) {
  for (size_t at = 0; at < masks_.size();) {
    if (masks_[at] == 0) {
      ++at;
      continue;
    }
    Piece piece{.known = {}, .mask = {}, .offset = static_cast<uint32_t>(std::min(at, masks_.size() - kPiece))};
    std::memcpy(&piece.mask, masks_.data() + piece.offset, kPiece);
    pieces_.push_back(piece);
    at = piece.offset + kPiece;
  }
  used_ = pieces_.size();
  while (pieces_.size() % kStep != 0) pieces_.push_back({.known = {}, .mask = {}, .offset = pieces_.back().offset});
  makeList();
}

// put(first, count) for each run of bytes with such bits.
template <class Put>
void InputBits::eachRun(Put put) const {
  for (size_t at = 0; at < masks_.size();) {
    size_t end = at;
    while (end < masks_.size() && masks_[end] != 0) ++end;
    if (end != at) put(at, end - at);
    at = std::max(end, at + 1);
  }
}

void InputBits::makeList() {
  constexpr size_t kNumber = 5; // bytes of a number of 32 bits
  size_t runs = 0, end = 0, room = kNumber;
  eachRun([&](size_t, size_t count) { ++runs, room += 2 * kNumber + count; });
  list_.resize(room);
  EventWriter writer(list_);
  writer.putNumber(runs);
  eachRun([&](size_t first, size_t count) {
    writer.putNumber(first - end);
    writer.putNumber(count);
    writer.putBytes({masks_.data() + first, count});
    end = first + count;
  });
  list_.resize(writer.size());
}

void InputBits::listKnown(EventWriter& writer) const noexcept {
  for (const Piece& piece : std::span(pieces_).first(used_)) {
    const auto bytes = std::bit_cast<std::array<uint8_t, kPiece>>(piece.known);
    writer.put(Event::Input, piece.offset, kPiece);
    writer.putBytes(bytes);
  }
}

std::optional<InputBits> InputBits::fromList(size_t blockBytes, EventReader& reader) {
  std::vector<uint8_t> masks(blockBytes);
  uint64_t end = 0;
  for (uint64_t count = reader.takeNumber(); count != 0 && reader.good(); --count) {
    const uint64_t first = end + reader.takeNumber32();
    const std::span<const uint8_t> run = reader.takeBytes(reader.takeNumber());
    end = first + run.size();
    if (!reader.good() || run.empty() || end > masks.size()) return std::nullopt;
    std::ranges::copy(run, masks.begin() + static_cast<ptrdiff_t>(first));
  }
  return reader.good() ? std::optional<InputBits>(std::in_place, masks) : std::nullopt;
}

void InputBits::set(uint64_t offset, std::span<const uint8_t> bytes) noexcept {
  for (Piece& piece : std::span(pieces_).first(used_)) {
    if (piece.offset + kPiece <= offset) continue;
    if (piece.offset >= offset + bytes.size()) break;
    auto known = std::bit_cast<std::array<uint8_t, kPiece>>(piece.known);
    const uint64_t first = std::max<uint64_t>(offset, piece.offset);
    const uint64_t end = std::min<uint64_t>(offset + bytes.size(), uint64_t{piece.offset} + kPiece);
    for (uint64_t at = first; at < end; ++at) known[at - piece.offset] = bytes[at - offset] & masks_[at];
    piece.known = std::bit_cast<Words>(known);
  }
}

} // namespace rung::runtime

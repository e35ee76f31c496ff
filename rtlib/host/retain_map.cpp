// The map of kept bytes (see retain_map.h).
#include "rtlib/host/retain_map.h"

#include <algorithm>
#include <string_view>

namespace rung::host {
namespace {

constexpr uint64_t kHashStart = 0xCBF29CE484222325; // FNV-1a

uint64_t hashText(uint64_t hash, std::string_view text) {
  for (const char c : text) hash = (hash ^ static_cast<uint8_t>(c)) * 0x100000001B3;
  return hash * 0x100000001B3; // the end of the text counts
}

uint64_t hashNumber(uint64_t hash, uint64_t number) {
  for (int i = 0; i < 8; ++i) hash = (hash ^ ((number >> (8 * i)) & 0xFF)) * 0x100000001B3;
  return hash;
}

// Where a byte of the memory block lies in a space.
struct Found {
  uint32_t space = RUNG_NONE;
  const rung_range* range = nullptr;
};

uint32_t scaleOf(const rung_range& range) { return range.repr == RUNG_REPR_BYTE_PER_BIT ? 8 : 1; }

Found find(const rung_program& program, uint32_t offset) {
  for (uint32_t s = 0; s < program.space_count; ++s)
    for (uint32_t r = 0; r < program.spaces[s].range_count; ++r) {
      const rung_range& range = program.spaces[s].ranges[r];
      if (offset >= range.offset && offset - range.offset < range.byte_count * scaleOf(range)) return {s, &range};
    }
  return {};
}

} // namespace

RetainMap::RetainMap(const rung_program& program) : hash_(hashText(kHashStart, program.dialect)) {
  for (uint32_t i = 0; i < program.retain_count; ++i) addSpan(program, program.retains[i]);
  endRun(program, run_);
}

void RetainMap::addSpan(const rung_program& program, const rung_span& span) {
  for (uint32_t done = 0; done < span.size;) {
    const Found found = find(program, span.offset + done);
    const rung_range* range = found.range;
    if (range == nullptr) return; // checkProgram and the compiler refuse it
    const uint32_t rest = span.size - done;
    const uint32_t scale = scaleOf(*range);
    const uint32_t into = span.offset + done - range->offset;
    const uint32_t raw = std::min(rest, range->byte_count * scale - into);
    const uint32_t first = range->first_byte + into / scale;
    if (found.space != run_.space || first != run_.end) {
      endRun(program, run_);
      run_ = {found.space, first, first};
    }
    run_.end += raw / scale;
    pieces_.push_back({raw / scale, scale == 8});
    size_ += raw / scale;
    rawSize_ += raw;
    done += raw;
  }
}

void RetainMap::endRun(const rung_program& program, Run& run) {
  if (run.space == RUNG_NONE) return;
  hash_ = hashNumber(hashNumber(hashText(hash_, program.spaces[run.space].name), run.first), run.end);
  run = {};
}

void RetainMap::pack(std::span<const uint8_t> raw, std::span<uint8_t> image) const {
  size_t from = 0;
  size_t to = 0;
  for (const Piece& piece : pieces_)
    for (uint32_t i = 0; i < piece.bytes; ++i) {
      if (!piece.expanded) {
        image[to++] = raw[from++];
        continue;
      }
      uint8_t byte = 0;
      for (unsigned bit = 0; bit < 8; ++bit) byte = static_cast<uint8_t>(byte | ((raw[from++] & 1u) << bit));
      image[to++] = byte;
    }
}

void RetainMap::unpack(std::span<const uint8_t> image, std::span<uint8_t> raw) const {
  size_t from = 0;
  size_t to = 0;
  for (const Piece& piece : pieces_)
    for (uint32_t i = 0; i < piece.bytes; ++i, ++from) {
      if (!piece.expanded) {
        raw[to++] = image[from];
        continue;
      }
      for (unsigned bit = 0; bit < 8; ++bit) raw[to++] = static_cast<uint8_t>((image[from] >> bit) & 1u);
    }
}

} // namespace rung::host

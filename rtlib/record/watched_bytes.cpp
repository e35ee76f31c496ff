// See watched_bytes.h.
#include "rtlib/record/watched_bytes.h"

#include <algorithm>
#include <span>
#include <utility>

namespace rung::runtime {

bool mayWrite(const BlockBytes& bits, uint64_t offset, std::span<const uint8_t> bytes) {
  if (offset > bits.size() || bytes.size() > bits.size() - offset) return false;
  for (size_t i = 0; i < bytes.size(); ++i)
    if (bytes[i] > 1 && bits[offset + i]) return false;
  return true;
}

namespace {

// Runs of bytes. Those with at most `gap` bytes between them are one, if none of these bytes is in `apart`.
std::vector<rung_span> spansOf(const BlockBytes& bytes, uint32_t gap, const BlockBytes& apart) {
  std::vector<rung_span> spans;
  uint32_t last = 0; // end of the last byte of either list
  for (uint32_t at = 0; at < bytes.size(); ++at) {
    if (bytes[at]) {
      const bool joins = !spans.empty() && last == spans.back().offset + spans.back().size && at - last <= gap;
      if (!joins) spans.push_back({at, 0});
      spans.back().size = at + 1 - spans.back().offset;
    }
    if (bytes[at] || apart[at]) last = at + 1;
  }
  return spans;
}

} // namespace

WatchedBytes::WatchedBytes(const rung_program& program, const BlockBytes& bytes)
    : known_(bytes.size()), watched_(bytes), size_(static_cast<uint32_t>(std::ranges::count(bytes, true))),
      spans_(spansOf(bytes, 0, bytes)) {
  constexpr uint32_t kGap = 64; // bytes that cost less than a run of their own
  compared_ = spansOf(bytes, kGap, bytes);
  BlockBytes written = writtenBytes(program);
  for (size_t i = 0; i < written.size(); ++i) written[i] = written[i] && bytes[i];
  written_ = spansOf(written, kGap, bytes); // a byte of others stays to be found
}

void WatchedBytes::list(EventWriter& writer) const noexcept {
  writer.putNumber(spans_.size());
  uint32_t end = 0;
  for (const rung_span& span : spans_) {
    writer.putNumber(span.offset - end);
    writer.putNumber(span.size);
    end = span.offset + span.size;
  }
}

size_t WatchedBytes::listed() const noexcept {
  constexpr size_t kNumber = 5; // bytes of a number of 32 bits
  return kNumber * (1 + 2 * spans_.size());
}

std::optional<WatchedBytes> WatchedBytes::fromList(const rung_program& program, EventReader& reader) {
  BlockBytes bytes(program.memory_size);
  uint64_t end = 0;
  for (uint64_t count = reader.takeNumber(); count != 0 && reader.good(); --count) {
    const uint64_t offset = end + reader.takeNumber32();
    const uint32_t size = reader.takeNumber32();
    end = offset + size;
    if (!reader.good() || size == 0 || end > bytes.size()) return std::nullopt;
    mark(bytes, offset, size);
  }
  return reader.good() ? std::optional<WatchedBytes>(std::in_place, program, bytes) : std::nullopt;
}

// FNV-1a, by words of eight bytes.
uint32_t WatchedBytes::hash(const uint8_t* block) const noexcept {
  constexpr uint64_t kPrime = 1099511628211u;
  uint64_t hash = 14695981039346656037u;
  for (const rung_span& span : spans_)
    for (uint32_t i = 0; i < span.size; i += sizeof(uint64_t)) {
      uint64_t word = 0;
      std::memcpy(&word, block + span.offset + i, std::min<size_t>(sizeof word, span.size - i));
      hash = (hash ^ word) * kPrime;
    }
  return static_cast<uint32_t>(hash ^ hash >> 32);
}

} // namespace rung::runtime

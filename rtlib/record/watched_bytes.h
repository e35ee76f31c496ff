// The bytes of a program's memory block that others than the program write: inputs, the control's signals, bound
// variables. After each part of the program they are known; before the next one the differences are what the others
// have written.
#pragma once
#include <algorithm>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <vector>

#include "rtlib/load/block_bytes.h"
#include "rtlib/record/events.h"
#include "rung/program.h"

namespace rung::runtime {

// Whether the bytes may be written there: in the block, and none of `bits` (bitBytes) is more than 1.
bool mayWrite(const BlockBytes& bits, uint64_t offset, std::span<const uint8_t> bytes);

class WatchedBytes {
public:
  // The constructor allocates.
  WatchedBytes(const rung_program& program, const BlockBytes& bytes);
  // None.
  explicit WatchedBytes(const rung_program& program) : WatchedBytes(program, BlockBytes(program.memory_size)) {}
  // A list of bytes, as `list` writes it; nothing if it is not one for this program.
  static std::optional<WatchedBytes> fromList(const rung_program& program, EventReader& reader);

  // Writes their number and, for each run of watched bytes, SKIP and COUNT; `listed` is the room for that.
  void list(EventWriter& writer) const noexcept;
  size_t listed() const noexcept;
  // Of the contents of watched bytes.
  uint32_t hash(const uint8_t* block) const noexcept;
  // The maximum number of bytes that `compare` can find changed.
  uint32_t size() const noexcept { return size_; }

  // ---- scan thread; nothing here allocates ----

  // From now on the present contents are known.
  void know(const uint8_t* block) noexcept { take(compared_, block); }
  // The same, if since then only the program has written.
  void knowWritten(const uint8_t* block) noexcept { take(written_, block); }
  // Whether all is as known. False also if a neighbour of watched bytes is not.
  bool isAsKnown(const uint8_t* block) const noexcept {
    for (const rung_span& span : compared_)
      if (std::memcmp(block + span.offset, known_.data() + span.offset, span.size) != 0) return false;
    return true;
  }
  // Calls changed(offset) for each byte that is not as known, with ascending offsets, and makes all known.
  template <class Changed>
  void compare(const uint8_t* block, Changed changed) noexcept {
    for (const rung_span& span : compared_)
      for (uint32_t at = span.offset, end = span.offset + span.size; at < end; at += kPiece) {
        const uint32_t count = std::min(kPiece, end - at);
        if (std::memcmp(block + at, known_.data() + at, count) == 0) continue;
        for (uint32_t i = at; i < at + count; ++i)
          if (block[i] != known_[i] && watched_[i]) changed(i);
        std::memcpy(known_.data() + at, block + at, count);
      }
  }

private:
  static constexpr uint32_t kPiece = 64; // bytes that are compared at once where something has changed

  void take(const std::vector<rung_span>& spans, const uint8_t* block) noexcept {
    for (const rung_span& span : spans) std::memcpy(known_.data() + span.offset, block + span.offset, span.size);
  }

  std::vector<uint8_t> known_; // by offset in the block
  BlockBytes watched_;
  uint32_t size_ = 0;
  std::vector<rung_span> spans_;    // of watched bytes
  std::vector<rung_span> compared_; // those with short gaps between them
  std::vector<rung_span> written_;  // of compared_, what the program may write, in the same way
};

} // namespace rung::runtime

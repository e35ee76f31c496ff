// The bytes of a program's memory block that others than the program write: inputs, the control's signals, bound
// variables. After each part of the program they are known; before the next one the differences are what the others
// have written.
#pragma once
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <vector>

#include "rtlib/record/events.h"
#include "rung/program.h"

namespace rung::runtime {

using BlockBytes = std::vector<bool>; // by offset in the block

// The bytes of spaces that the program may read.
BlockBytes readBytes(const rung_program& program);
// Those that the program or its process-image copies may write.
BlockBytes writtenBytes(const rung_program& program);

// Those that hold one bit each, which is 0 or 1; the code of programs relies on that.
BlockBytes bitBytes(const rung_program& program);
// Whether the bytes may be written there: in the block, and no bit is more than 1.
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
  uint32_t size() const noexcept { return static_cast<uint32_t>(kPiece * known_.size()); }

  // ---- scan thread; nothing here allocates ----

  // From now on the present contents are known.
  void know(const uint8_t* block) noexcept {
    for (size_t i = 0; i < offsets_.size(); ++i) known_[i] = wordsAt(block, i);
  }
  // The same, if since then only the program has written.
  void knowWritten(const uint8_t* block) noexcept {
    for (size_t i = inputs_; i < offsets_.size(); ++i) known_[i] = wordsAt(block, i);
  }
  // Whether all is as known. False also if a neighbour of watched bytes is not.
  bool isAsKnown(const uint8_t* block) const noexcept {
    Words different{};
    for (size_t i = 0; i < offsets_.size(); i += kStep) // there are so many that no rest remains
      for (size_t k = i; k < i + kStep; ++k) different |= wordsAt(block, k) ^ known_[k];
    return (different[0] | different[1]) == 0;
  }
  // Calls changed(offset) for each byte that is not as known, and makes all known. Offsets ascend among inputs, and
  // among the others after them.
  template <class Changed>
  void compare(const uint8_t* block, Changed changed) noexcept {
    for (size_t i = 0; i < offsets_.size(); ++i) {
      const Words different = (wordsAt(block, i) ^ known_[i]) & masks_[i];
      known_[i] = wordsAt(block, i);
      if ((different[0] | different[1]) == 0) continue;
      const auto bytes = std::bit_cast<std::array<uint8_t, kPiece>>(different);
      for (uint32_t b = 0; b < kPiece; ++b)
        if (bytes[b] != 0) changed(offsets_[i] + b);
    }
  }

private:
  static constexpr uint32_t kPiece = 16; // bytes that are compared at once
  static constexpr size_t kStep = 4;     // pieces of which the comparison makes one step
  using Words = uint64_t __attribute__((vector_size(kPiece)));

  Words wordsAt(const uint8_t* block, size_t piece) const noexcept {
    Words words;
    std::memcpy(&words, block + offsets_[piece], sizeof words);
    return words;
  }

  // Of each piece: first those in which the program writes nothing, `inputs_` of them. The last piece of the block may
  // overlap another one, and the last of the list may be there several times.
  std::vector<uint32_t> offsets_;
  std::vector<Words> known_;
  std::vector<Words> masks_; // of watched bytes
  size_t inputs_ = 0;
  std::vector<rung_span> spans_; // of watched bytes
};

} // namespace rung::runtime

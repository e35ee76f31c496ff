// The bits of a program's memory block that its host writes before each slice, from variables that are bound to cells.
// What the program does to them lasts until the next slice only, so it does not matter to a comparison.
#pragma once
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <vector>

#include "rtlib/record/events.h"

namespace rung::runtime {

class InputBits {
public:
  // `masks`: which bits of each byte of the block, which has at least core::Memory::kLeastBlock bytes. Allocates.
  explicit InputBits(std::span<const uint8_t> masks);
  // A list, as `list` writes it; nothing if it is not one for a block of so many bytes.
  static std::optional<InputBits> fromList(size_t blockBytes, EventReader& reader);

  // Writes the number of runs of bytes and, for each, SKIP, BYTES and the masks. `listed`: the room for that.
  void list(EventWriter& writer) const noexcept { writer.putBytes(list_); }
  size_t listed() const noexcept { return list_.size(); }
  // The maximum number of bytes that `compare` can find changed.
  size_t bytes() const noexcept { return kPiece * pieces_.size(); }

  // ---- scan thread; nothing here allocates ----

  // From now on the present contents are known.
  void know(const uint8_t* block) noexcept {
    for (Piece& piece : pieces_) piece.known = wordsAt(block, piece) & piece.mask;
  }
  bool areAsKnown(const uint8_t* block) const noexcept {
    Words different{};
    for (size_t i = 0; i < pieces_.size(); i += kStep) // there are so many that no rest remains
      for (size_t k = i; k < i + kStep; ++k)
        different |= (wordsAt(block, pieces_[k]) ^ pieces_[k].known) & pieces_[k].mask;
    return (different[0] | different[1]) == 0;
  }
  // Calls changed(offset) for each byte that is not as known, with ascending offsets, and makes all known.
  template <class Changed>
  void compare(const uint8_t* block, Changed changed) noexcept {
    uint32_t next = 0; // pieces may overlap at the end of a block
    for (Piece& piece : pieces_) {
      const Words now = wordsAt(block, piece) & piece.mask;
      const Words different = now ^ piece.known;
      if ((different[0] | different[1]) == 0) continue;
      const auto bytes = std::bit_cast<std::array<uint8_t, kPiece>>(different);
      piece.known = now;
      for (uint32_t b = 0; b < kPiece; ++b)
        if (bytes[b] != 0 && piece.offset + b >= next) changed(piece.offset + b), next = piece.offset + b + 1;
    }
  }

  // ---- a player ----

  // Writes what is known, as the host did.
  void write(uint8_t* block) const noexcept {
    for (const Piece& piece : pieces_) {
      const Words words = (wordsAt(block, piece) & ~piece.mask) | piece.known;
      std::memcpy(block + piece.offset, &words, sizeof words);
    }
  }
  // Writes what is known as events (Event::Input); `listedKnown`: the room for that.
  void listKnown(EventWriter& writer) const noexcept;
  size_t listedKnown() const noexcept { return pieces_.size() * (kPiece + kEvent); }
  // From now on these bytes are known, from `offset` on.
  void set(uint64_t offset, std::span<const uint8_t> bytes) noexcept;

private:
  static constexpr uint32_t kPiece = 16; // bytes that are compared at once
  static constexpr size_t kStep = 4;     // pieces of which the comparison makes one step
  static constexpr size_t kEvent = 12;   // bytes of an event beside those that it writes, at most
  using Words = uint64_t __attribute__((vector_size(kPiece)));
  struct Piece {
    Words known, mask;
    uint32_t offset = 0;
  };

  static Words wordsAt(const uint8_t* block, const Piece& piece) noexcept {
    Words words;
    std::memcpy(&words, block + piece.offset, sizeof words);
    return words;
  }
  template <class Put>
  void eachRun(Put put) const;
  void makeList();

  std::vector<uint8_t> masks_; // of the block
  std::vector<Piece> pieces_;  // by offset; the last ones of a step may have no bits
  size_t used_ = 0;            // pieces with bits
  std::vector<uint8_t> list_;  // as `list` writes it
};

} // namespace rung::runtime

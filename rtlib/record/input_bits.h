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
    for (size_t i = 0; i < pieces_.size(); ++i) known_[i] = wordsAt(block, pieces_[i].offset) & pieces_[i].mask;
  }
  // Calls changed(offset) for each byte that is not as known, with ascending offsets, and makes all known.
  template <class Changed>
  void compare(const uint8_t* block, Changed changed) noexcept {
    for (size_t i = 0; i < pieces_.size(); i += kStep) { // there are so many that no rest remains
      Words different{};
      for (size_t k = i; k < i + kStep; ++k)
        different |= (wordsAt(block, pieces_[k].offset) & pieces_[k].mask) ^ known_[k];
      if ((different[0] | different[1]) == 0) [[likely]]
        continue;
      for (size_t k = i; k < i + kStep; ++k) compareOne(block, k, changed);
    }
  }

  // ---- a player ----

  // Writes what is known, as the host did.
  void write(uint8_t* block) const noexcept {
    for (size_t i = 0; i < pieces_.size(); ++i) {
      const Words words = (wordsAt(block, pieces_[i].offset) & ~pieces_[i].mask) | known_[i];
      std::memcpy(block + pieces_[i].offset, &words, sizeof words);
    }
  }
  // Writes what is known as events (Event::Input); `listedKnown`: the room for that.
  void listKnown(EventWriter& writer) const noexcept;
  size_t listedKnown() const noexcept { return pieces_.size() * (kPiece + kEvent); }
  // From now on these bytes are known, from `offset` on.
  void set(uint64_t offset, std::span<const uint8_t> bytes) noexcept;

private:
  static constexpr uint32_t kPiece = 16; // bytes that are compared at once
  static constexpr size_t kStep = 8;     // pieces of which the comparison makes one step
  static constexpr size_t kEvent = 12;   // bytes of an event beside those that it writes, at most
  using Words = uint64_t __attribute__((vector_size(kPiece)));
  struct Piece {
    Words mask;
    uint32_t offset = 0;
  };

  static Words wordsAt(const uint8_t* block, uint32_t offset) noexcept {
    Words words;
    std::memcpy(&words, block + offset, sizeof words);
    return words;
  }
  template <class Changed>
  void compareOne(const uint8_t* block, size_t i, Changed& changed) noexcept {
    const Words now = wordsAt(block, pieces_[i].offset) & pieces_[i].mask;
    const Words different = now ^ known_[i];
    known_[i] = now;
    for (uint32_t half = 0; half < 2; ++half) {
      constexpr uint32_t kBits = 8; // of a byte; the first byte is the lowest: `littleEndian`
      for (uint64_t left = littleEndian(different[half]); left != 0;) {
        const auto byte = static_cast<uint32_t>(std::countr_zero(left)) / kBits;
        changed(pieces_[i].offset + kBits * half + byte);
        left &= ~(uint64_t{0xFF} << byte * kBits);
      }
    }
  }
  static uint64_t littleEndian(uint64_t word) noexcept {
    return std::endian::native == std::endian::little ? word : __builtin_bswap64(word);
  }
  template <class Put>
  void eachRun(Put put) const;
  void makeList();

  std::vector<uint8_t> masks_; // of the block
  std::vector<Piece> pieces_;  // by offset, each byte in one of them; the last ones of a step may have no bits
  std::vector<Words> known_;   // of each piece
  size_t used_ = 0;            // pieces with bits
  std::vector<uint8_t> list_;  // as `list` writes it
};

} // namespace rung::runtime

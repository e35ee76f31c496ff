// The bits of a program's memory block that its host writes before each slice, from variables that are bound to cells.
// What the program does to them lasts until the next slice only, so it does not matter to a comparison.
#pragma once
#include <algorithm>
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
  static constexpr uint32_t kPiece = 16; // bytes of the block that are next to each other
  static constexpr size_t kStep = 4;     // pieces that are compared together
  using Words = uint64_t __attribute__((vector_size(kPiece)));

public:
  // Pieces in the order of their offsets; the last ones of the last step may have no bits.
  struct Step {
    static constexpr size_t kAlign = 2 * kPiece; // two of them are one operand
    alignas(kAlign) Words known[kStep] = {};
    alignas(kAlign) Words mask[kStep] = {};
    uint32_t offset[kStep] = {};
  };

  enum class Cpu : uint8_t { This, Any }; // whose instructions compare
  // `masks`: which bits of each byte of the block, which has at least core::Memory::kLeastBlock bytes. Allocates.
  explicit InputBits(std::span<const uint8_t> masks, Cpu cpu = Cpu::This);
  // A list, as `list` writes it; nothing if it is not one for a block of so many bytes.
  static std::optional<InputBits> fromList(size_t blockBytes, EventReader& reader);

  // Writes the number of runs of bytes and, for each, SKIP, BYTES and the masks. `listed`: the room for that.
  void list(EventWriter& writer) const noexcept { writer.putBytes(list_); }
  size_t listed() const noexcept { return list_.size(); }
  // Whether the list that follows is this one, which it then takes.
  bool takeSame(EventReader& reader) const noexcept {
    EventReader after = reader;
    const std::span<const uint8_t> same = after.takeBytes(list_.size());
    if (!after.good() || !std::ranges::equal(same, list_)) return false;
    reader = after;
    return true;
  }

  // ---- scan thread; nothing here allocates ----

  // From now on the present contents are known.
  void know(const uint8_t* block) noexcept {
    for (Step& step : steps_)
      for (size_t k = 0; k < kStep; ++k) step.known[k] = wordsAt(block, step.offset[k]) & step.mask[k];
  }
  // Where the first byte is that is not as known; null: all are.
  Step* firstOther(const uint8_t* block) noexcept { return find_(steps_.data(), end(), block); }
  // Calls changed(offset) for each byte from there on that is not as known, with ascending offsets, and makes all
  // known.
  template <class Changed>
  void compare(Step* from, const uint8_t* block, Changed changed) noexcept {
    for (Step* at = from; at != nullptr; at = find_(at + 1, end(), block)) compareStep(*at, block, changed);
  }

  // ---- a player ----

  // Writes what is known, as the host did.
  void write(uint8_t* block) const noexcept {
    for (const Step& step : steps_)
      for (size_t k = 0; k < kStep; ++k) {
        const Words words = (wordsAt(block, step.offset[k]) & ~step.mask[k]) | step.known[k];
        std::memcpy(block + step.offset[k], &words, sizeof words);
      }
  }
  // Writes what is known as events (Event::Input); `listedKnown`: the room for that.
  void listKnown(EventWriter& writer) const noexcept;
  size_t listedKnown() const noexcept { return pieces_ * (kPiece + kEvent); }
  // From now on these bytes are known, from `offset` on.
  void set(uint64_t offset, std::span<const uint8_t> bytes) noexcept;

private:
  static constexpr size_t kEvent = 12; // bytes of an event beside those that it writes, at most

  Step* end() noexcept { return steps_.data() + steps_.size(); }
  static Words wordsAt(const uint8_t* block, uint32_t offset) noexcept {
    Words words;
    std::memcpy(&words, block + offset, sizeof words);
    return words;
  }
  // The first step in which a byte is not as known; null: none. For any CPU, and for those with AVX2.
  using Find = Step* (*)(Step* at, Step* end, const uint8_t* block) noexcept;
  static Step* find(Step* at, Step* end, const uint8_t* block) noexcept;
  static Step* findByAny(Step* at, Step* end, const uint8_t* block) noexcept;
  static Step* findByAvx2(Step* at, Step* end, const uint8_t* block) noexcept;
  static Find findBy(Cpu cpu) noexcept;
  template <class Changed>
  static void compareStep(Step& step, const uint8_t* block, Changed& changed) noexcept {
    for (size_t k = 0; k < kStep; ++k) {
      const Words now = wordsAt(block, step.offset[k]) & step.mask[k];
      const Words different = now ^ step.known[k];
      if ((different[0] | different[1]) == 0) continue;
      step.known[k] = now;
      eachByte(different[0], step.offset[k], changed);
      eachByte(different[1], step.offset[k] + sizeof(uint64_t), changed);
    }
  }
  template <class Changed>
  static void eachByte(uint64_t different, uint32_t offset, Changed& changed) noexcept {
    constexpr uint32_t kBits = 8; // of a byte; the first byte is the lowest: `littleEndian`
    for (uint64_t left = littleEndian(different); left != 0;) {
      const auto byte = static_cast<uint32_t>(std::countr_zero(left)) / kBits;
      changed(offset + byte);
      left &= ~(uint64_t{0xFF} << byte * kBits);
    }
  }
  static uint64_t littleEndian(uint64_t word) noexcept {
    return std::endian::native == std::endian::little ? word : __builtin_bswap64(word);
  }
  template <class Put>
  void eachRun(Put put) const;
  template <class Each>
  void eachPiece(Each each) const;
  void add(uint32_t offset, Words mask);
  void makeList();

  Find find_;
  std::vector<uint8_t> masks_; // of the block
  std::vector<Step> steps_;    // each byte is in one piece
  size_t pieces_ = 0;          // with bits
  std::vector<uint8_t> list_;  // as `list` writes it
};

} // namespace rung::runtime

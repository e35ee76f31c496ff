// See input_bits.h.
#include "rtlib/record/input_bits.h"

#include <algorithm>

namespace rung::runtime {

// By two pieces, which are one operand of AVX2; other CPUs take them one by one. Compiled for both.
[[gnu::always_inline]] inline InputBits::Step* InputBits::find(Step* at, Step* end, const uint8_t* block) noexcept {
  using Pair = uint64_t __attribute__((vector_size(2 * kPiece)));
  for (; at != end; ++at) {
    Pair different{};
    for (size_t k = 0; k < kStep; k += 2) {
      Words one, two;
      Pair mask, known;
      std::memcpy(&one, block + at->offset[k], sizeof one);
      std::memcpy(&two, block + at->offset[k + 1], sizeof two);
      std::memcpy(&mask, &at->mask[k], sizeof mask);
      std::memcpy(&known, &at->known[k], sizeof known);
      different |= (__builtin_shufflevector(one, two, 0, 1, 2, 3) & mask) ^ known;
    }
    if ((different[0] | different[1] | different[2] | different[3]) != 0) return at;
  }
  return nullptr;
}

InputBits::Step* InputBits::findByAny(Step* at, Step* end, const uint8_t* block) noexcept {
  return find(at, end, block);
}

#if defined(__x86_64__)
[[gnu::target("avx2")]] InputBits::Step* InputBits::findByAvx2(Step* at, Step* end, const uint8_t* block) noexcept {
  return find(at, end, block);
}

InputBits::Find InputBits::findBy(Cpu cpu) noexcept {
  return cpu == Cpu::This && __builtin_cpu_supports("avx2") ? findByAvx2 : findByAny;
}
#else
InputBits::Find InputBits::findBy(Cpu) noexcept { return findByAny; }
#endif

InputBits::InputBits(std::span<const uint8_t> masks, Cpu cpu) : find_(findBy(cpu)), masks_(masks.begin(), masks.end()) {
  for (size_t at = 0; at < masks_.size();) {
    if (masks_[at] == 0) {
      ++at;
      continue;
    }
    const size_t first = std::min(at, masks_.size() - kPiece); // pieces may overlap at the end of a block
    std::array<uint8_t, kPiece> mask{};
    for (size_t i = at; i < first + kPiece; ++i) mask[i - first] = masks_[i];
    add(static_cast<uint32_t>(first), std::bit_cast<Words>(mask));
    at = first + kPiece;
  }
  makeList();
}

// All pieces of a step have a place that can be read.
void InputBits::add(uint32_t offset, Words mask) {
  if (pieces_ % kStep == 0) std::fill_n(steps_.emplace_back().offset, kStep, offset);
  steps_.back().offset[pieces_ % kStep] = offset;
  steps_.back().mask[pieces_ % kStep] = mask;
  ++pieces_;
}

// each(offset, known, mask) for the pieces with bits.
template <class Each>
void InputBits::eachPiece(Each each) const {
  for (size_t i = 0; i < pieces_; ++i) {
    const Step& step = steps_[i / kStep];
    each(step.offset[i % kStep], std::bit_cast<std::array<uint8_t, kPiece>>(step.known[i % kStep]),
         std::bit_cast<std::array<uint8_t, kPiece>>(step.mask[i % kStep]));
  }
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
  eachPiece([&](uint32_t offset, const auto& known, const auto& mask) {
    const auto first = static_cast<size_t>(std::ranges::find_if(mask, [](uint8_t m) { return m != 0; }) - mask.begin());
    writer.put(Event::Input, offset + first, kPiece - first);
    writer.putBytes(std::span(known).subspan(first));
  });
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
  for (size_t i = 0; i < pieces_; ++i) {
    Step& step = steps_[i / kStep];
    auto known = std::bit_cast<std::array<uint8_t, kPiece>>(step.known[i % kStep]);
    const auto mask = std::bit_cast<std::array<uint8_t, kPiece>>(step.mask[i % kStep]);
    const uint64_t from = step.offset[i % kStep];
    const uint64_t end = std::min<uint64_t>(offset + bytes.size(), from + kPiece);
    for (uint64_t at = std::max(offset, from); at < end; ++at) known[at - from] = bytes[at - offset] & mask[at - from];
    step.known[i % kStep] = std::bit_cast<Words>(known);
  }
}

} // namespace rung::runtime

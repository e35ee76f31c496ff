// The NC's view of a program's memory: its side of the NC area (the time-slice memory TS), by signals that are looked
// up once, and the words of the PLC memory M. Nothing here allocates after construction.
#pragma once
#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <span>
#include <string_view>

#include "rtlib/run/instance.h"

namespace rung::nc::nct {

// The place of a signal of signals.csv, looked up by the constructor. An unknown name aborts the process, because the
// names come from this code only.
class SignalPlace {
public:
  uint32_t count() const { return count_; }

protected:
  explicit SignalPlace(std::string_view name);
  friend class SignalMemory;

  uint32_t byte_ = 0;
  uint32_t stride_ = 0; // bytes from axis to axis, from channel to channel …
  uint32_t count_ = 0;
  uint8_t bit_ = 0;
};

struct BitSignal : SignalPlace {
  explicit BitSignal(std::string_view name) : SignalPlace(name) {}
  // The bit in its word (SignalMemory::wordOf).
  uint32_t mask() const { return uint32_t{1} << bit_; }
  bool in(uint32_t word) const { return ((word >> bit_) & 1) != 0; }
  uint32_t as(bool value) const { return uint32_t{value} << bit_; }

  // The mask of several signals, which must be in one word; else the process is aborted.
  static uint32_t masks(std::span<const BitSignal> signals);
  static uint32_t masks(std::initializer_list<BitSignal> signals) {
    return masks(std::span(signals.begin(), signals.size()));
  }
};
struct WordSignal : SignalPlace {
  explicit WordSignal(std::string_view name) : SignalPlace(name) {}
  uint32_t bytes() const { return count_ * 4; } // of all elements, which are adjacent
};
struct RealSignal : SignalPlace {
  explicit RealSignal(std::string_view name) : SignalPlace(name) {}
};

// A packed space in the memory block; 0 bytes if the program does not have it, or not packed.
struct PackedSpace {
  PackedSpace() = default;
  PackedSpace(const rung_program& program, std::string_view name);

  uint32_t offset = 0;
  uint32_t bytes = 0;
};
inline constexpr std::string_view kTimeSliceSpace = "TS"; // the compiler keeps it packed (packedOnly)

// `index` counts axes, spindles, channels … from 0. Outside the table reads give 0 and writes do nothing.
class SignalMemory {
public:
  SignalMemory() = default;
  explicit SignalMemory(runtime::Instance& instance)
      : SignalMemory(instance, PackedSpace(instance.program(), kTimeSliceSpace)) {}
  SignalMemory(runtime::Instance& instance, const PackedSpace& timeSlice)
      : area_(instance.block().data() + timeSlice.offset), size_(timeSlice.bytes) {}

  bool get(const BitSignal& signal, uint32_t index = 0) const { return signal.in(wordOf(signal, index)); }
  int32_t get(const WordSignal& signal, uint32_t index = 0) const { return load<int32_t>(signal, index); }
  double get(const RealSignal& signal, uint32_t index = 0) const { return load<double>(signal, index); }

  void set(const BitSignal& signal, uint32_t index, bool value) const {
    setBits(signal, index, signal.mask(), signal.as(value));
  }
  void set(const BitSignal& signal, bool value) const { set(signal, 0, value); }
  // Read the word that holds a bit, and write several bits of it at once: those of the mask.
  uint32_t wordOf(const BitSignal& signal, uint32_t index = 0) const { return load<uint32_t>(signal, index); }
  void setBits(const BitSignal& oneOf, uint32_t index, uint32_t mask, uint32_t bits) const {
    store(oneOf, index, (load<uint32_t>(oneOf, index) & ~mask) | bits);
  }
  // All words of a signal, which are adjacent; empty if the area does not contain all of them.
  std::span<const uint8_t> all(const WordSignal& signal) const {
    const bool isThere = signal.byte_ + signal.bytes() <= size_ && (signal.stride_ == 4 || signal.count_ == 1);
    return isThere ? std::span<const uint8_t>(area_ + signal.byte_, signal.bytes()) : std::span<const uint8_t>();
  }
  void set(const WordSignal& signal, uint32_t index, int32_t value) const { store(signal, index, value); }
  void set(const RealSignal& signal, uint32_t index, double value) const { store(signal, index, value); }

  // A bit of a word of the NC area by its address.
  bool bit(uint32_t address, uint32_t bit) const { return ((static_cast<uint32_t>(word(address)) >> bit) & 1) != 0; }
  void setBit(uint32_t address, uint32_t bit, bool value) const {
    if (address >= size_ / 4) return;
    const uint32_t mask = uint32_t{1} << bit;
    const uint32_t before = static_cast<uint32_t>(word(address));
    const uint32_t after = value ? before | mask : before & ~mask;
    std::memcpy(area_ + size_t{address} * 4, &after, sizeof after);
  }

  uint32_t words() const { return size_ / 4; } // of the NC area: PLCNVRAM
  int32_t word(uint32_t address) const;        // as SCP's DirectPlcInt reads it
  double real(uint32_t address) const;

private:
  template <class T>
  T load(const SignalPlace& signal, uint32_t index) const {
    T value{};
    const uint32_t at = signal.byte_ + index * signal.stride_;
    if (index < signal.count_ && at + sizeof value <= size_) std::memcpy(&value, area_ + at, sizeof value);
    return value;
  }
  template <class T>
  void store(const SignalPlace& signal, uint32_t index, T value) const {
    const uint32_t at = signal.byte_ + index * signal.stride_;
    if (index < signal.count_ && at + sizeof value <= size_) std::memcpy(area_ + at, &value, sizeof value);
  }

  uint8_t* area_ = nullptr;
  uint32_t size_ = 0; // bytes
};

// Bits of one word of the NC's side that change together: the constructor reads them, `write` writes them.
class SignalWord {
public:
  // The word of `signal`.
  SignalWord(const SignalMemory& memory, const BitSignal& signal)
      : memory_(memory), place_(signal), bits_(memory.wordOf(signal)) {}

  // Access to signals of the same word.
  bool get(const BitSignal& signal) const { return signal.in(bits_); }
  void set(const BitSignal& signal, bool value) { bits_ = (bits_ & ~signal.mask()) | signal.as(value); }
  void write() const { memory_.setBits(place_, 0, UINT32_MAX, bits_); }

private:
  const SignalMemory& memory_;
  const BitSignal& place_;
  uint32_t bits_;
};

// The words 0000 to 9999 as the program sees them. MR and MW transfer bulk data here directly, between two scans.
class PlcMemory {
public:
  static constexpr uint32_t kWords = 10000;

  PlcMemory() = default;
  explicit PlcMemory(runtime::Instance& instance);

  uint32_t plcNvram() const { return plcNvram_; } // where the user's words begin
  bool contains(int64_t address, int64_t words) const {
    return address >= 0 && words >= 0 && address + words <= kWords;
  }
  int32_t word(uint32_t address) const;
  void setWord(uint32_t address, int32_t value) const;
  double real(uint32_t address) const;
  bool bit(uint32_t address, uint32_t bit) const;

private:
  uint64_t read(uint32_t address, uint32_t bytes) const;

  const rung_program* program_ = nullptr;
  uint8_t* block_ = nullptr;
  uint32_t space_ = RUNG_NONE;
  uint32_t plcNvram_ = 0;
};

} // namespace rung::nc::nct

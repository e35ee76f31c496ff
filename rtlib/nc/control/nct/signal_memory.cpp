// Places of signals, the NC area and the PLC memory (see signal_memory.h).
#include "rtlib/nc/control/nct/signal_memory.h"

#include <bit>
#include <stdexcept>
#include <string>

#include "rtlib/load/program_info.h"
#include "rtlib/nc/nct/signals.h"

namespace rung::nc::nct {

SignalPlace::SignalPlace(std::string_view name) {
  const Signal* found = findSignal(nctSignals(), name);
  if (found == nullptr) throw std::logic_error("NCT has no signal " + std::string(name));
  byte_ = found->byteOffset;
  stride_ = found->strideBytes;
  count_ = found->count;
  bit_ = found->bit;
}

uint32_t BitSignal::masks(std::span<const BitSignal> signals) {
  uint32_t bits = 0;
  for (const BitSignal& signal : signals) {
    if (signal.byte_ != signals.front().byte_) throw std::logic_error("the signals are not in one byte");
    bits |= signal.mask();
  }
  return bits;
}

PackedSpace::PackedSpace(const rung_program& program, std::string_view name) {
  const uint32_t number = runtime::findSpace(program, name);
  if (number == RUNG_NONE) return;
  const rung_space& space = program.spaces[number];
  if (space.range_count != 1 || space.ranges[0].repr != RUNG_REPR_PACKED) return;
  offset = space.ranges[0].offset;
  bytes = space.byte_count;
}

int32_t SignalMemory::word(uint32_t address) const {
  int32_t value = 0;
  if (address < size_ / 4) std::memcpy(&value, area_ + size_t{address} * 4, sizeof value);
  return value;
}

double SignalMemory::real(uint32_t address) const {
  double value = 0;
  if (address + 1 < size_ / 4) std::memcpy(&value, area_ + size_t{address} * 4, sizeof value);
  return value;
}

PlcMemory::PlcMemory(runtime::Instance& instance)
    : program_(&instance.program()), block_(instance.block().data()),
      space_(runtime::findSpace(instance.program(), "M")), plcNvram_(SignalMemory(instance).words()) {}

uint64_t PlcMemory::read(uint32_t address, uint32_t bytes) const {
  if (space_ == RUNG_NONE || address >= kWords) return 0;
  return core::Memory(*program_, block_).read(space_, address * 4, bytes);
}

int32_t PlcMemory::word(uint32_t address) const { return static_cast<int32_t>(read(address, 4)); }

double PlcMemory::real(uint32_t address) const { return std::bit_cast<double>(read(address, 8)); }

bool PlcMemory::bit(uint32_t address, uint32_t bit) const { return bit < 32 && ((word(address) >> bit) & 1) != 0; }

void PlcMemory::setWord(uint32_t address, int32_t value) const {
  if (space_ == RUNG_NONE || address >= kWords) return;
  core::Memory(*program_, block_).write(space_, address * 4, 4, static_cast<uint32_t>(value));
}

} // namespace rung::nc::nct

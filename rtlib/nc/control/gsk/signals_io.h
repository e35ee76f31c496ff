// Access of the CNC to the areas of a GSK25i program: it reads X and G and writes F. An area that the program does not
// have reads 0 and takes nothing. The instance outlives it.
#pragma once
#include "rtlib/host/program_info.h"

#include "rtlib/host/instance.h"

namespace rung::nc::gsk {

struct Areas {
  explicit Areas(const rung_program& program)
      : x(host::findSpace(program, "X")), f(host::findSpace(program, "F")), g(host::findSpace(program, "G")) {}

  uint32_t x, f, g; // RUNG_NONE: the program does not have it
};

class SignalsIo {
public:
  explicit SignalsIo(host::Instance& instance) : SignalsIo(instance, Areas(instance.program())) {}
  SignalsIo(host::Instance& instance, const Areas& areas)
      : memory_(instance.memory()), x_(areas.x), f_(areas.f), g_(areas.g) {}

  bool x(uint32_t byte, uint32_t bit) const { return ((get(x_, byte, 1) >> bit) & 1) != 0; }
  bool g(uint32_t byte, uint32_t bit) const { return ((get(g_, byte, 1) >> bit) & 1) != 0; }
  uint8_t gByte(uint32_t byte) const { return static_cast<uint8_t>(get(g_, byte, 1)); }
  uint16_t gWord(uint32_t byte) const { return static_cast<uint16_t>(get(g_, byte, 2)); }
  uint32_t gDword(uint32_t byte) const { return static_cast<uint32_t>(get(g_, byte, 4)); }
  bool f(uint32_t byte, uint32_t bit) const { return ((get(f_, byte, 1) >> bit) & 1) != 0; }
  uint32_t fDword(uint32_t byte) const { return static_cast<uint32_t>(get(f_, byte, 4)); }

  void setF(uint32_t byte, uint32_t bit, bool value) const {
    if (f_ != RUNG_NONE) memory_.writeBit(f_, byte, bit, value);
  }
  void setFByte(uint32_t byte, uint8_t value) const { put(byte, 1, value); }
  void setFWord(uint32_t byte, uint16_t value) const { put(byte, 2, value); }
  void setFDword(uint32_t byte, uint32_t value) const { put(byte, 4, value); }

private:
  uint64_t get(uint32_t space, uint32_t byte, uint32_t size) const {
    return space == RUNG_NONE ? 0 : memory_.read(space, byte, size);
  }
  void put(uint32_t byte, uint32_t size, uint64_t value) const {
    if (f_ != RUNG_NONE) memory_.write(f_, byte, size, value);
  }

  rt::Memory memory_;
  uint32_t x_;
  uint32_t f_;
  uint32_t g_;
};

} // namespace rung::nc::gsk

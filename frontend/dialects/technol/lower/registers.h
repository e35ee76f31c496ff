// The registers RLO, DR, DR_REAL, BX and the stack within one rung: values of the rung, read from their slots on first
// use and written back at the rung's end if they changed. DR is kept in pieces: an operation on w bits replaces only
// the low part (man. l.1034), and the 64 bits are combined when they are needed.
//
// No function here may be called inside an open region of the builder: values made there are not valid after it.
#pragma once

#include <array>

#include "frontend/dialects/technol/check/typed.h"
#include "ir/core/builder.h"

namespace rung::frontend::technol {

// The slots of the registers, one set per module.
struct RegisterSlots {
  ir::SlotId rlo, dr, real, bx;
  std::array<ir::SlotId, kStackDepth> stack;
};
RegisterSlots makeRegisterSlots(ir::Module& module);

class Registers {
public:
  explicit Registers(const RegisterSlots& slots) : slots_(slots) {}

  // Begins a new rung: only the contents of the slots are known.
  void begin(ir::RungBuilder& builder);
  // Writes changed registers back; the values can still be read by the transfer.
  void flush();

  // Sets all registers to 0, as at the beginning of a module.
  void clear();

  ir::ValueId rlo();
  void setRlo(ir::ValueId value);
  // The low part of DR.
  ir::ValueId dr(ir::Type type);
  // DR := value, sign-extended.
  void setDr(ir::ValueId value);
  // Changes only the low part.
  void setDrPart(ir::ValueId value);
  ir::ValueId real();
  // DR_REAL := value, DR := its integer (man. l.726, l.1550).
  void setReal(ir::ValueId value);
  ir::ValueId bx(); // i32
  void setBx(ir::ValueId value);
  ir::ValueId stack(uint32_t level);
  void setStack(uint32_t level, ir::ValueId value);

private:
  struct Cell {
    ir::ValueId value;
    bool changed = false;
  };
  // The relation of `low` to the rest of DR.
  enum class Part : uint8_t { None, Signed, Merged, Pending };

  ir::ValueId get(Cell& cell, ir::SlotId slot);
  void set(Cell& cell, ir::ValueId value);
  void put(Cell& cell, ir::SlotId slot);
  ir::ValueId whole();

  const RegisterSlots& slots_;
  ir::RungBuilder* b_ = nullptr;
  Cell rlo_, real_, bx_;
  std::array<Cell, kStackDepth> stack_;
  Cell dr_; // 64 bits, without a pending part
  ir::ValueId low_;
  ir::Type lowType_ = ir::Type::None;
  Part part_ = Part::None;
};

} // namespace rung::frontend::technol

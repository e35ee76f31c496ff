// The structures INOUTS of the units on CAN, by the names under which the control shares them (man. l.13872,
// l.14120-14384): InputOutput_CAN2_i, Panel_CAN2_i, Knob_CAN2_i, i from 0, with the elements INOUT_IN[k],
// INOUT_IN0[bit], INOUT_MODE, ... Writing inputs, keys, potentiometers and encoders sets their physical state;
// INOUT_OUT is the state of the output terminals; the other elements are the control's data about the unit.
#pragma once
#include <optional>
#include <string>
#include <string_view>

#include "sim/simulated_nc.h"
#include "sim/technol/devices/can_bus.h"

namespace rung::sim::technol {

class UnitCell {
public:
  struct Element; // an element of INOUTS
  // Parses a name; nothing for names of other cells.
  static std::optional<UnitCell> named(std::string_view name);

  // Returns "", or why the existing units have no such cell.
  std::string problem(const CanDevices& can) const;
  // For a cell without a problem.
  NcCell read(const CanDevices& can) const;
  // Returns "", or the error.
  std::string write(CanDevices& can, CanInputs& inputs, const NcCell& value) const;

private:
  UnitCell(uint32_t group, uint32_t board) : group_(group), board_(board) {}
  void takeElement(std::string_view text);
  uint8_t* wiredByte(CanDevices& can, CanInputs& inputs) const;

  uint32_t group_ = 0, board_ = 0;   // from 1
  const Element* element_ = nullptr; // null: INOUTS does not have the element
  uint32_t index_ = 0;
  std::optional<uint32_t> bit_;
};

} // namespace rung::sim::technol

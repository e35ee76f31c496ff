// The structures INOUTS of the units on CAN, by the names under which the control shares them (man. l.13872,
// l.14120-14384): InputOutput_CAN2_i, Panel_CAN2_i, Knob_CAN2_i, i from 0, with the elements INOUT_IN[k],
// INOUT_IN0[bit], INOUT_MODE, ... What is physically there is set by them: inputs, keys, potentiometers, encoders;
// INOUT_OUT is what is at the terminals of the outputs, all else what the control knows of the unit.
#pragma once
#include <optional>
#include <string>
#include <string_view>

#include "sim/simulated_nc.h"
#include "sim/technol/devices/can_bus.h"

namespace rung::sim::technol {

class UnitCell {
public:
  struct Element; // of INOUTS
  // Nothing: a name of something else.
  static std::optional<UnitCell> named(std::string_view name);

  // "" or why the units that exist have no such cell.
  std::string problem(const CanDevices& can) const;
  // Of a cell without a problem.
  NcCell read(const CanDevices& can) const;
  // "" or what is wrong.
  std::string write(CanDevices& can, CanInputs& inputs, const NcCell& value) const;

private:
  UnitCell(uint32_t group, uint32_t board) : group_(group), board_(board) {}
  void takeElement(std::string_view text);
  uint8_t* wiredByte(CanDevices& can, CanInputs& inputs) const;

  uint32_t group_ = 0, board_ = 0;   // from 1
  const Element* element_ = nullptr; // null: INOUTS has no such element
  uint32_t index_ = 0;
  std::optional<uint32_t> bit_;
};

} // namespace rung::sim::technol

// Looking up cells by name, their values, and the host's variables that are bound to them.
#pragma once
#include "rtlib/api/instance.h"

namespace rung::api {

// Looks up a cell. The result is a status; an error has a sentence.
int32_t findCell(rung_instance& instance, const rung_program& program, const char* name, int32_t access,
                 rung_cell& cell);
// Reports that the running program has no place of this name.
int32_t failName(const rung_program& program, const char* name) noexcept;

// The value of a bit (0 or 1) or of an integer, sign-extended.
inline int64_t valueOf(const core::Memory& memory, const core::Place& place) noexcept {
  return place.width() == 1 ? static_cast<int64_t>(memory.read(place)) : memory.readSigned(place);
}

inline rung_value valueAt(const core::Memory& memory, const core::Place& place) noexcept {
  rung_value value;
  if (place.real)
    value.real = memory.readReal(place);
  else
    value.integer = valueOf(memory, place);
  return value;
}

// The value of the first element.
inline rung_value firstValue(const core::Memory& memory, const LocatedCell& cell) noexcept {
  if (cell.ref.kind == runtime::RefKind::Constant) return {.integer = cell.ref.constant};
  return valueAt(memory, cell.place);
}

// Variables of the host that are bound to cells (rung_instance_bind). readInputs and writeOutputs: scan thread.

void readInputs(rung_instance& instance) noexcept;
void writeOutputs(rung_instance& instance) noexcept;

// The width in bytes.
uint32_t widthOf(rung_host_type type) noexcept;
// Looks up the cell for a variable to or from the program; errors as of rung_instance_bind.
int32_t findVariable(rung_instance& instance, const rung_variable& variable, bool input, rung_cell& cell);

} // namespace rung::api

// Variables of the host that are bound to cells (rung_instance_bind).
#pragma once
#include "rtlib/api/instance.h"

namespace rung::api {

void readInputs(rung_instance& instance) noexcept;
void writeOutputs(rung_instance& instance) noexcept;

// In bytes.
uint32_t widthOf(rung_host_type type) noexcept;
// The cell of a variable to or from the program; errors as of rung_instance_bind.
int32_t findVariable(rung_instance& instance, const rung_variable& variable, bool input, rung_cell& cell);

} // namespace rung::api

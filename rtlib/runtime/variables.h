// Variables of the host that are bound to cells (rung_instance_bind).
#pragma once
#include "rtlib/runtime/instance.h"

namespace rung::runtime {

void readInputs(rung_instance& instance) noexcept;
void writeOutputs(rung_instance& instance) noexcept;

} // namespace rung::runtime

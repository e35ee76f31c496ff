// Cells of the interface that the control presets: when it is switched on, and when MODULE_INIT starts.
#pragma once

#include "ir/core/builder.h"

namespace rung::frontend::technol {

void addPowerOnPresets(ir::Module& module);
void storeStartPresets(ir::RungBuilder& b);

} // namespace rung::frontend::technol

// The FANUC PMC in the table of the PMC family.
#pragma once
#include "rtlib/nc/pmc/model.h"

namespace rung::nc::fanuc {

// Always 0, always 1 (inventory §5.3, F14).
inline constexpr pmc::ConstantRelays kConstantRelays = {.inR = 9091, .inZ = 91, .mask = 0b11};

const pmc::Model& model();

} // namespace rung::nc::fanuc

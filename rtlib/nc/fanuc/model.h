// The FANUC PMC in the table of the PMC family.
#pragma once
#include "rtlib/nc/pmc/model.h"

namespace rung::nc::fanuc {

const pmc::Model& model();

} // namespace rung::nc::fanuc

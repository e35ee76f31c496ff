// The GSK25i in the table of the PMC family.
#pragma once
#include "rtlib/nc/pmc/model.h"

namespace rung::nc::gsk {

const pmc::Model& model();

} // namespace rung::nc::gsk

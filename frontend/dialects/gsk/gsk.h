// The dialect of the GSK25iMc / GSK25iTc PLC: command lists (.pmc) and ladder text (.lad).
#pragma once
#include "frontend/dialects/dialect.h"

namespace rung::frontend::gsk {

extern const frontend::Dialect kGsk;

} // namespace rung::frontend::gsk

// The FANUC PMC as a dialect.
#pragma once
#include "frontend/dialects/dialect.h"

namespace rung::frontend::fanuc {

extern const frontend::Dialect kFanuc;

} // namespace rung::frontend::fanuc

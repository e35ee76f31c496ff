// The dialect TECHNOL (PLC836), the mnemonic language of the MEFI CNC8x9 controls; README.md describes its parts.
#pragma once

#include "frontend/dialects/dialect.h"

namespace rung::frontend::technol {

extern const Dialect kTechnol;

} // namespace rung::frontend::technol

// Sections of the reference page after the instructions, and what `rungc explain` says about the names of the
// interface.
#pragma once

#include <string>
#include <string_view>

#include "frontend/table/reference.h"

namespace rung::frontend::technol {

// Signals of the CNC-PLC interface by group, predefined constants, the listing, warnings.
void addReference(ReferencePage& page);
// A signal, a member of a structure (TIME_INFOS.HOUR), a predefined constant, of any case; "" when it is none.
std::string explainWord(std::string_view name);

} // namespace rung::frontend::technol

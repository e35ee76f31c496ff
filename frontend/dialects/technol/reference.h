// Sections of the reference page after the instructions, and what `rungc explain` says about the names of the
// interface.
#pragma once

#include <string>
#include <string_view>

#include "frontend/table/reference.h"

namespace rung::frontend::technol {

// Signals of the CNC-PLC interface by group, predefined constants, the listing, warnings.
void addReference(ReferencePage& page);
// The text about a signal, a member of a structure (TIME_INFOS.HOUR) or a predefined constant, in upper or lower case;
// "" for any other name.
std::string explainWord(std::string_view name);

} // namespace rung::frontend::technol

// Reads ladder text of a language (§5, P14): drawings to command lists, which are then read in the same way.
#pragma once
#include "frontend/ladder/text/ladder_file.h"
#include "frontend/network/read/context.h"
#include "frontend/network/read/units.h"

namespace rung::frontend::network {

ladder::LadderFile parseLadderFile(Context& context, FileId file);
void readLadderDeclarations(Context& context, const ladder::LadderFile& file);
void readLadder(Context& context, const ladder::LadderFile& file, UnitAssembler& units);

} // namespace rung::frontend::network

// Ladder text of this dialect (§5, P14): drawings to command lists, then the same way as command lists go.
#pragma once
#include "frontend/dialects/gsk/context.h"
#include "frontend/dialects/gsk/structure.h"
#include "frontend/ladder/ladder.h"

namespace rung::gsk {

// As ladder::FurtherPins.
std::optional<std::span<const std::string_view>> furtherPinsOfBox(std::string_view mnemonic);
ladder::LadderFile parseLadderFile(Context& context, FileId file);
void readLadderDeclarations(Context& context, const ladder::LadderFile& file);
void readLadder(Context& context, const ladder::LadderFile& file, UnitAssembler& units);

} // namespace rung::gsk

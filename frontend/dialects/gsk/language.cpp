// Properties of the language, according to the manual.
#include "frontend/dialects/gsk/language.h"

#include "frontend/dialects/gsk/areas.h"
#include "frontend/dialects/gsk/rows/foreign_words.h"
#include "frontend/dialects/gsk/rows/instructions.h"
#include "frontend/network/read/list_reader.h"
#include "ir/support/diag/pmc.h"
#include "rtlib/nc/gsk/signals.h"

namespace rung::frontend::gsk {

namespace {

// P3
constexpr network::Level kLevels[] = {
    {.name = "LEVEL1",
     .end = "END1",
     .turn = network::Turn::EverySlot,
     .endMissing = diag::MissingEnd1,
     .endTwice = diag::DuplicateEnd1},
    {.name = "LEVEL2",
     .end = "END2",
     .turn = network::Turn::Parts,
     .endMissing = diag::MissingEnd2,
     .endTwice = diag::DuplicateEnd2},
};

} // namespace

const network::Language kLanguage = {
    .name = "gsk",
    .listExtensions = kExtensions,
    .list = network::kCommandList,
    // man. Part I §4; the last three are Rung's (P12)
    .commands = {"LD", "LDI", "AND", "ANI", "OR", "ORI", "", "ORB", "ANB", "OUT", "OUTI", "SET", "RST", "FUNC", "PRM",
                 "TABLE", "DIALECT", "SYMBOL", "CONST"},
    .rows = networkRows(),
    .areas = kAreas,
    .signals = nc::gskSignals,
    .levels = kLevels,
    .subprogram = "SUB",
    .messageTexts = "give the texts of area A in a file: `--config messages=FILE`, or in rung.toml messages = \"FILE\"",
    .maxSteps = 12000, // man. l.354
    .stackDepth = 9,   // ST0-ST8 (P11)
    .maxCallDepth = 8, // P46
    .findBox = findBox,
    .foreign = kForeignWords,
};

} // namespace rung::frontend::gsk

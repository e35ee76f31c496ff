// The dialect nct: ladder text of NCT2xx / NCT3xx controls (manual "PLC Programming", software n.14.9).
//
// Guaranteed to the rest of the project: the tasks are MAIN and, if the program has that module, INT0; space M is the
// memory 0000 to 9999 in double words, TS the time-slice copy of the NC area. Texts of `message` statements keep their
// numbers (1 to 999), titles of `button N` are text number kButtonTexts + N.
#pragma once
#include <cstdint>

#include "frontend/dialects/dialect.h"

namespace rung::frontend::nct {

inline constexpr uint32_t kButtonTexts = 1000;

extern const frontend::Dialect kNct;

} // namespace rung::frontend::nct

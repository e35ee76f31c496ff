// Names of a TECHNOL program: SYMBOL  CELL.3  CELL.WEIGHT  NAME[2]  NAME[2].3  NAME+4  NAME:2  WORD.NAME  REAL.NAME;
// spaces "DATA" and "NCI". Case does not count, and of a symbol 31 characters do.
#pragma once
#include "rtlib/nc/names/grammar.h"

namespace rung::nc {

const NameGrammar& technolNames();

} // namespace rung::nc

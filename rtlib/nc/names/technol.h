// Names of a TECHNOL program: SYMBOL CELL.3 CELL.WEIGHT NAME[2] NAME[2].3 NAME+4 NAME:2 WORD.NAME REAL.NAME; spaces
// "DATA" and "NCI". Names are not case-sensitive, and only the first 31 characters of a symbol count.
#pragma once
#include "rtlib/nc/names/grammar.h"

namespace rung::nc {

const NameGrammar& technolNames();

} // namespace rung::nc

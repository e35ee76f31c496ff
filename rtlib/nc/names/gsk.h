// Names of a GSK program: X002.1  D10  D10:2  SYMBOL  SYMBOL.3  SYMBOL:2; the areas are the spaces X Y F G R K A C T D.
#pragma once
#include "rtlib/nc/names/grammar.h"

namespace rung::nc {

const NameGrammar& gskNames();

} // namespace rung::nc

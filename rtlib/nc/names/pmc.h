// Names of a program of the PMC family: X002.1  D10  D10:2  SYMBOL  SYMBOL.3  SYMBOL:2; an area is the space with its
// letter.
#pragma once
#include "rtlib/nc/names/grammar.h"

namespace rung::nc {

const NameGrammar& gskNames();
const NameGrammar& fanucNames(); // in either case

} // namespace rung::nc

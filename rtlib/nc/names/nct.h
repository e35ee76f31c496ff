// Names of an NCT program: 0056  0056.17  SYM  SYM.05  SYM,#3  SYM,KCONST  7100,#3  !OUT000.03; the space "M", with !
// the space "TS" (the time-slice memory).
#pragma once
#include "rtlib/nc/names/grammar.h"

namespace rung::nc {

const NameGrammar& nctNames();

} // namespace rung::nc

// Names of an NCT program: 0056  0056.17  FLAGS  SYM  SYM.05  SYM,#3  SYM,KCONST  7100,#3  !OUT000.03  REAL.7000 (the
// real in words 7000 and 7001); the space "M", with ! the space "TS" (the time-slice memory). Words and bits of
// the NC area are shown by the names of its signals.
#pragma once
#include "rtlib/nc/names/grammar.h"

namespace rung::nc {

const NameGrammar& nctNames();

// The place of "M" that the NC accesses: in the time-slice memory if the program has its words twice, else the same
// place. Words 0000 and 0001 belong to the program in both.
runtime::Ref nctTimeSlicePlace(const rung_program& program, const runtime::Ref& place);

// The place in "M" of a signal of the NC: all its elements; for a bit the first one.
std::optional<runtime::Ref> nctSignalPlace(const rung_program& program, std::string_view name);

} // namespace rung::nc

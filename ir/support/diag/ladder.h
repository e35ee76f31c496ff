// Codes of drawn ladders: an entry of ladder.def each.
#pragma once
#define RUNG_DIAG_FAMILY Ladder
#define RUNG_DIAG_ENTRIES "ir/support/diag/ladder.def"
#include "ir/support/diag/codes.inc"

// Codes of drawn ladders, one per entry of ladder.def.
#pragma once
#define RUNG_DIAG_FAMILY Ladder
#define RUNG_DIAG_ENTRIES "ir/support/diag/ladder.def"
#include "ir/support/diag/codes.inc"

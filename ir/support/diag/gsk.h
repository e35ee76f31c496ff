// Codes of GSK's rules, one per entry of gsk.def.
#pragma once
#define RUNG_DIAG_FAMILY Gsk
#define RUNG_DIAG_ENTRIES "ir/support/diag/gsk.def"
#include "ir/support/diag/codes.inc"

// Codes of TECHNOL's rules, one per entry of technol.def.
#pragma once
#define RUNG_DIAG_FAMILY Technol
#define RUNG_DIAG_ENTRIES "ir/support/diag/technol.def"
#include "ir/support/diag/codes.inc"

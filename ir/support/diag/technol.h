// Codes of TECHNOL's rules: an entry of technol.def each.
#pragma once
#define RUNG_DIAG_FAMILY Technol
#define RUNG_DIAG_ENTRIES "ir/support/diag/technol.def"
#include "ir/support/diag/codes.inc"

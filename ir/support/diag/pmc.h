// Codes of the PMC family's rules, one per entry of pmc.def.
#pragma once
#define RUNG_DIAG_FAMILY Pmc
#define RUNG_DIAG_ENTRIES "ir/support/diag/pmc.def"
#include "ir/support/diag/codes.inc"

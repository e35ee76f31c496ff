// Codes of NCT's rules, one per entry of nct.def.
#pragma once
#define RUNG_DIAG_FAMILY Nct
#define RUNG_DIAG_ENTRIES "ir/support/diag/nct.def"
#include "ir/support/diag/codes.inc"

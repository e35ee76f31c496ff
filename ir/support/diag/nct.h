// Codes of NCT's rules: an entry of nct.def each.
#pragma once
#define RUNG_DIAG_FAMILY Nct
#define RUNG_DIAG_ENTRIES "ir/support/diag/nct.def"
#include "ir/support/diag/codes.inc"

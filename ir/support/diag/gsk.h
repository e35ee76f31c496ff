// Codes of GSK's rules: an entry of gsk.def each.
#pragma once
#define RUNG_DIAG_FAMILY Gsk
#define RUNG_DIAG_ENTRIES "ir/support/diag/gsk.def"
#include "ir/support/diag/codes.inc"

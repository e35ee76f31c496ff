// Codes of program structure, labels and calls, one per entry of structure.def.
#pragma once
#define RUNG_DIAG_FAMILY Structure
#define RUNG_DIAG_ENTRIES "ir/support/diag/structure.def"
#include "ir/support/diag/codes.inc"

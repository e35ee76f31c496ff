// Codes of names, addresses and operands, one per entry of operand.def.
#pragma once
#define RUNG_DIAG_FAMILY Operand
#define RUNG_DIAG_ENTRIES "ir/support/diag/operand.def"
#include "ir/support/diag/codes.inc"

// Codes of names, addresses and operands: an entry of operand.def each.
#pragma once
#define RUNG_DIAG_FAMILY Operand
#define RUNG_DIAG_ENTRIES "ir/support/diag/operand.def"
#include "ir/support/diag/codes.inc"

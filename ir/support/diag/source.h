// Codes of files, characters and limits, one per entry of source.def.
#pragma once
#define RUNG_DIAG_FAMILY Source
#define RUNG_DIAG_ENTRIES "ir/support/diag/source.def"
#include "ir/support/diag/codes.inc"

// Codes of project files, one per entry of project.def.
#pragma once
#define RUNG_DIAG_FAMILY Project
#define RUNG_DIAG_ENTRIES "ir/support/diag/project.def"
#include "ir/support/diag/codes.inc"

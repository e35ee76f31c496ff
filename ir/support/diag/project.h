// Codes of project files: an entry of project.def each.
#pragma once
#define RUNG_DIAG_FAMILY Project
#define RUNG_DIAG_ENTRIES "ir/support/diag/project.def"
#include "ir/support/diag/codes.inc"

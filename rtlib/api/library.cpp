// The library itself: its version, and its sentences.
#include "rtlib/api/error.h"

const char* rung_error_text(void) { return rung::api::errorText(); }

uint32_t rung_runtime_version(void) { return RUNG_RUNTIME_MAJOR << 16 | RUNG_RUNTIME_MINOR; }

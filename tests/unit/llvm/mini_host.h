/* The smallest host: runs a program's main task and makes one number of all that the program did. Plain C without any
 * library, so that the same text runs here and on every processor that can be emulated. */
#ifndef RUNG_TESTS_MINI_HOST_H
#define RUNG_TESTS_MINI_HOST_H

#include "rung/program.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { kMiniHostMemory = 1 << 20, kMiniHostRungs = 4096 };

/* Cold start and `scans` runs of the main task; hashes[i] covers memory, fault, counters, messages and service calls
 * after run i. `engine` goes into the context. Returns 0, or 1 when the program is too large for this host. */
int miniHostRun(const rung_program* program, void* engine, uint32_t scans, uint64_t* hashes);

#ifdef __cplusplus
}
#endif

#endif

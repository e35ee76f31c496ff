/* mini_host FILE.so SCANS: prints a line for each scan; the hash of all that the program did (see mini_host.h). */
#include <dlfcn.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

#include "mini_host.h"

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  const uint32_t scans = (uint32_t)atoi(argv[2]);
  void* library = dlopen(argv[1], RTLD_NOW | RTLD_LOCAL);
  const rung_program* program = library ? dlsym(library, RUNG_PROGRAM_SYMBOL) : NULL;
  if (!program) {
    fprintf(stderr, "%s\n", dlerror());
    return 1;
  }
  uint64_t* hashes = calloc(scans, sizeof *hashes);
  if (!hashes || miniHostRun(program, NULL, scans, hashes)) return 1;
  for (uint32_t i = 0; i < scans; ++i) printf("%016" PRIx64 "\n", hashes[i]);
  return 0;
}

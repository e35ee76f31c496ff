// libFuzzer target: any bytes as NCT ladder text; a byte 0x0C begins the next file of the program.
#include "frontend/dialects/nct/nct.h"
#include "tests/fuzz/compile_bytes.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  rung::fuzz::compileBytes(rung::frontend::nct::kNct, ".lad", '\f', data, size);
  return 0;
}

// libFuzzer target: any bytes as TECHNOL text; a byte 0x01 begins the next file of the program.
#include "frontend/dialects/technol/technol.h"
#include "tests/fuzz/compile_bytes.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  rung::fuzz::compileBytes(rung::frontend::technol::kTechnol, ".plc", '\x01', data, size);
  return 0;
}

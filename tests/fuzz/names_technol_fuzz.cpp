// libFuzzer target: any bytes as TECHNOL text, for what tools ask of its names; a byte 0x01 begins the next file of the
// program.
#include "frontend/dialects/technol/technol.h"
#include "tests/fuzz/names_bytes.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  rung::fuzz::nameBytes(rung::frontend::technol::kTechnol, ".plc", '\x01',
                        std::string(reinterpret_cast<const char*>(data), size));
  return 0;
}

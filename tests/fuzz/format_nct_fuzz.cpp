// libFuzzer target: any bytes as NCT ladder text, laid out; a byte 0x0C begins the next file of the program.
#include "frontend/dialects/nct/nct.h"
#include "tests/fuzz/format_bytes.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  rung::fuzz::formatBytes(rung::frontend::nct::kNct, ".lad", '\f',
                          std::string(reinterpret_cast<const char*>(data), size));
  return 0;
}

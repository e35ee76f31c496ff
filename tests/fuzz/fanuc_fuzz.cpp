// libFuzzer target: any bytes as a FANUC program, a mnemonic file or, beginning with "dialect fanuc", ladder text; a
// byte 0x0C begins the next file of the program.
#include <string_view>

#include "frontend/dialects/fanuc/fanuc.h"
#include "tests/fuzz/compile_bytes.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const std::string_view extension = text.starts_with("dialect fanuc") ? ".lad" : ".mne";
  rung::fuzz::compileBytes(rung::frontend::fanuc::kFanuc, extension, '\f', data, size);
  return 0;
}

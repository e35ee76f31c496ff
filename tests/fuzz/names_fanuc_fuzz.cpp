// libFuzzer target: any bytes as a FANUC program, for what tools ask of its names; a byte 0x0C begins the next file of
// the program.
#include "frontend/dialects/fanuc/fanuc.h"
#include "tests/fuzz/names_bytes.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  const std::string_view extension = text.starts_with("dialect fanuc") ? ".lad" : ".mne";
  rung::fuzz::nameBytes(rung::frontend::fanuc::kFanuc, extension, '\f', text);
  return 0;
}

// libFuzzer target: any bytes as GSK text, for what tools ask of its names; a byte 0x0C begins the next file of the
// program.
#include "frontend/dialects/gsk/gsk.h"
#include "tests/fuzz/names_bytes.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  rung::fuzz::nameBytes(rung::frontend::gsk::kGsk, text.starts_with("dialect gsk") ? ".lad" : ".pmc", '\f', text);
  return 0;
}

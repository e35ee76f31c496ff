// libFuzzer target: any bytes as a GSK program, a command list or, beginning with "dialect gsk", ladder text, laid out.
#include "frontend/dialects/gsk/gsk.h"
#include "tests/fuzz/format_bytes.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  rung::fuzz::formatBytes(rung::frontend::gsk::kGsk, text.starts_with("dialect gsk") ? ".lad" : ".pmc", '\x01', text);
  return 0;
}

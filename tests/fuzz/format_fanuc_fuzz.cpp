// libFuzzer target: any bytes as a FANUC program, a mnemonic file or, beginning with "dialect fanuc", ladder text, laid
// out; a byte 0x0C begins the next file of the program.
#include "frontend/dialects/fanuc/fanuc.h"
#include "rtlib/text/end_of_file.h"
#include "tests/fuzz/format_bytes.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string_view whole(reinterpret_cast<const char*>(data), size);
  const std::string text(rung::text::upToEndOfFile(whole)); // as files are read
  const std::string_view extension = text.starts_with("dialect fanuc") ? ".lad" : ".mne";
  rung::fuzz::formatBytes(rung::frontend::fanuc::kFanuc, extension, '\f', text);
  return 0;
}

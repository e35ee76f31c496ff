// libFuzzer target: any bytes as TECHNOL text; a byte 0x01 begins the next file of the program. What compiles is
// valid and prints as a text that parses back.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include "frontend/dialects/technol/technol.h"
#include "ir/support/check.h"
#include "ir/support/diag_render.h"
#include "ir/text/text.h"
#include "ir/verify/verify.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace rung;
  const std::string text(reinterpret_cast<const char*>(data), size);
  SourceManager sources;
  Diagnostics diagnostics;
  std::vector<FileId> files;
  for (size_t begin = 0; begin <= text.size();) {
    const size_t end = std::min(text.find('\x01', begin), text.size());
    files.push_back(sources.addBuffer("fuzz" + std::to_string(files.size()) + ".plc", text.substr(begin, end - begin)));
    begin = end + 1;
  }
  const auto module = frontend::kTechnol.compile(sources, files, {}, diagnostics);
  renderText(diagnostics, sources);
  RUNG_CHECK((module == nullptr) == diagnostics.hasErrors(), "no module without a reason");
  if (module == nullptr) return 0;
  const auto errors = ir::verify(*module, ir::Mode::Built);
  if (!errors.empty()) std::fputs(ir::render(*module, errors).c_str(), stderr);
  RUNG_CHECK(errors.empty(), "a module that was built is valid");
  const std::string printed = ir::print(*module);
  const ir::ParseOutcome again = ir::parse(printed);
  RUNG_CHECK(again.module && ir::print(*again.module) == printed, "a module prints as what parses back");
  return 0;
}

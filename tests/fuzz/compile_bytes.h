// What the fuzz targets of dialects share: any bytes as a program of one or several files. What compiles is valid and
// prints as a text that parses back.
#pragma once
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

#include "frontend/dialects/dialect.h"
#include "ir/support/check.h"
#include "ir/support/diag_render.h"
#include "ir/text/text.h"
#include "ir/verify/verify.h"
#include "tests/fuzz/split_files.h"

namespace rung::fuzz {

// `border`: the byte that begins the next file. `extension`: of the files' names, with its dot.
inline void compileBytes(const frontend::Dialect& dialect, std::string_view extension, char border, const uint8_t* data,
                         size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  SourceManager sources;
  Diagnostics diagnostics;
  std::vector<FileId> files;
  for (const auto& [name, content] : splitFiles(text, extension, border))
    files.push_back(sources.addBuffer(name, content));
  const auto module = dialect.compile(sources, files, {}, diagnostics);
  renderText(diagnostics, sources);
  RUNG_CHECK((module == nullptr) == diagnostics.hasErrors(), "no module without a reason");
  if (module == nullptr) return;
  const auto errors = ir::verify(*module, ir::Mode::Built);
  if (!errors.empty()) std::fputs(ir::render(*module, errors).c_str(), stderr);
  RUNG_CHECK(errors.empty(), "a module that was built is valid");
  const std::string printed = ir::print(*module);
  const ir::ParseOutcome again = ir::parse(printed);
  RUNG_CHECK(again.module && ir::print(*again.module) == printed, "a module prints as what parses back");
}

} // namespace rung::fuzz

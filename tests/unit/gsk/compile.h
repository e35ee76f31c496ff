// Compiles a text of the dialect in a test.
#pragma once
#include "frontend/dialects/gsk/gsk.h"
#include "tests/support/compiled.h"

namespace rung::frontend::gsk::test {

using frontend::test::Codes;
using frontend::test::Compiled;
using frontend::test::File;
using frontend::test::listed;

inline std::unique_ptr<Compiled> compileFiles(const std::vector<File>& texts, const CompileOptions& options = {}) {
  return frontend::test::compileFiles(kGsk, texts, options);
}
inline std::unique_ptr<Compiled> compileList(const std::string& text, const CompileOptions& options = {}) {
  return compileFiles({{"test.pmc", text}}, options);
}
inline std::unique_ptr<Compiled> compileLadder(const std::string& text, const CompileOptions& options = {}) {
  return compileFiles({{"test.lad", text}}, options);
}

} // namespace rung::frontend::gsk::test

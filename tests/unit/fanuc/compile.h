// Compiles a text of the dialect in a test.
#pragma once
#include "frontend/dialects/fanuc/fanuc.h"
#include "tests/support/compiled.h"

namespace rung::frontend::fanuc::test {

using frontend::test::Codes;
using frontend::test::Compiled;
using frontend::test::File;

inline std::unique_ptr<Compiled> compileFiles(const std::vector<File>& texts, const CompileOptions& options = {}) {
  return frontend::test::compileFiles(kFanuc, texts, options);
}
inline std::unique_ptr<Compiled> compileMnemonic(const std::string& text, const CompileOptions& options = {}) {
  return compileFiles({{"test.mne", text}}, options);
}

} // namespace rung::frontend::fanuc::test

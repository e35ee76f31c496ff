// Converts a text of the dialect in a test.
#pragma once
#include <gtest/gtest.h>

#include "frontend/dialects/gsk/language.h"
#include "frontend/network/convert/convert.h"
#include "tests/unit/gsk/compile.h"

namespace rung::frontend::gsk::test {

using frontend::network::Form;

struct Converted {
  std::optional<std::string> text;
  Codes codes; // as of Compiled
};

inline Converted convertFiles(const std::vector<File>& texts, Form to) {
  Compiled state;
  std::vector<FileId> files;
  for (const File& file : texts) files.push_back(state.sources.addBuffer(file.name, file.text));
  Converted result;
  if (kGsk.compile(state.sources, files, {}, state.diagnostics) != nullptr)
    result.text = frontend::network::convertProgram(kLanguage, state.sources, files, to, state.diagnostics);
  result.codes = state.codes();
  return result;
}

// Fails the test where the program has errors.
inline std::string toLadder(const std::string& list) {
  const Converted result = convertFiles({{"test.pmc", list}}, Form::Ladder);
  EXPECT_TRUE(result.text) << ::testing::PrintToString(result.codes) << '\n' << list;
  return result.text.value_or("");
}
inline std::string toList(const std::string& ladder) {
  const Converted result = convertFiles({{"test.lad", ladder}}, Form::List);
  EXPECT_TRUE(result.text) << ::testing::PrintToString(result.codes) << '\n' << ladder;
  return result.text.value_or("");
}

} // namespace rung::frontend::gsk::test

// What becomes of files of a control, and all that is said about mistakes in them: a file of cases for each kind.
#include <gtest/gtest.h>

#include "ir/support/foreign_file.h"
#include "tests/support/cases.h"
#include "tools/imported/imported.h"
#include "tools/scenario/scenario.h"

namespace rung::imported {
namespace {

// Each statement can be read. Only then is the text a scenario.
void expectScenario(const std::string& text) {
  const scenario::Scenario read = scenario::parse("f.scn", "program main.mne\n" + text);
  for (const scenario::Problem& problem : read.problems) ADD_FAILURE() << scenario::textOf(problem) << "\n" << text;
}

Imported becomes(const std::string& kind, const Source& source) {
  if (kind == "parameters") return initialValues(source);
  if (kind == "symbols") return symbolSection(source);
  if (kind == "signals") return scenarioOfSignals(source);
  if (kind == "trace") return scenarioOfTrace(source, {.us = 8000});
  if (kind == "trace-sampling") return scenarioOfTrace(source, {.us = 4000, .tolerance = 2});
  return {.text = "there are no such files: " + kind, .remarks = {}};
}

// The file that is made, unless there is a mistake, and the remarks.
std::string resultOf(const std::string& kind, const std::string& text) {
  const Source source{.name = "f", .text = text};
  const Imported made = becomes(kind, source);
  if (made.isUsable() && kind != "symbols") expectScenario(made.text);
  std::string result = made.isUsable() ? made.text : "";
  for (const Remark& remark : made.remarks) result += textOf(source, remark) + '\n';
  return result;
}

TEST(ImportedGolden, Files) {
  test::Golden golden("tests/golden/imported", {".cases"});
  for (const std::filesystem::path& file : golden.inputs())
    test::expectCases(golden, file, [&](const test::Case& one) { return resultOf(file.stem().string(), one.input); });
}

// What is made of symbols is a file of a program: it is recognised as such, and gives the same again.
TEST(Imported, ASectionOfSymbolsIsAFileOfAProgram) {
  const Imported made = symbolSection({.name = "s.csv", .text = "START,X0010.0,\"green, closed while pressed\"\n"});
  EXPECT_EQ(foreignFile(made.text), std::nullopt) << made.text;
  EXPECT_EQ(symbolSection({.name = "s.csv", .text = made.text}).text, made.text);
}

TEST(Imported, TheEndOfFileMarkOfDosEndsAFile) {
  const Source source{.name = "f", .text = "%\nN600000 P6\n%\n\x1A\xFF"};
  EXPECT_TRUE(initialValues(source).remarks.empty());
}

} // namespace
} // namespace rung::imported

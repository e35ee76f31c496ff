// Files that are wrong, or hardly right, and all that is said about each: a file of cases for each kind.
#include <gtest/gtest.h>

#include "machine/host/control_files.h"
#include "machine/io/tables/plc_table_files.h"
#include "tests/support/cases.h"

namespace rung::host {
namespace {

// Something is read where nothing is wrong, and nothing where the one thing that is there is wrong.
std::string mistakesOf(ControlFileKind kind, const std::string& text) {
  ControlFiles files;
  std::string found = parseControlFile(kind, "f", text, files);
  EXPECT_EQ(found.empty(), !files.messages.empty() || !files.parameters.empty() || !files.constants.empty() ||
                               !files.connections.empty() || !files.terminals.empty());
  return found;
}

std::string mistakesOfDefinition(const std::string& text) {
  io::TableDefinition found{.id = "before"};
  std::string mistakes = parseTableDefinition("f", text, found);
  EXPECT_EQ(mistakes.empty(), found.id != "before");
  return mistakes;
}

std::string mistakesOfData(const std::string& text) {
  io::TableData found{.definition = "before"};
  std::string mistakes = parseTableData("f", text, found);
  EXPECT_EQ(mistakes.empty(), found.definition != "before");
  return mistakes;
}

std::string mistakesIn(const std::string& kind, const std::string& text) {
  if (kind == "messages") return mistakesOf(ControlFileKind::Messages, text);
  if (kind == "constants") return mistakesOf(ControlFileKind::Constants, text);
  if (kind == "channel") return mistakesOf(ControlFileKind::Channel, text);
  if (kind == "definition") return mistakesOfDefinition(text);
  if (kind == "data") return mistakesOfData(text);
  return "there are no such files: " + kind;
}

TEST(ControlFilesGolden, Mistakes) {
  test::Golden golden("tests/golden/io/control_files", {".cases"});
  for (const std::filesystem::path& file : golden.inputs())
    test::expectCases(golden, file, [&](const test::Case& one) { return mistakesIn(file.stem().string(), one.input); });
}

} // namespace
} // namespace rung::host

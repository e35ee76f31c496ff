// What devices refuse, and all that they say about it: a file of cases for each way to tell them something. A value
// `@N` means a text of N letters.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>

#include "ir/support/temporary_folder.h"
#include "machine/io/tables/plc_tables.h"
#include "machine/io/tables/table_files.h"
#include "sim/technol/devices/axes.h"
#include "sim/technol/devices/keyboards.h"
#include "tests/support/cases.h"
#include "tests/unit/io/materials.h"

namespace rung::io {
namespace {

std::string withLongTexts(std::string text) {
  for (size_t at; (at = text.find('@')) != std::string::npos;) {
    size_t digits = 0;
    const unsigned long letters = std::stoul(text.substr(at + 1), &digits);
    text.replace(at, digits + 1, letters, 'a');
  }
  return text;
}

// Elements of the only line of a table of materials.
std::string elements(const std::string& input) {
  PlcTables tables;
  const std::string text = "<PLCTable>\n<Definition><DefinitionID>Materials</DefinitionID><LinesCount>1</LinesCount>"
                           "</Definition>\n<Line No='0'>" +
                           withLongTexts(input) + "</Line></PLCTable>";
  std::string found = tables.load(0, test::definitionOf(test::kMaterials), test::dataOf(text));
  EXPECT_EQ(tables.exists(0), found.empty());
  return found;
}

// The ID of the only column of a table.
std::string column(const std::string& input) {
  const TableDefinition definition{
      .id = "D", .columns = {{.id = withLongTexts(input), .place = "d:3:1"}}, .place = "d:1:1"};
  return PlcTables().load(0, definition, {.definition = "D", .place = "t:2:1"});
}

// What an operator does with tables, of which number 0 has three materials: lines `edit TABLE LINE COLUMN TEXT`,
// `number TABLE LINE COLUMN VALUE`, `select TABLE LINE`, `remove TABLE LINE` and `add TABLE`.
std::string operated(PlcTables& tables, const std::string& line) {
  std::istringstream words(line);
  std::string kind, name, value;
  uint32_t table = 0, number = 0;
  words >> kind >> table >> number;
  if (kind == "add") return tables.addLine(table);
  if (kind == "select") return tables.selectByOperator(table, number);
  if (kind == "remove") return tables.removeLine(table, number);
  words >> name;
  std::getline(words >> std::ws, value);
  if (kind == "edit") return tables.edit(table, number, name, withLongTexts(value));
  if (kind == "number") return tables.edit(table, number, name, std::stod(value));
  return "(an unknown line of a case)";
}

// Lines of a case, and what is said about each with its number.
std::string linesOf(const std::string& input, const std::function<std::string(const std::string&)>& answer) {
  std::istringstream lines(input);
  std::string said;
  uint32_t number = 0;
  for (std::string line; std::getline(lines, line);) {
    const std::string text = answer(line);
    ++number;
    if (!text.empty()) said += std::to_string(number) + ": " + text + '\n';
  }
  return said;
}

std::string operatedAll(const std::string& input) {
  PlcTables tables;
  test::loadMaterials(tables);
  return linesOf(input, [&](const std::string& line) { return operated(tables, line); });
}

// Files of tables, and lines `definition NUMBER FILE` and `table NUMBER FILE` that name them. Then all are loaded.
std::string tableFiles(const std::string& input) {
  const TemporaryFolder folder;
  std::map<std::string, std::string> texts = test::filesIn(input);
  for (const auto& [name, text] : texts) std::ofstream(folder / name) << text;
  TableFiles files;
  std::string said = linesOf(texts.at("lines"), [&](const std::string& line) {
    std::istringstream words(line);
    std::string kind, file;
    uint32_t number = 0;
    words >> kind >> number >> file;
    return kind == "table" ? files.setTable(number, (folder / file).string())
                           : files.setDefinition(number, (folder / file).string());
  });
  PlcTables tables;
  said += files.load(tables);
  const std::string prefix = (folder / "").string();
  for (size_t at; (at = said.find(prefix)) != std::string::npos;) said.erase(at, prefix.size());
  return said;
}

// Lines `KEY VALUE` and `switch INDEX TEXT`. Then the whole configuration is looked at.
std::string axes(const std::string& input) {
  sim::technol::Axes axes;
  std::string said = linesOf(input, [&](const std::string& line) {
    std::istringstream words(line);
    std::string key, value;
    words >> key;
    std::getline(words >> std::ws, value);
    const size_t text = value.find(' ');
    return key == "switch" ? axes.addSwitch(std::stoul(value), value.substr(text + 1)) : axes.configure(key, value);
  });
  return said + axes.configurationProblem();
}

std::string keyboardFile(const std::string& text) {
  std::vector<host::KeyDefinition> keys;
  std::string wrong = host::parseKeyboardFile("K", text, keys);
  EXPECT_TRUE(keys.empty());
  return wrong;
}

const std::map<std::string, std::function<std::string(const std::string&)>>& listeners() {
  static const std::map<std::string, std::function<std::string(const std::string&)>> all = {
      {"axes", axes},
      {"columns", column},
      {"elements", elements},
      {"keyboards", keyboardFile},
      {"operator", operatedAll},
      {"table-files", tableFiles}};
  return all;
}

TEST(DevicesGolden, WhatIsRefused) {
  test::Golden golden("tests/golden/io/devices", {".cases"});
  for (const std::filesystem::path& file : golden.inputs()) {
    const auto& listen = listeners().at(file.stem().string());
    test::expectCases(golden, file, [&](const test::Case& one) { return listen(one.input); });
  }
}

} // namespace
} // namespace rung::io

// The instruction table against the inventory, and errors that are generated from its rows.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>

#include <gtest/gtest.h>

#include "frontend/dialects/gsk/rows/instructions.h"
#include "frontend/dialects/gsk/rows/operand_kinds.h"
#include "tests/unit/gsk/compile.h"

namespace rung::frontend::gsk::test {
namespace {

using frontend::InstructionInfo;
using frontend::OperandKindInfo;
using frontend::Output;

// Fields of one line; quotes may enclose a field.
std::vector<std::string> fieldsOf(const std::string& line) {
  std::vector<std::string> fields(1);
  bool quoted = false;
  for (char c : line) {
    if (c == '"')
      quoted = !quoted;
    else if (c == ',' && !quoted)
      fields.emplace_back();
    else
      fields.back() += c;
  }
  return fields;
}

// Entries between semicolons; those in parentheses are remarks.
size_t listLength(const std::string& field) {
  if (field.starts_with("-")) return 0;
  size_t count = 1;
  int depth = 0;
  for (char c : field) {
    depth += c == '(' ? 1 : c == ')' ? -1 : 0;
    count += c == ';' && depth == 0 ? 1 : 0;
  }
  return count;
}

TEST(GskTable, AgreesWithTheInventory) {
  std::ifstream file("tests/unit/gsk/instructions.csv");
  ASSERT_TRUE(file);
  std::string line;
  std::getline(file, line);
  std::map<std::string_view, const Row*> rows;
  for (const Row& row : allRows())
    EXPECT_TRUE(rows.emplace(row.info.mnemonic, &row).second) << row.info.mnemonic << " twice";
  while (std::getline(file, line)) {
    const std::vector<std::string> fields = fieldsOf(line);
    ASSERT_GE(fields.size(), 7u) << line;
    const auto found = rows.find(fields[0]);
    if (found == rows.end()) {
      ADD_FAILURE() << fields[0] << " is missing in the table, or twice in the inventory";
      continue;
    }
    const InstructionInfo& info = found->second->info;
    rows.erase(found);
    if (fields[1].empty()) continue; // the basic commands have a column of their own for conditions
    EXPECT_EQ(std::to_string(info.number), fields[1]) << fields[0];
    EXPECT_EQ(info.pins.size(), listLength(fields[3])) << fields[0];
    const bool table = fields[4].find("TABLE rows") != std::string::npos;
    EXPECT_EQ(info.operands.size(), listLength(fields[4]) - (table ? 1 : 0)) << fields[0];
    EXPECT_EQ(info.output == Output::Always, fields[5].starts_with("OUT")) << fields[0];
  }
  for (const auto& [mnemonic, row] : rows) ADD_FAILURE() << mnemonic << " is not in the inventory";
}

TEST(GskTable, EveryInstructionBuiltHasItsScenario) {
  for (const Row& row : allRows()) {
    if (row.info.number >= 0 && row.lower == nullptr) continue;
    std::string name(row.info.mnemonic);
    for (char& c : name) c = static_cast<char>(std::tolower(c));
    EXPECT_TRUE(std::filesystem::exists("tests/scenarios/gsk/" + name + ".scn")) << name;
  }
}

// A call of a function in Level 2, one command a line.
struct Call {
  const Row& row;
  std::vector<std::string> parameters;
  size_t conditions;
  std::string coil;

  explicit Call(const Row& r)
      : row(r), conditions(r.info.pins.size()), coil(r.info.output == Output::Always ? "OUT R20.0\n" : "") {
    for (const auto& operand : r.info.operands.all())
      parameters.push_back(operand.min <= operand.max && operand.kind == &kinds::kNumber
                               ? std::to_string(operand.min)
                               : std::string(operand.kind->good));
  }
  std::string text() const {
    std::string text = "FUNC 0\n";
    for (size_t i = 0; i < conditions; ++i) text += "LD X9.0\n";
    text += "FUNC " + std::string(row.info.mnemonic) + "\n";
    for (const std::string& parameter : parameters) text += "PRM " + parameter + "\n";
    if (row.hasTable) text += "TABLE 1\n";
    return text + coil + "FUNC 1\n";
  }
  Codes codes() const { return compileList(text())->codes(); }
  size_t functionLine() const { return 2 + conditions; }
};

// Functions that stand alone; the others need a partner.
std::vector<const Row*> plainRows() {
  std::vector<const Row*> rows;
  for (const Row& row : allRows())
    if (row.info.number >= 0 && row.lower != nullptr && row.control == frontend::network::Control::Plain)
      rows.push_back(&row);
  return rows;
}

bool hasCode(const Codes& codes, size_t line, std::string_view code) {
  return std::find(codes.begin(), codes.end(), std::to_string(line) + " " + std::string(code)) != codes.end();
}

TEST(GskTable, GoodOperandsAreAccepted) {
  for (const Row* row : plainRows()) EXPECT_EQ(Call(*row).codes(), Codes{}) << row->info.mnemonic;
}

TEST(GskTable, BadOperandsGiveTheCodeOfTheirKind) {
  for (const Row* row : plainRows()) {
    for (size_t i = 0; i < row->info.operands.size(); ++i) {
      Call call(*row);
      const OperandKindInfo& kind = *row->info.operands[i].kind;
      call.parameters[i] = kind.bad;
      EXPECT_TRUE(hasCode(call.codes(), call.functionLine() + 1 + i, kind.badCode))
          << row->info.mnemonic << " " << row->info.operands[i].name << ": " << testing::PrintToString(call.codes());
    }
  }
}

TEST(GskTable, RangesOfNumbersAreExact) {
  for (const Row* row : plainRows()) {
    for (size_t i = 0; i < row->info.operands.size(); ++i) {
      const auto& operand = row->info.operands[i];
      if (operand.kind != &kinds::kNumber || row->hasTable) continue;
      Call call(*row);
      for (const auto& [value, good] :
           {std::pair(operand.min, true), {operand.max, true}, {operand.min - 1, false}, {operand.max + 1, false}}) {
        call.parameters[i] = std::to_string(value);
        EXPECT_EQ(call.codes().empty(), good) << row->info.mnemonic << " " << operand.name << " " << value;
      }
    }
  }
}

TEST(GskTable, CountsAreChecked) {
  for (const Row* row : plainRows()) {
    Call fewer(*row), more(*row), conditions(*row), coil(*row);
    const size_t line = fewer.functionLine();
    if (!fewer.parameters.empty()) fewer.parameters.pop_back();
    more.parameters.push_back("1");
    EXPECT_TRUE(hasCode(fewer.codes(), line, "wrong-parameter-count")) << row->info.mnemonic;
    EXPECT_TRUE(hasCode(more.codes(), line, "wrong-parameter-count")) << row->info.mnemonic;
    --conditions.conditions;
    EXPECT_TRUE(hasCode(conditions.codes(), line - 1, "wrong-condition-count")) << row->info.mnemonic;
    const bool hasOutput = !coil.coil.empty();
    coil.coil = hasOutput ? "" : "OUT R20.0\n";
    const Codes codes = coil.codes();
    EXPECT_EQ(codes.size(), 1u) << row->info.mnemonic;
    EXPECT_TRUE(codes.size() == 1 && codes[0].ends_with(hasOutput ? "missing-output" : "unbalanced-stack"))
        << row->info.mnemonic;
  }
}

TEST(GskTable, FunctionsThatAreNotBuiltSaySo) {
  for (const Row& row : allRows()) {
    if (row.info.number < 0 || row.lower != nullptr) continue;
    EXPECT_EQ(Call(row).codes(), (Codes{std::to_string(Call(row).functionLine()) + " not-built-yet"}))
        << row.info.mnemonic;
  }
}

} // namespace
} // namespace rung::frontend::gsk::test

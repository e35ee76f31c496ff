// The instruction table against the inventory, and errors that are generated from its rows.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>

#include <gtest/gtest.h>

#include "frontend/dialects/fanuc/rows/instructions.h"
#include "frontend/dialects/fanuc/rows/operand_kinds.h"
#include "tests/unit/fanuc/compile.h"

namespace rung::frontend::fanuc::test {
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

// Entries between separators; those in parentheses are remarks.
size_t listLength(const std::string& field, char separator) {
  if (field.starts_with("-")) return 0;
  size_t count = 1;
  int depth = 0;
  for (char c : field) {
    depth += c == '(' ? 1 : c == ')' ? -1 : 0;
    count += c == separator && depth == 0 ? 1 : 0;
  }
  return count;
}
size_t conditionsIn(const std::string& field) { return listLength(field, ','); }
size_t parametersIn(const std::string& field) {
  return listLength(field, field == "number of coils, 0" ? '\0' : ';'); // one, which is 0
}

TEST(FanucTable, AgreesWithTheInventory) {
  std::ifstream file("tests/unit/fanuc/instructions.csv");
  ASSERT_TRUE(file);
  std::string line;
  std::getline(file, line);
  std::map<std::string_view, const Row*> rows;
  for (const Row& row : allRows())
    EXPECT_TRUE(rows.emplace(row.info.mnemonic, &row).second) << row.info.mnemonic << " twice";
  while (std::getline(file, line)) {
    const std::vector<std::string> fields = fieldsOf(line);
    ASSERT_GE(fields.size(), 6u) << line;
    const bool isUncertain = fields[5] == "low";
    const auto found = rows.find(fields[1]);
    if (found == rows.end()) {
      EXPECT_TRUE(isUncertain && fields[0].empty())
          << fields[1] << " is missing in the table, or twice in the inventory";
      continue;
    }
    const Row& row = *found->second;
    rows.erase(found);
    if (fields[0].empty()) continue; // the basic commands are the network's
    EXPECT_EQ(std::to_string(row.info.number), fields[0]) << fields[1];
    EXPECT_EQ(row.built, !isUncertain) << fields[1];
    if (isUncertain) continue;
    EXPECT_EQ(row.info.pins.size(), conditionsIn(fields[2])) << fields[1];
    const bool table = fields[3].find("table rows") != std::string::npos;
    EXPECT_EQ(row.info.operands.size(), parametersIn(fields[3]) - (table ? 1 : 0)) << fields[1];
    EXPECT_EQ(row.info.output == Output::Always, fields[4].starts_with("W1")) << fields[1];
  }
  for (const auto& [mnemonic, row] : rows) ADD_FAILURE() << mnemonic << " is not in the inventory";
}

// A call of a function in Level 2, one command a line.
struct Call {
  const Row& row;
  std::vector<std::string> parameters;
  size_t conditions;
  std::string coil;

  explicit Call(const Row& r)
      : row(r), conditions(r.info.pins.size()), coil(r.info.output == Output::Always ? "WRT R20.0\n" : "") {
    for (const auto& operand : r.info.operands.all())
      parameters.push_back(operand.min <= operand.max && operand.kind == &kinds::kNumber
                               ? std::to_string(operand.min)
                               : std::string(operand.kind->good));
    if (r.hasTable) parameters[r.capacityAt] = "1";
  }
  std::string text() const {
    std::string text = "SUB 1\n";
    for (size_t i = 0; i < conditions; ++i) text += i == 0 ? "RD X9.0\n" : "RD.STK X9.0\n";
    text += "SUB " + std::to_string(row.info.number) + "\n";
    for (const std::string& parameter : parameters) text += parameter + "\n";
    if (row.hasTable) text += "1\n";
    return text + coil + "SUB 2\nSUB 64\n";
  }
  Codes codes(const CompileOptions& options = {}) const { return compileMnemonic(text(), options)->codes(); }
  size_t functionLine() const { return 2 + conditions; }
};

// Functions that stand alone; the others need a partner.
std::vector<const Row*> plainRows() {
  std::vector<const Row*> rows;
  for (const Row& row : allRows())
    if (row.info.number >= 0 && row.lower != nullptr && row.info.pins.size() > 0 &&
        row.control == frontend::network::Control::Plain)
      rows.push_back(&row);
  return rows;
}

bool hasCode(const Codes& codes, size_t line, std::string_view code) {
  return std::find(codes.begin(), codes.end(), std::to_string(line) + " " + std::string(code)) != codes.end();
}

TEST(FanucTable, GoodOperandsAreAccepted) {
  for (const Row* row : plainRows()) EXPECT_EQ(Call(*row).codes(), Codes{}) << row->info.mnemonic;
}

TEST(FanucTable, BadOperandsGiveTheCodeOfTheirKind) {
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

// With the largest memory, which has all numbers.
TEST(FanucTable, RangesOfNumbersAreExact) {
  const CompileOptions options{.config = {{"pmc", "30i-B PMC(MEM-D)"}}};
  for (const Row* row : plainRows()) {
    for (size_t i = 0; i < row->info.operands.size(); ++i) {
      const auto& operand = row->info.operands[i];
      if (operand.kind != &kinds::kNumber || row->hasTable) continue;
      Call call(*row);
      for (const auto& [value, good] :
           {std::pair(operand.min, true), {operand.max, true}, {operand.min - 1, false}, {operand.max + 1, false}}) {
        call.parameters[i] = std::to_string(value);
        EXPECT_EQ(call.codes(options).empty(), good) << row->info.mnemonic << " " << operand.name << " " << value;
      }
    }
  }
}

TEST(FanucTable, CountsAreChecked) {
  for (const Row* row : plainRows()) {
    if (row->hasTable) continue; // a parameter too many is a row
    Call fewer(*row), more(*row), conditions(*row), coil(*row);
    const size_t line = fewer.functionLine();
    if (!fewer.parameters.empty()) fewer.parameters.pop_back();
    more.parameters.push_back("1");
    EXPECT_TRUE(hasCode(fewer.codes(), line, "wrong-parameter-count")) << row->info.mnemonic;
    EXPECT_TRUE(hasCode(more.codes(), line, "wrong-parameter-count")) << row->info.mnemonic;
    --conditions.conditions;
    EXPECT_TRUE(hasCode(conditions.codes(), line - 1, "wrong-condition-count")) << row->info.mnemonic;
    const bool hasOutput = !coil.coil.empty();
    coil.coil = hasOutput ? "" : "WRT R20.0\n";
    const Codes codes = coil.codes();
    if (row->info.output == Output::Optional) {
      EXPECT_EQ(codes, Codes{}) << row->info.mnemonic; // the coil takes ACT
      continue;
    }
    EXPECT_EQ(codes.size(), 1u) << row->info.mnemonic;
    EXPECT_TRUE(codes.size() == 1 && codes[0].ends_with("missing-output")) << row->info.mnemonic;
  }
}

TEST(FanucTable, FunctionsThatAreNotBuiltSaySo) {
  for (const Row& row : allRows()) {
    if (row.info.number < 0 || row.lower != nullptr) continue;
    EXPECT_EQ(Call(row).codes(), (Codes{std::to_string(Call(row).functionLine()) + " not-built-yet"}))
        << row.info.mnemonic;
  }
}

} // namespace
} // namespace rung::frontend::fanuc::test

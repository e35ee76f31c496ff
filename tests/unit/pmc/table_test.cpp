// The instruction tables of the family against their inventories, and errors that are generated from their rows.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>

#include <gtest/gtest.h>

#include "frontend/dialects/fanuc/fanuc.h"
#include "frontend/dialects/fanuc/language.h"
#include "frontend/dialects/fanuc/rows/instructions.h"
#include "frontend/dialects/gsk/gsk.h"
#include "frontend/dialects/gsk/language.h"
#include "frontend/dialects/gsk/rows/instructions.h"
#include "frontend/network/rows/operand_kinds.h"
#include "tests/support/compiled.h"

namespace rung::frontend::network::test {
namespace {

using frontend::OperandKindInfo;
using frontend::Output;
using frontend::test::Codes;

// A dialect, and how its lists are written: a level with one function, one command a line.
struct Listed {
  const Dialect* dialect;
  std::span<const LoweredRow> (*rows)();
  const Language& (*language)();
  char conditionMark; // between the conditions in the inventory
  std::string output; // with which an output begins there
  std::string begin, firstCondition, condition, function, parameter, tableRow, coil, end;
  CompileOptions largest; // a control that has all numbers
};

const Listed kLists[] = {
    {.dialect = &fanuc::kFanuc,
     .rows = &fanuc::allRows,
     .language = []() -> const Language& { return fanuc::languageOf(fanuc::Pmc::MemB); },
     .conditionMark = ',',
     .output = "W1",
     .begin = "SUB 1\n",
     .firstCondition = "RD X9.0\n",
     .condition = "RD.STK X9.0\n",
     .function = "SUB ",
     .parameter = "",
     .tableRow = "",
     .coil = "WRT R20.0\n",
     .end = "SUB 2\nSUB 64\n",
     .largest = {.config = {{"pmc", "30i-B PMC(MEM-D)"}}}},
    {.dialect = &gsk::kGsk,
     .rows = &gsk::allRows,
     .language = []() -> const Language& { return gsk::kLanguage; },
     .conditionMark = ';',
     .output = "OUT",
     .begin = "FUNC 0\n",
     .firstCondition = "LD X9.0\n",
     .condition = "LD X9.0\n",
     .function = "FUNC ",
     .parameter = "PRM ",
     .tableRow = "TABLE ",
     .coil = "OUT R20.0\n",
     .end = "FUNC 1\n",
     .largest = {}},
};

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

// Entries between marks; those in parentheses are remarks.
size_t listLength(const std::string& field, char mark) {
  if (field.starts_with("-")) return 0;
  size_t count = 1;
  int depth = 0;
  for (char c : field) {
    depth += c == '(' ? 1 : c == ')' ? -1 : 0;
    count += c == mark && depth == 0 ? 1 : 0;
  }
  return count;
}

// The lines of tests/unit/DIALECT/instructions.csv by their columns.
std::vector<std::map<std::string, std::string>> inventoryOf(const Listed& list) {
  std::ifstream file("tests/unit/" + std::string(list.dialect->name) + "/instructions.csv");
  std::string line;
  std::getline(file, line);
  const std::vector<std::string> columns = fieldsOf(line);
  std::vector<std::map<std::string, std::string>> lines;
  while (std::getline(file, line)) {
    const std::vector<std::string> fields = fieldsOf(line);
    EXPECT_EQ(fields.size(), columns.size()) << line;
    auto& entries = lines.emplace_back();
    for (size_t i = 0; i < std::min(fields.size(), columns.size()); ++i) entries[columns[i]] = fields[i];
  }
  return lines;
}

Codes codesOf(const Listed& list, const std::string& text, const CompileOptions& options = {}) {
  const std::string name = "test" + std::string(list.dialect->extensions[0]);
  return frontend::test::compileFiles(*list.dialect, {{name, text}}, options)->codes();
}

// A call of a function in Level 2.
struct Call {
  const Listed& list;
  const LoweredRow& row;
  std::vector<std::string> parameters;
  size_t conditions;
  std::string coil;
  bool byNumber = true;

  Call(const Listed& l, const LoweredRow& r)
      : list(l), row(r), conditions(r.info.pins.size()), coil(r.info.output == Output::Always ? l.coil : "") {
    for (const auto& operand : r.info.operands.all())
      parameters.push_back(operand.min <= operand.max && operand.kind == &kinds::kNumber
                               ? std::to_string(operand.min)
                               : std::string(operand.kind->good));
    if (r.hasTable) parameters[r.capacityAt] = "1";
  }
  std::string text() const {
    std::string text = list.begin;
    for (size_t i = 0; i < conditions; ++i) text += i == 0 ? list.firstCondition : list.condition;
    text += list.function + (byNumber ? std::to_string(row.info.number) : std::string(row.info.mnemonic)) + "\n";
    for (const std::string& parameter : parameters) text += list.parameter + parameter + "\n";
    if (row.hasTable) text += list.tableRow + "1\n";
    return text + coil + list.end;
  }
  Codes codes(const CompileOptions& options = {}) const { return codesOf(list, text(), options); }
  size_t functionLine() const { return 2 + conditions; }
};

bool hasCode(const Codes& codes, size_t line, std::string_view code) {
  return std::find(codes.begin(), codes.end(), std::to_string(line) + " " + std::string(code)) != codes.end();
}

class PmcTable : public testing::TestWithParam<const Listed*> {
protected:
  const Listed& list() const { return *GetParam(); }
  // Functions that stand alone; the others need a partner.
  std::vector<const LoweredRow*> plainRows() const {
    std::vector<const LoweredRow*> rows;
    for (const LoweredRow& row : list().rows())
      if (row.info.number >= 0 && row.lower != nullptr && row.info.pins.size() > 0 && row.control == Control::Plain)
        rows.push_back(&row);
    return rows;
  }
  Call callOf(const LoweredRow* row) const { return {list(), *row}; }
};

INSTANTIATE_TEST_SUITE_P(Dialects, PmcTable, testing::Values(&kLists[0], &kLists[1]),
                         [](const auto& tested) { return std::string(tested.param->dialect->name); });

TEST_P(PmcTable, AgreesWithTheInventory) {
  std::map<std::string_view, const LoweredRow*> rows;
  for (const LoweredRow& row : list().rows())
    EXPECT_TRUE(rows.emplace(row.info.mnemonic, &row).second) << row.info.mnemonic << " twice";
  for (auto& fields : inventoryOf(list())) {
    const std::string& mnemonic = fields["mnemonic"];
    const bool isUncertain = fields["certainty"] == "low", isFunction = !fields["func_number"].empty();
    const auto found = rows.find(mnemonic);
    if (found == rows.end()) {
      EXPECT_TRUE(isUncertain && !isFunction) << mnemonic << " is missing in the table, or twice in the inventory";
      continue;
    }
    const LoweredRow& row = *found->second;
    rows.erase(found);
    if (!isFunction) continue; // the network has the conditions of basic commands
    EXPECT_EQ(std::to_string(row.info.number), fields["func_number"]) << mnemonic;
    EXPECT_EQ(row.built, !isUncertain) << mnemonic;
    if (isUncertain) continue;
    EXPECT_EQ(row.info.pins.size(), listLength(fields["conditions"], list().conditionMark)) << mnemonic;
    const std::string& parameters = fields["parameters"];
    const bool table = parameters.find("TABLE rows") != std::string::npos;
    EXPECT_EQ(row.info.operands.size(), listLength(parameters, ';') - (table ? 1 : 0)) << mnemonic;
    EXPECT_EQ(row.info.output == Output::Always, fields["output"].starts_with(list().output)) << mnemonic;
  }
  for (const auto& [mnemonic, row] : rows) ADD_FAILURE() << mnemonic << " is not in the inventory";
}

TEST_P(PmcTable, GoodOperandsAreAccepted) {
  for (const LoweredRow* row : plainRows()) {
    Call call = callOf(row);
    EXPECT_EQ(call.codes(), Codes{}) << row->info.mnemonic;
    call.byNumber = false;
    EXPECT_EQ(call.codes(), Codes{}) << row->info.mnemonic;
  }
}

TEST_P(PmcTable, ExamplesAreAccepted) {
  for (const LoweredRow* row : plainRows())
    EXPECT_EQ(codesOf(list(), list().begin + std::string(row->info.example) + "\n" + list().end), Codes{})
        << row->info.mnemonic;
}

TEST_P(PmcTable, BadOperandsGiveTheCodeOfTheirKind) {
  for (const LoweredRow* row : plainRows()) {
    for (size_t i = 0; i < row->info.operands.size(); ++i) {
      Call call = callOf(row);
      const OperandKindInfo& kind = *row->info.operands[i].kind;
      call.parameters[i] = kind.bad;
      EXPECT_TRUE(hasCode(call.codes(), call.functionLine() + 1 + i, kind.badCode))
          << row->info.mnemonic << " " << row->info.operands[i].name << ": " << testing::PrintToString(call.codes());
    }
  }
}

// Data of a fixed length, in the last bytes of R in which they fit, and one byte further.
TEST_P(PmcTable, DataEndInTheirArea) {
  size_t tried = 0;
  const auto split = splitAddress(list().language(), "R0");
  const uint32_t end = list().language().at(split->area).room(0);
  for (const LoweredRow* row : plainRows()) {
    for (size_t i = 0; i < row->info.operands.size(); ++i) {
      const OperandKind& kind = kindOf(row->info.operands[i]);
      const uint32_t bytes = kind.length == Length::OfRow ? row->recordBytes
                             : kind.least != 0            ? kind.least
                                                          : kind.bytes;
      const bool isFixed = kind.length == Length::OfRow || kind.length == Length::OfKind;
      if (kind.parse != OperandClass::Value || !isFixed || bytes < 2 || (kind.constant && !kind.either)) continue;
      ++tried;
      for (const uint32_t beyond : {0, 1}) {
        Call call = callOf(row);
        call.parameters[i] = "R" + std::to_string(end - bytes + beyond);
        EXPECT_EQ(hasCode(call.codes(), call.functionLine() + 1 + i, "address-out-of-range"), beyond == 1)
            << row->info.mnemonic << " " << row->info.operands[i].name << ": " << testing::PrintToString(call.codes());
      }
    }
  }
  EXPECT_GT(tried, 8u);
}

TEST_P(PmcTable, RangesOfNumbersAreExact) {
  for (const LoweredRow* row : plainRows()) {
    for (size_t i = 0; i < row->info.operands.size(); ++i) {
      const auto& operand = row->info.operands[i];
      if (operand.kind != &kinds::kNumber || row->hasTable) continue;
      Call call = callOf(row);
      for (const auto& [value, good] :
           {std::pair(operand.min, true), {operand.max, true}, {operand.min - 1, false}, {operand.max + 1, false}}) {
        call.parameters[i] = std::to_string(value);
        EXPECT_EQ(call.codes(list().largest).empty(), good)
            << row->info.mnemonic << " " << operand.name << " " << value;
      }
    }
  }
}

TEST_P(PmcTable, CountsAreChecked) {
  for (const LoweredRow* row : plainRows()) {
    if (row->hasTable && list().tableRow.empty()) continue; // a parameter too many is a row
    Call fewer = callOf(row), more = fewer, conditions = fewer, coil = fewer;
    const size_t line = fewer.functionLine();
    if (!fewer.parameters.empty()) fewer.parameters.pop_back();
    more.parameters.emplace_back("1");
    EXPECT_TRUE(hasCode(fewer.codes(), line, "wrong-parameter-count")) << row->info.mnemonic;
    EXPECT_TRUE(hasCode(more.codes(), line, "wrong-parameter-count")) << row->info.mnemonic;
    --conditions.conditions;
    EXPECT_TRUE(hasCode(conditions.codes(), line - 1, "wrong-condition-count")) << row->info.mnemonic;
    coil.coil = coil.coil.empty() ? list().coil : "";
    const Codes codes = coil.codes();
    if (row->info.output == Output::Optional) {
      EXPECT_EQ(codes, Codes{}) << row->info.mnemonic; // the coil takes ACT
      continue;
    }
    EXPECT_EQ(codes.size(), 1u) << row->info.mnemonic;
    EXPECT_TRUE(codes.size() == 1 &&
                codes[0].ends_with(row->info.output == Output::Always ? "missing-output" : "unbalanced-stack"))
        << row->info.mnemonic;
  }
}

TEST_P(PmcTable, FunctionsThatAreNotBuiltSaySo) {
  for (const LoweredRow& row : list().rows()) {
    if (row.info.number < 0 || row.lower != nullptr) continue;
    const Call call(list(), row);
    EXPECT_EQ(call.codes(), (Codes{std::to_string(call.functionLine()) + " not-built-yet"})) << row.info.mnemonic;
  }
}

TEST(PmcScenarios, OfGskHaveTheNamesOfItsInstructions) {
  for (const LoweredRow& row : gsk::allRows()) {
    if (row.info.number >= 0 && row.lower == nullptr) continue;
    std::string name(row.info.mnemonic);
    for (char& c : name) c = static_cast<char>(std::tolower(c));
    EXPECT_TRUE(std::filesystem::exists("tests/scenarios/gsk/" + name + ".scn")) << name;
  }
}

} // namespace
} // namespace rung::frontend::network::test

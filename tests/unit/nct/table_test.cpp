// The instruction table against the inventory, and every row's own example through the compiler.
#include <fmt/format.h>
#include <fstream>
#include <gmock/gmock.h>
#include <map>
#include <sstream>

#include "frontend/dialects/nct/nct.h"
#include "frontend/dialects/nct/rows/instructions.h"
#include "frontend/dialects/nct/rows/operand_kinds.h"
#include "ir/verify/verify.h"
#include "tests/unit/nct/support.h"

namespace rung::frontend::nct::test {
namespace {

using frontend::OperandInfo;
using frontend::OperandKindInfo;
using frontend::Output;
using frontend::Placement;

// First eight columns of a line of the inventory; quotes hold commas.
std::vector<std::string> columns(const std::string& line) {
  std::vector<std::string> result(1);
  bool quoted = false;
  for (char c : line) {
    if (c == '"')
      quoted = !quoted;
    else if (c == ',' && !quoted)
      result.emplace_back();
    else
      result.back() += c;
  }
  return result;
}

// Operands are separated by semicolons; what stands in parentheses is their range.
size_t operandsIn(const std::string& column) {
  if (column == "-") return 0;
  size_t count = 1;
  int depth = 0;
  for (char c : column) {
    depth += c == '(' ? 1 : c == ')' ? -1 : 0;
    count += c == ';' && depth == 0 ? 1 : 0;
  }
  return count;
}

TEST(NctTable, HoldsTheWholeInventory) {
  std::ifstream file("tests/unit/nct/instructions.csv");
  ASSERT_TRUE(file) << "run in the root of the repository";
  std::string line;
  std::getline(file, line);
  std::map<std::string_view, const Row*> rows;
  for (const Row& row : allRows())
    EXPECT_TRUE(rows.emplace(row.info.mnemonic, &row).second) << row.info.mnemonic << " twice";
  while (std::getline(file, line)) {
    const std::vector<std::string> csv = columns(line);
    const auto found = rows.find(csv[0]);
    if (found == rows.end()) {
      ADD_FAILURE() << csv[0] << " is missing in the table, or twice in the inventory";
      continue;
    }
    const frontend::InstructionInfo& info = found->second->info;
    rows.erase(found);
    EXPECT_TRUE(info.ref.starts_with(csv[1] + ", l.")) << info.mnemonic << ' ' << info.ref;
    const Output output = csv[5] == "configurable" ? Output::Optional : csv[5] == "no" ? Output::Always : Output::None;
    EXPECT_EQ(info.output, output) << info.mnemonic;
    EXPECT_EQ(info.placement != Placement::AfterContact, csv[6] == "yes") << info.mnemonic;
    const auto pins = std::count(csv[3].begin(), csv[3].end(), ',') + 1;
    EXPECT_EQ(info.pins.size(), static_cast<size_t>(pins)) << info.mnemonic;
    EXPECT_EQ(info.operands.size(), operandsIn(csv[4])) << info.mnemonic;
  }
  for (const auto& [mnemonic, row] : rows) ADD_FAILURE() << mnemonic << " is not in the inventory";
}

// What examples may name; an example that needs another name has it declared here.
constexpr std::string_view kPrelude = R"(symbol START 7900.00
symbol STOP 7900.01
symbol MOTOR 7901.00
symbol T_WARM 7902
symbol WARMING 7901.01
symbol WARM 7901.02
symbol RUNNING 7900.02
symbol IDLE 7901.03
symbol LATCH 7901.04
symbol START_P 7901.05
symbol START_N 7901.06
symbol STARTED 7901.07
symbol RUN 7900.03
symbol FAN 7901.08
symbol LUBE 7900.04
symbol PUMP 7901.09
symbol PART 7900.05
symbol FULL 7901.10
symbol STEP 7900.06
symbol HOME 7901.11
symbol M6 7900.07
symbol TOGO 7903
symbol POS 7904
symbol GOAL 7905
symbol NEGATIVE 7901.12
symbol OUT 7901.13
symbol PARTS 7906
symbol LEFT 7907
symbol FAULT 7900.08
symbol SKIP 7900.09
symbol GO 7900.10
const TEN #10
)";

// The row's example with what belongs around it: names, pins, labels, subroutines.
std::string exampleProgram(const Row& row) {
  const frontend::InstructionInfo& info = row.info;
  std::string text(kPrelude);
  if (info.group == "message") text += "message 20 \"fault\"\n";
  const std::string example(info.example);
  if (row.flow == Flow::Section) return text + example + "\n";
  const auto rung = [](const std::string& drawing) { return "rung\n" + drawing + "\n\n"; };
  std::string drawing = example;
  const size_t column = example.find('{');
  for (size_t i = 1; i < info.pins.size(); ++i) {
    drawing += fmt::format("\n|--[START]{:->{}}{{{}}}", "", column - 10, info.pins[i].name);
  }
  switch (row.flow) {
  case Flow::Jump: return text + rung(drawing) + rung("|--{JME #5}");
  case Flow::Label: return text + rung("|--[SKIP]--{JMP #5}") + rung(drawing);
  case Flow::Call: return text + rung(drawing) + rung("|--{END}") + rung("|--{SBN #10}") + rung("|--[N_ON]--{RET}");
  case Flow::Subroutine:
    return text + rung("|--[N_ON]--{SBS #10}") + rung("|--{END}") + rung(drawing) + rung("|--[N_ON]--{RET}");
  case Flow::Return:
    return text + rung("|--[N_ON]--{SBS #10}") + rung("|--{END}") + rung("|--{SBN #10}") + rung(drawing);
  case Flow::None:
  case Flow::End:
  case Flow::Section: break;
  }
  return text + rung(drawing);
}

TEST(NctTable, ExamplesCompile) {
  for (const Row& row : allRows()) {
    const Compiled c = compileMain(exampleProgram(row));
    if (!row.isBuilt()) {
      ASSERT_EQ(c.codes().size(), 1u) << row.info.mnemonic << '\n' << c.rendered();
      EXPECT_NE(c.codes()[0].find("not-built-yet"), std::string::npos) << c.rendered();
      continue;
    }
    EXPECT_TRUE(c.codes().empty()) << row.info.mnemonic << '\n' << exampleProgram(row) << c.rendered();
    ASSERT_NE(c.module, nullptr);
    const auto errors = ir::verify(*c.module, ir::Mode::Built);
    EXPECT_TRUE(errors.empty()) << row.info.mnemonic << '\n' << ir::render(*c.module, errors);
  }
}

// A program with one box whose operands are `operands`.
Compiled withOperands(const Row& row, const std::vector<std::string>& operands) {
  std::string box = std::string("{") + std::string(row.info.mnemonic);
  for (const std::string& operand : operands) box += ' ' + operand;
  box += '}';
  const bool rail = row.info.placement == Placement::AtRail;
  const std::string front = rail ? "|--" : "|--[7900.00]--";
  std::string drawing = front + box + (row.info.output == Output::Always ? "--(7901.00)" : "");
  for (size_t i = 1; i < row.info.pins.size(); ++i)
    drawing += "\n" + front + "{" + std::string(row.info.pins[i].name) + "}";
  return compileMain("rung\n" + drawing + "\n");
}

bool has(const Compiled& c, std::string_view code) {
  for (const std::string& found : c.codes())
    if (found.ends_with(" " + std::string(code))) return true;
  return false;
}

std::vector<std::string> goodOperands(const Row& row) {
  std::vector<std::string> good;
  for (const OperandInfo& info : row.info.operands.all()) {
    good.push_back(info.min <= info.max          ? "#" + std::to_string(info.min)
                   : info.kind == &kinds::kScope ? "Measured"
                                                 : std::string(info.kind->good));
  }
  return good;
}

// Operands made from the rows: wrong kinds, constants just outside their range, too few and too many.
TEST(NctTable, GeneratedOperandErrors) {
  for (const Row& row : allRows()) {
    if (row.shape != Shape::Box || row.flow == Flow::Section) continue;
    const std::vector<std::string> good = goodOperands(row);
    const std::string name(row.info.mnemonic);
    EXPECT_FALSE(has(withOperands(row, good), "operand-count")) << name;
    std::vector<std::string> surplus = good;
    surplus.push_back("7000");
    EXPECT_TRUE(has(withOperands(row, surplus), "operand-count")) << name;
    for (size_t i = 0; i < good.size(); ++i) {
      const OperandInfo& info = row.info.operands[i];
      std::vector<std::string> changed = good;
      if (!info.optional) {
        changed.resize(i);
        EXPECT_TRUE(has(withOperands(row, changed), "operand-count")) << name << ' ' << i;
      }
      changed = good;
      const OperandKindInfo& kind = *info.kind;
      changed[i] = kind.bad;
      if (!kind.bad.empty()) {
        EXPECT_TRUE(has(withOperands(row, changed), kind.badCode)) << name << ' ' << info.name;
      }
      if (info.min > info.max) continue;
      for (int64_t value : {info.min - 1, info.max + 1}) {
        changed[i] = "#" + std::to_string(value);
        EXPECT_TRUE(has(withOperands(row, changed), "constant-out-of-range")) << name << ' ' << changed[i];
      }
    }
  }
}

// --- where it stands, made from the rows
// -----------------------------------------------------------------------------------
struct Drawn {
  bool atRail = false;       // the first line touches the left rail
  bool output = false;       // a coil stands behind it
  size_t railPin = SIZE_MAX; // this further pin touches the rail
  size_t pins = SIZE_MAX;    // lines that are drawn
  std::string modifier;      // in front of the first operand that is an address
};

std::string elementOf(const Row& row, const std::string& modifier) {
  std::vector<std::string> operands = goodOperands(row);
  for (size_t i = 0; i < operands.size(); ++i) {
    const OperandKind& kind = kindOf(row.info.operands[i]);
    if (kind.parse != OperandClass::Value || modifier.empty()) continue;
    operands[i] = modifier + (kind.form == Form::Bit ? "7000.05" : "7000");
    break;
  }
  const std::string name(row.info.mnemonic);
  if (name.ends_with("-contact-bit") || name.ends_with("-contact-dword"))
    return (name[0] == 'c' ? "[/" : "[") + operands[0] + "]";
  if (name == "coil" || name == "negated-coil") return (name[0] == 'n' ? "(/" : "(") + operands[0] + ")";
  if (name == "SET" || name == "RST") return "(" + name.substr(0, 1) + " " + operands[0] + ")";
  std::string box = "{" + name;
  for (const std::string& operand : operands) box += ' ' + operand;
  return box + "}";
}

Compiled drawn(const Row& row, const Drawn& shape) {
  const auto front = [](bool rail) { return rail ? "|-------------" : "|--[7900.00]--"; };
  std::string drawing =
      std::string(front(shape.atRail)) + elementOf(row, shape.modifier) + (shape.output ? "--(7901.00)" : "");
  for (size_t i = 1; i < row.info.pins.size() && i < shape.pins; ++i)
    drawing += std::string("\n") + front(i == shape.railPin) + "{" + std::string(row.info.pins[i].name) + "}";
  return compileMain("rung\n" + drawing + "\n");
}

// Man. l.1172-1180: every row at the rail and behind a contact, with and without something behind it.
TEST(NctTable, FirstColumnAndClosingElement) {
  for (const Row& row : allRows()) {
    if (row.flow == Flow::Section) continue;
    const bool always = row.info.output == Output::Always, none = row.info.output == Output::None;
    const bool atRail = row.info.placement == Placement::AtRail, behind = row.info.placement == Placement::AfterContact;
    EXPECT_EQ(has(drawn(row, {.atRail = true, .output = always}), "first-column-not-allowed"), behind)
        << row.info.mnemonic;
    EXPECT_EQ(has(drawn(row, {.atRail = false, .output = always}), "first-column-required"), atRail)
        << row.info.mnemonic;
    EXPECT_EQ(has(drawn(row, {.atRail = atRail, .output = true}), "element-after-closing"), none) << row.info.mnemonic;
    EXPECT_EQ(has(drawn(row, {.atRail = atRail, .output = false}), "missing-closing-element"), always)
        << row.info.mnemonic;
    const auto shapeErrors = {"first-column-not-allowed", "first-column-required", "element-after-closing",
                              "missing-closing-element"};
    const Compiled good = drawn(row, {.atRail = atRail, .output = always});
    for (const std::string& code : good.codes())
      for (const char* wrong : shapeErrors)
        EXPECT_EQ(code.find(wrong), std::string::npos) << row.info.mnemonic << ' ' << code;
  }
}

TEST(NctTable, EveryPinIsDrawnAndHasACondition) {
  size_t boxes = 0;
  for (const Row& row : allRows()) {
    if (row.info.pins.size() < 2) continue;
    ++boxes;
    for (size_t pin = 1; pin < row.info.pins.size(); ++pin) {
      EXPECT_TRUE(has(drawn(row, {.output = true, .railPin = pin}), "first-column-not-allowed"))
          << row.info.mnemonic << ' ' << pin;
      EXPECT_TRUE(has(drawn(row, {.output = true, .pins = pin}), "missing-pin")) << row.info.mnemonic << ' ' << pin;
    }
    EXPECT_TRUE(drawn(row, {.output = true}).codes().empty()) << drawn(row, {.output = true}).rendered();
  }
  EXPECT_EQ(boxes, 4u);
}

// Edges belong to contacts, `!` to bits of the NC in INT0 (man. l.546, l.596, l.930, l.1063).
TEST(NctTable, ModifiersBelongToContactsAndCoils) {
  for (const Row& row : allRows()) {
    const auto& operands = row.info.operands.all();
    const bool addressable =
        std::ranges::any_of(operands, [](const OperandInfo& o) { return kindOf(o).parse == OperandClass::Value; });
    if (!addressable) continue;
    const bool always = row.info.output == Output::Always;
    for (const char* edge : {"@", "%"})
      EXPECT_EQ(has(drawn(row, {.output = always, .modifier = edge}), "modifier-not-allowed"),
                row.shape != Shape::Contact)
          << row.info.mnemonic << edge;
    EXPECT_TRUE(has(drawn(row, {.output = always, .modifier = "!"}), "immediate-outside-int0")) << row.info.mnemonic;
    for (const char* both : {"@!", "!@", "%!", "!%"})
      EXPECT_TRUE(has(drawn(row, {.output = always, .modifier = both}), "edge-with-immediate"))
          << row.info.mnemonic << both;
  }
}

TEST(NctTable, FindsBoxesOnly) {
  EXPECT_EQ(findBox("TOND")->info.mnemonic, "TOND");
  EXPECT_EQ(findBox("/F")->info.mnemonic, "/F");
  EXPECT_EQ(findBox("coil"), nullptr);
  EXPECT_EQ(findBox("SET"), nullptr);
  EXPECT_EQ(findBox("tond"), nullptr);
  EXPECT_EQ(findBox(""), nullptr);
  EXPECT_EQ(findBox("ZZZ"), nullptr);
}

} // namespace
} // namespace rung::frontend::nct::test

// The instruction table against the inventory, every row's example through the compiler, and errors made from the rows.
#include <algorithm>
#include <fstream>
#include <map>

#include <gtest/gtest.h>

#include "frontend/dialects/technol/rows/operand_kinds.h"
#include "ir/core/op_info.h"
#include "rtlib/nc/technol/services.h"
#include "tests/unit/technol/program.h"

namespace rung::technol_test {
namespace {

using namespace frontend::technol;
using frontend::InstructionInfo;
using frontend::OperandInfo;
using frontend::OperandKindInfo;

// ---- the inventory --------------------------------------------------------------------------------------------------

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

// Commas part operands, also those in brackets; `...` is no operand of its own.
size_t operandsIn(const std::string& field) {
  if (field == "-") return 0;
  const auto commas = static_cast<size_t>(std::count(field.begin(), field.end(), ','));
  return field.find("...") == std::string::npos ? commas + 1 : commas;
}

// The end of a module is not listed where the module is only named, and DQ stands in the line of DD.
constexpr std::string_view kBeyondInventory[] = {"MODULE_FASTEST_END", "MODULE_CYCLICOPERATION_END", "DQ"};

void agree(const Row& row, const std::vector<std::string>& csv) {
  const InstructionInfo& info = row.info;
  EXPECT_EQ(info.ref, csv[1] + ", l." + csv[6]) << info.mnemonic;
  EXPECT_EQ(info.terminating, csv[4] == "yes") << info.mnemonic;
  if (row.role != Role::Code) return;
  EXPECT_EQ(info.operands.size(), operandsIn(csv[3])) << info.mnemonic;
  // Behind a wait both registers are lost.
  const bool waits = (row.effects & kWaits) != 0;
  EXPECT_EQ(waits || (row.effects & kSetsRlo), csv[5] == "RLO" || csv[5] == "both") << info.mnemonic << " and RLO";
  EXPECT_EQ(waits || (row.effects & kSetsDr), csv[5] == "DR" || csv[5] == "both") << info.mnemonic << " and DR";
}

TEST(TechnolTable, AgreesWithTheInventory) {
  std::ifstream file("tests/unit/technol/instructions.csv");
  ASSERT_TRUE(file) << "run in the root of the repository";
  std::map<std::string_view, const Row*> rows;
  for (const Row& row : allRows())
    EXPECT_TRUE(rows.emplace(row.info.mnemonic, &row).second) << row.info.mnemonic << " twice";
  for (std::string_view name : kBeyondInventory) EXPECT_EQ(rows.erase(name), 1u) << name;
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    const std::vector<std::string> csv = fieldsOf(line);
    ASSERT_EQ(csv.size(), 7u) << line;
    const auto found = rows.find(csv[0]);
    if (found == rows.end()) {
      ADD_FAILURE() << csv[0] << " is missing in the table, or twice in the inventory";
      continue;
    }
    agree(*found->second, csv);
    rows.erase(found);
  }
  for (const auto& [mnemonic, row] : rows) ADD_FAILURE() << mnemonic << " is not in the inventory";
}

TEST(TechnolTable, RowsAreComplete) {
  for (const Row& row : allRows()) {
    const InstructionInfo& info = row.info;
    EXPECT_FALSE(info.title.empty() || info.group.empty() || info.ref.empty() || info.doc.empty()) << info.mnemonic;
    EXPECT_FALSE(info.example.empty()) << info.mnemonic;
    std::string example(info.example); // `struc` and `ends` are written small
    for (char& c : example) c = static_cast<char>(std::toupper(c));
    EXPECT_NE(example.find(info.mnemonic), std::string::npos) << info.mnemonic;
    for (const OperandInfo& operand : info.operands.all()) {
      EXPECT_FALSE(operand.name.empty() || operand.doc.empty()) << info.mnemonic << ' ' << operand.name;
    }
  }
}

TEST(TechnolTable, NamesAreFoundInAnyCase) {
  for (const Row& row : allRows()) EXPECT_EQ(findRow(row.info.mnemonic), &row);
  EXPECT_EQ(findRow("ldr"), findRow("LDR"));
  EXPECT_EQ(findRow("Jlo"), findRow("JL0"));
  for (const char* none : {"LDRX", "LD", ""}) EXPECT_EQ(findRow(none), nullptr) << none;
}

// What the control knows of the services of devices is what the rows say of them.
TEST(TechnolTable, DeviceServicesAgreeWithTheirRows) {
  using nc::technol::Device;
  for (const nc::technol::DeviceService& device : nc::technol::deviceServices()) {
    if (device.device == Device::None || device.device == Device::Bytes) continue; // of no instruction
    const nc::ServiceRow& service = device.service;
    const Row* row = findRow(service.name);
    ASSERT_NE(row, nullptr) << service.name;
    EXPECT_EQ(device.answer.waits, (row->effects & kWaits) != 0) << service.name;
    const bool rlo = service.results.find("RLO").has_value(), dr = service.results.find("DR").has_value();
    if (!device.answer.waits) EXPECT_EQ(rlo, (row->effects & kSetsRlo) != 0) << service.name;
    EXPECT_EQ(dr, (row->effects & kSetsDr) != 0) << service.name;
  }
}

// ---- examples -------------------------------------------------------------------------------------------------------

// What the examples and the operands of the kinds name.
constexpr std::string_view kData = "DFM A1,B1,A2,OUT1\nDFM LAMP,PUMP,GO,DOOR,READY,CHAIN_STOPPED\nDFM BIT0\n"
                                   "LIMIT: DS 2\nCOUNT: DS 2\nSPEED: DS 2\nPOS: DS 4\nRATIO: DS 8\nTABLE: DS 100\n"
                                   "CELL1: DS 1\nCELL2: DS 2\nCELL4: DS 4\nARRAY: DS 16\nTEXT1: STR 10\n";

bool declares(const std::string& text, const std::string& declaration) {
  return text.find(declaration) != std::string::npos;
}

// The data without what the text itself declares.
std::string dataFor(const std::string& text) {
  std::string data(kData);
  for (const std::string name : {"COUNT", "SPEED", "TABLE"})
    if (declares(text, name + ": DS"))
      data.erase(data.find(name + ": DS"), data.find('\n', data.find(name + ": DS")) + 1 - data.find(name + ": DS"));
  return data;
}

// Code with the procedure, the mechanism and the labels that it may name; within a mechanism where it waits.
std::string frame(const std::string& code, bool waits) {
  std::string text;
  for (const std::string name : {"TOGGLE", "PROC1"})
    if (!declares(code, "PROC_BEGIN " + name)) text += " PROC_BEGIN " + name + "\n PROC_END " + name + "\n";
  for (const std::string name : {"CLAMP", "MECH1"})
    if (!declares(code, "MECH_BEGIN " + name)) text += " MECH_BEGIN " + name + "\n MECH_END " + name + "\n";
  if (waits) text += " MECH_BEGIN FRAME\n";
  text += code + "\n";
  for (const std::string label : {"ERROR:", "LABEL1:"}) text += label + " LOD 0\n";
  return waits ? text + " MECH_END FRAME\n" : text;
}

// A program with the modules of an example in the place of its own.
std::string withModules(const std::string& example) {
  std::string text = declares(example, "DATA\n") ? example + "\n" : "DATA\n" + dataFor(example) + "DATA_END\n";
  if (declares(example, "DATA\n")) text.insert(5, dataFor(example));
  for (const std::string name : {"INPUT", "BLOCK_INIT", "BLOCK_DONE", "MAIN", "INIT", "DONE", "CLEAR", "HALT", "FAST",
                                 "CONT", "FASTEST", "CYCLICOPERATION"}) {
    const std::string module = "MODULE_" + name;
    const bool optional =
        name == "DONE" || name == "FAST" || name == "CONT" || name == "FASTEST" || name == "CYCLICOPERATION";
    if (declares(example, module + "\n"))
      text += example + "\n";
    else if (name == "MAIN")
      text += module + "\n MECH_BEGIN CLAMP\n MECH_END CLAMP\n" + module + "_END\n";
    else if (!optional)
      text += module + "\n" + module + "_END\n";
  }
  return declares(example, "\nSTOP") ? text : text + "STOP\n";
}

bool isDeclaration(Role role) {
  return role == Role::Dfm || role == Role::Ds || role == Role::Str || role == Role::Equi || role == Role::MemberSize;
}

// A program with code in the module where the row may stand; INPUT1 is a logical input.
std::string inItsModule(const Row& row, const std::string& code, const std::string& data) {
  const std::string framed = frame(code, (row.effects & kWaits) != 0);
  const std::string input = " DEF_IN INPUT1,'Input',TYPE_DWORD\n";
  if (row.effects & kInitOnly) return programText({.data = data, .init = input + framed});
  return programText({.data = data, .main = framed, .init = input});
}

std::string exampleProgram(const Row& row) {
  const std::string example(row.info.example);
  if (row.role == Role::Module || row.role == Role::ModuleEnd || row.role == Role::Stop) return withModules(example);
  if (isDeclaration(row.role)) return programText({.data = example + "\n"});
  return inItsModule(row, example, dataFor(example));
}

TEST(TechnolTable, ExamplesCompile) {
  for (const Row& row : allRows()) {
    const Compilation c = compile({exampleProgram(row)});
    if (row.info.mnemonic == "T_INCLUDE") { // its file is not here
      EXPECT_NE(c.text().find("[include-not-found]"), std::string::npos) << c.text();
      continue;
    }
    EXPECT_TRUE(c.errors().empty() && c.warnings().empty()) << row.info.mnemonic << '\n' << c.text();
  }
}

// ---- operands -------------------------------------------------------------------------------------------------------

std::vector<const Row*> rowsWithOperands() {
  std::vector<const Row*> rows;
  for (const Row& row : allRows())
    if (row.role == Role::Code) rows.push_back(&row);
  return rows;
}

// The two registers of MOV are fixed; its operands are named as they are written.
std::string good(const OperandInfo& operand) {
  const bool isRegister = std::holds_alternative<RegisterKind>(kindOf(operand).takes);
  return std::string(isRegister ? operand.name : operand.kind->good);
}

std::vector<std::string> goodOperands(const Row& row, bool optional = true) {
  std::vector<std::string> operands;
  for (const OperandInfo& operand : row.info.operands.all())
    if (optional || !operand.optional) operands.push_back(good(operand));
  return operands;
}

std::string statement(const Row& row, const std::vector<std::string>& operands) {
  std::string text = " " + std::string(row.info.mnemonic);
  for (size_t i = 0; i < operands.size(); ++i) text += (i == 0 ? " " : ",") + operands[i];
  return text;
}

Compilation with(const Row& row, const std::vector<std::string>& operands) {
  return compile({inItsModule(row, statement(row, operands), std::string(kData))});
}

// The codes of the errors, without their places.
std::vector<std::string> codesOf(const Compilation& c) {
  std::vector<std::string> codes;
  for (const std::string& error : c.errors()) codes.push_back(error.substr(error.find(' ') + 1));
  return codes;
}

using Codes = std::vector<std::string>;

// LA, LO and LX without operand need a value on the stack.
bool popsWithoutOperand(const Row& row) { return (row.effects & kJoins) != 0; }

TEST(TechnolTable, GoodOperandsAreAccepted) {
  for (const Row* row : rowsWithOperands()) {
    const Compilation all = with(*row, goodOperands(*row));
    EXPECT_EQ(codesOf(all), Codes{}) << row->info.mnemonic << '\n' << all.text();
    const Compilation least = with(*row, goodOperands(*row, false));
    EXPECT_EQ(codesOf(least), popsWithoutOperand(*row) ? Codes{"stack-underflow"} : Codes{})
        << row->info.mnemonic << '\n'
        << least.text();
  }
}

TEST(TechnolTable, BadOperandsGiveTheCodeOfTheirKind) {
  for (const Row* row : rowsWithOperands()) {
    for (size_t i = 0; i < row->info.operands.size(); ++i) {
      std::vector<std::string> operands = goodOperands(*row);
      const OperandKindInfo& kind = *row->info.operands[i].kind;
      operands[i] = kind.bad;
      const Compilation c = with(*row, operands);
      EXPECT_EQ(codesOf(c), Codes{std::string(kind.badCode)})
          << row->info.mnemonic << ' ' << row->info.operands[i].name << '\n'
          << c.text();
    }
  }
}

TEST(TechnolTable, CountsAreChecked) {
  for (const Row* row : rowsWithOperands()) {
    std::vector<std::string> fewer = goodOperands(*row, false), more = goodOperands(*row);
    if (!fewer.empty()) {
      fewer.pop_back();
      EXPECT_EQ(codesOf(with(*row, fewer)), Codes{"operand-count"}) << row->info.mnemonic;
    }
    const bool repeated = !more.empty() && row->info.operands[more.size() - 1].repeated;
    more.push_back(repeated ? more.back() : "BIT0");
    EXPECT_EQ(codesOf(with(*row, more)), repeated ? Codes{} : Codes{"operand-count"}) << row->info.mnemonic;
  }
}

// ---- effects --------------------------------------------------------------------------------------------------------

// Reads and writes of the registers' slots in a routine.
uint16_t effectsOf(const ir::Module& module, std::string_view routine) {
  uint16_t effects = 0;
  for (const ir::Routine& r : module.routines) {
    if (r.name != routine) continue;
    for (const ir::Rung& rung : r.rungs)
      for (const ir::Op& op : rung.ops) {
        const std::string_view name = ir::opInfo(op.code).name;
        const bool loads = name == "slot_load";
        if (!loads && name != "slot_store") continue;
        const std::string& key = module.slots[op.ref].key;
        if (key == "RLO") effects |= loads ? kReadsRlo : kSetsRlo;
        if (key == "DR") effects |= loads ? kReadsDr : kSetsDr;
      }
  }
  return effects;
}

// Alone in a procedure an instruction takes the registers from its caller and gives back what it changes, so its
// lowering shows what the row says. Waits stand in no procedure; a call leaves both registers to the procedure that it
// calls.
TEST(TechnolTable, EffectsAreThoseOfTheLowering) {
  constexpr uint16_t kRegisters = kReadsRlo | kSetsRlo | kReadsDr | kSetsDr;
  for (const Row* row : rowsWithOperands()) {
    if (row->role != Role::Code || (row->effects & kWaits) || row->info.mnemonic == "PROC_CALL") continue;
    auto operands = goodOperands(*row, popsWithoutOperand(*row));
    if ((row->effects & kDrIfNotGiven) && !row->info.operands[0].optional && mayBeOmitted(row->info.operands[0]))
      operands[0] = "-";
    const std::string label = (row->effects & kJumps) ? "LABEL1:\n" : "";
    const std::string units = " PROC_BEGIN PROC1\n PROC_END PROC1\n MECH_BEGIN MECH1\n MECH_END MECH1\n";
    const std::string alone = " PROC_BEGIN ALONE\n" + statement(*row, operands) + "\n" + label + " PROC_END ALONE\n";
    const Compilation c = compile({programText(
        {.data = std::string(kData), .main = units + alone, .init = " DEF_IN INPUT1,'Input',TYPE_DWORD\n"})});
    ASSERT_NE(c.module, nullptr) << row->info.mnemonic << '\n' << c.text();
    const uint16_t kept = (row->effects & kKeepsDr) != 0 ? kReadsDr : 0; // to leave it as it is
    EXPECT_EQ(effectsOf(*c.module, "PROC ALONE"), (row->effects & kRegisters) | kept) << row->info.mnemonic;
  }
}

} // namespace
} // namespace rung::technol_test

// The table of instructions against the inventory, and operands that are right and wrong by its rows.
#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include <gtest/gtest.h>

#include "frontend/dialects/technol/instructions.h"
#include "frontend/dialects/technol/operand.h"
#include "tests/unit/technol/program.h"

namespace rung::technol_test {
namespace {

using frontend::InstructionInfo;
using frontend::OperandInfo;
using frontend::technol::OperandKind;
using frontend::technol::Role;
using frontend::technol::Row;

TEST(TechnolTable, HoldsTheInventory) {
  std::ifstream file("frontend/dialects/technol/instructions.csv");
  std::string line;
  std::getline(file, line);
  std::set<std::string> inventory;
  while (std::getline(file, line)) {
    const std::string mnemonic = line.substr(0, line.find(','));
    inventory.insert(mnemonic);
    const Row* row = frontend::technol::findRow(mnemonic);
    ASSERT_TRUE(row) << mnemonic;
    // Behind the operands, which may be quoted: terminating, modifies, line.
    std::vector<std::string> fields;
    std::istringstream rest(line);
    for (std::string field; std::getline(rest, field, ',');) fields.push_back(field);
    EXPECT_EQ(row->info.terminating, fields[fields.size() - 3] == "yes") << mnemonic;
  }
  EXPECT_GT(inventory.size(), 190u);
  for (const Row& row : frontend::technol::allRows()) {
    const std::string name(row.info.mnemonic);
    // The manual's table has no ends of the modules that it only names, and no DQ.
    if (name == "MODULE_FASTEST_END" || name == "MODULE_CYCLICOPERATION_END" || name == "DQ") continue;
    EXPECT_TRUE(inventory.contains(name)) << name;
  }
}

TEST(TechnolTable, KindsOfOperandsExist) {
  for (const Row& row : frontend::technol::allRows())
    for (const OperandInfo& operand : row.info.operands.all())
      EXPECT_TRUE(frontend::technol::findOperandKind(operand.kind)) << row.info.mnemonic << " " << operand.kind;
}

TEST(TechnolTable, NamesAreFoundInAnyCase) {
  EXPECT_EQ(frontend::technol::findRow("ldr"), frontend::technol::findRow("LDR"));
  EXPECT_EQ(frontend::technol::findRow("Jlo"), frontend::technol::findRow("JL0"));
  EXPECT_EQ(frontend::technol::findRow("LDRX"), nullptr);
  EXPECT_EQ(frontend::technol::findRow("LD"), nullptr);
  EXPECT_EQ(frontend::technol::findRow(""), nullptr);
}

bool isGenerated(const Row& row) { return row.role == Role::Code && row.info.mnemonic != "MOV"; }

// A program in which the statement may stand, with the names that the kinds' examples use. The statement is line 22.
Compilation around(const std::string& statement) {
  return compileMain("  PROC_BEGIN PROC1\n  CA\n  PROC_END PROC1\n  MECH_BEGIN MECH1\n  EX\n  LDR BIT0\n  LA BIT0\n" + statement +
                         "\nLABEL1: EX\n  MECH_END MECH1\n",
                     "  DFM BIT0\nCELL1: DS 1\nCELL2: DS 2\nCELL4: DS 4\nARRAY: DS 16\nTEXT1: STR 8\nTEXT2: STR 8\nREST: DS 8\n");
}
constexpr const char* kLine = "0:21 ";

std::string operandsOf(const Row& row, size_t count, size_t wrong = SIZE_MAX) {
  const auto infos = row.info.operands.all();
  std::string text;
  for (size_t i = 0; i < count; ++i) {
    const OperandKind& kind = *frontend::technol::findOperandKind(infos[std::min(i, infos.size() - 1)].kind);
    text += (i == 0 ? " " : ",") + std::string(i == wrong ? kind.info.bad : kind.info.good);
  }
  return text;
}

using Lines = std::vector<std::string>;

// Errors of the statement's line; MOVE-like instructions get two operands of one kind, so that they are right.
Lines codes(const Compilation& c) {
  Lines found;
  for (const std::string& line : c.errors())
    if (line.starts_with(kLine)) found.push_back(line.substr(std::string(kLine).size()));
    else found.push_back("elsewhere: " + line);
  return found;
}

TEST(TechnolTable, GoodOperandsAreAccepted) {
  for (const Row& row : frontend::technol::allRows()) {
    if (!isGenerated(row)) continue;
    const std::string statement = "  " + std::string(row.info.mnemonic) + operandsOf(row, row.info.operands.size());
    const bool stack = row.info.mnemonic == "LDR"; // pushes: something is left on the stack
    const Compilation c = around(statement + (stack ? "\n LA" : ""));
    EXPECT_EQ(codes(c), Lines{}) << statement << "\n" << c.text();
  }
}

TEST(TechnolTable, WrongOperandsAreReported) {
  int tried = 0;
  for (const Row& row : frontend::technol::allRows()) {
    if (!isGenerated(row)) continue;
    for (size_t i = 0; i < row.info.operands.size(); ++i) {
      const OperandKind& kind = *frontend::technol::findOperandKind(row.info.operands[i].kind);
      ASSERT_FALSE(kind.info.bad.empty()) << kind.info.kind;
      const std::string statement = "  " + std::string(row.info.mnemonic) + operandsOf(row, row.info.operands.size(), i);
      const Compilation c = around(statement + (row.info.mnemonic == "LDR" ? "\n LA" : ""));
      EXPECT_EQ(codes(c), Lines{std::string(kind.info.badCode)}) << statement << "\n" << c.text();
      ++tried;
    }
  }
  EXPECT_GT(tried, 50);
}

TEST(TechnolTable, TooFewAndTooManyOperandsAreReported) {
  for (const Row& row : frontend::technol::allRows()) {
    if (!isGenerated(row)) continue;
    size_t least = 0;
    for (const OperandInfo& operand : row.info.operands.all()) least += operand.optional ? 0 : 1;
    const size_t most = row.info.operands.size();
    Lines statements;
    if (least > 0) statements.push_back("  " + std::string(row.info.mnemonic) + operandsOf(row, least - 1));
    const bool repeated = most > 0 && row.info.operands[most - 1].repeated;
    if (!repeated) statements.push_back("  " + std::string(row.info.mnemonic) + (most == 0 ? " BIT0" : operandsOf(row, most) + ",BIT0"));
    for (const std::string& statement : statements) {
      const Compilation c = around(statement + (row.info.mnemonic == "LDR" ? "\n LA" : ""));
      EXPECT_EQ(codes(c), Lines{"operand-count"}) << statement << "\n" << c.text();
    }
  }
}

} // namespace
} // namespace rung::technol_test

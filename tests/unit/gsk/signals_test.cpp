// All signals of the table as operands: a program that names them is the program that has their addresses.
#include <algorithm>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

#include "frontend/dialects/gsk/language.h"
#include "frontend/dialects/gsk/read/signals.h"
#include "rtlib/nc/gsk/signals.h"
#include "tests/unit/gsk/compile.h"

namespace rung::frontend::gsk::test {
namespace {

// The CSV itself, read a second time: address, bit, symbol, direction, type.
struct CsvRow {
  std::string address;
  std::string symbol;
  bool isBit = false;
  bool isInput = false;
};

std::vector<CsvRow> csvRows() {
  std::ifstream in("rtlib/nc/gsk/signals.csv");
  std::vector<CsvRow> rows;
  std::string line;
  std::getline(in, line);
  while (std::getline(in, line)) {
    std::istringstream fields(line);
    std::string address, bit, symbol, direction;
    std::getline(fields, address, ',');
    std::getline(fields, bit, ',');
    std::getline(fields, symbol, ',');
    if (symbol.starts_with('"')) { // "DIGIT1,DIGIT2"
      std::string rest;
      std::getline(fields, rest, '"');
      symbol = symbol.substr(1) + "," + rest;
      std::getline(fields, rest, ',');
    }
    std::getline(fields, direction, ',');
    rows.push_back({bit.empty() ? address : address + "." + bit, symbol, !bit.empty(), direction == "in"});
  }
  return rows;
}

// T00 to T31 are addresses of area T.
bool isAddress(const CsvRow& row) { return frontend::network::splitAddress(kLanguage, row.symbol).has_value(); }

// Reads `operand`, and writes it where the row may be written.
void appendUses(const CsvRow& row, const std::string& operand, std::string& text) {
  if (row.isBit) {
    text += "LD " + operand + "\nOUT R0.0\n";
    if (!row.isInput) text += "LDI R0.1\nSET " + operand + "\n";
  } else {
    text += "LD R0.2\nFUNC MOVB\nPRM " + operand + "\nPRM R10\n";
    if (!row.isInput) text += "LD R0.2\nFUNC MOVB\nPRM R10\nPRM " + operand + "\n";
  }
}

std::vector<uint64_t> keysOf(const ir::Module& module) {
  std::vector<uint64_t> keys;
  for (const ir::Routine& routine : module.routines)
    for (const ir::Rung& rung : routine.rungs) keys.push_back(rung.key);
  return keys;
}

TEST(Signals, EveryNameIsItsAddress) {
  const std::vector<CsvRow> rows = csvRows();
  ASSERT_EQ(rows.size(), nc::gskSignals().size());
  std::string named = "FUNC 0\n", addressed = "FUNC 0\n";
  size_t addresses = 0;
  for (const CsvRow& row : rows) {
    appendUses(row, isAddress(row) ? row.address : row.symbol, named);
    appendUses(row, row.address, addressed);
    addresses += isAddress(row) ? 1 : 0;
  }
  EXPECT_EQ(addresses, 32u) << "T00 to T31 only";
  const auto byName = compileList(named + "FUNC 1\n");
  const auto byAddress = compileList(addressed + "FUNC 1\n");
  ASSERT_NE(byName->module, nullptr) << byName->text();
  ASSERT_NE(byAddress->module, nullptr) << byAddress->text();
  EXPECT_TRUE(byName->codes().empty()) << byName->text();
  EXPECT_EQ(keysOf(*byName->module), keysOf(*byAddress->module));
}

TEST(Signals, EveryNameStandsInLadderText) {
  std::string ladder = "dialect gsk\nmodule LEVEL2\n", list = "FUNC 0\n";
  for (const CsvRow& row : csvRows()) {
    if (!row.isBit || isAddress(row)) continue;
    ladder += "rung\n|--[" + row.symbol + "]--[/" + row.symbol + "]--(R0.0)\n";
    list += "LD " + row.address + "\nANI " + row.address + "\nOUT R0.0\n";
    if (row.isInput) continue;
    ladder += "rung\n|--[R0.0]--(" + row.symbol + ")\nrung\n|--[R0.0]--(S " + row.symbol + ")\n";
    list += "LD R0.0\nOUT " + row.address + "\nLD R0.0\nSET " + row.address + "\n";
  }
  const auto drawn = compileLadder(ladder);
  const auto listed = compileList(list + "FUNC 1\n");
  ASSERT_NE(drawn->module, nullptr) << drawn->text();
  ASSERT_NE(listed->module, nullptr) << listed->text();
  EXPECT_EQ(keysOf(*drawn->module), keysOf(*listed->module));
}

TEST(Signals, InputsRejectWrites) {
  std::string text = "FUNC 0\n";
  Codes expected;
  int line = 1;
  for (const CsvRow& row : csvRows()) {
    if (!row.isInput || isAddress(row)) continue;
    text += row.isBit ? "LD R0.0\nOUT " + row.symbol + "\n" : "LD R0.0\nFUNC MOVB\nPRM R10\nPRM " + row.symbol + "\n";
    line += row.isBit ? 2 : 4;
    expected.push_back(std::to_string(line) + " write-to-input");
  }
  auto result = std::make_unique<Compiled>();
  result->diagnostics.setErrorLimit(10000);
  const FileId file = result->sources.addBuffer("test.pmc", text + "FUNC 1\n");
  result->module = kGsk.compile(result->sources, {&file, 1}, {}, result->diagnostics);
  EXPECT_EQ(result->module, nullptr);
  const auto isInput = [](const nc::Signal& signal) { return signal.direction == nc::Direction::In; };
  EXPECT_EQ(expected.size(), std::ranges::count_if(nc::gskSignals(), isInput) - 32) << "all but T00 to T31";
  EXPECT_EQ(result->codes(), expected);
}

TEST(Signals, TCodesAreWrittenByAddress) {
  const auto result = compileList("FUNC 0\nLD T05\nOUT R0.0\nFUNC 1\n");
  EXPECT_EQ(result->codes(), Codes{"2 bit-address-expected"});
  EXPECT_NE(result->text().find("F26.5"), std::string::npos) << result->text();
}

TEST(Signals, ADeclaredNameGoesFirstAndMayNameASignal) {
  const auto result =
      compileList("symbol ST X9.1\nsymbol STOP *ESP\nFUNC 0\nLD ST\nOUT R0.0\nLD STOP\nOUT R0.0\nFUNC 1\n");
  const auto plain = compileList("FUNC 0\nLD X9.1\nOUT R0.0\nLD G8.4\nOUT R0.0\nFUNC 1\n");
  ASSERT_NE(result->module, nullptr) << result->text();
  EXPECT_EQ(keysOf(*result->module), keysOf(*plain->module));
}

TEST(Signals, MisspeltNamesAreGuessed) {
  const auto note = [](const std::string& name) {
    return compileList("FUNC 0\nLD " + name + "\nOUT R0.0\nFUNC 1\n")->text();
  };
  EXPECT_NE(note("key_auto").find("did you mean KEY_AUTO (X0.0,"), std::string::npos) << note("key_auto");
  EXPECT_NE(note("ESP").find("did you mean *ESP (G8.4,"), std::string::npos) << note("ESP");
  EXPECT_NE(note("KEY_ATUO").find("did you mean KEY_AUTO"), std::string::npos) << note("KEY_ATUO");
  EXPECT_EQ(note("NOTHING_LIKE_IT").find("did you mean"), std::string::npos);
}

TEST(Signals, SignalsOfTheOtherMachineGiveAWarning) {
  const std::string uses = "FUNC 0\nLD R0.0\nOUT *TSB\nLD R0.0\nOUT G60.6\nLD R0.0\nFUNC MOVB\nPRM R10\n"
                           "PRM DIGIT1,DIGIT2\nLD R0.0\nOUT Y123.2\nLD R0.0\nFUNC MOVB\nPRM R10\nPRM G60\nFUNC 1\n";
  const auto codesOn = [&](const char* machine) {
    frontend::CompileOptions options;
    if (*machine != 0) options.config["machine"] = machine;
    return compileList(uses, options)->codes();
  };
  EXPECT_EQ(codesOn(""), Codes{});
  EXPECT_EQ(codesOn("mill"), Codes{"3 signal-of-other-machine"});
  EXPECT_EQ(codesOn("turn"), (Codes{"9 signal-of-other-machine", "11 signal-of-other-machine"}));
  EXPECT_EQ(codesOn("grind"), Codes{"- constant-out-of-range"});
}

TEST(Signals, ExplainKnowsNamesAndAddresses) {
  EXPECT_EQ(explainWord("mf").substr(0, 14), "[gsk] MF: F7.0");
  EXPECT_EQ(explainWord("F007.0"), explainWord("MF"));
  EXPECT_NE(explainWord("F10").find("M00~M31: F10 (4 bytes)"), std::string::npos);
  EXPECT_NE(explainWord("F13.7").find("M31: F13.7"), std::string::npos);
  EXPECT_NE(explainWord("R10.0").find("not a signal"), std::string::npos);
  EXPECT_EQ(explainWord("R10.8"), "");
  EXPECT_EQ(explainWord("X128"), "");
  EXPECT_EQ(explainWord("NO_SUCH"), "");
}

} // namespace
} // namespace rung::frontend::gsk::test

// Diagnostics of command lists: each code at its line, several in one run, none that follow from another.
#include <gtest/gtest.h>

#include "tests/unit/gsk/compile.h"

namespace rung::frontend::gsk::test {
namespace {

// A program with an empty Level 1; the text begins in line 2.
std::string level2(const std::string& text) { return listed(compileList("FUNC 0\n" + text + "FUNC 1\n")->codes()); }

TEST(GskList, ManualExampleCompiles) {
  const auto program = compileList(R"(FUNC 0            ; END1, no Level 1
LD   X002.1
SET  Y003.7
LD   X001.3
RST  Y003.7
LD   R0.1         ; RST
LD   R0.0         ; ACT
FUNC 21           ; ADDB
PRM  0002         ; 2 bytes, constant
PRM  D10
PRM  1000
PRM  D20
OUT  R10.0
FUNC 1            ; END2
)");
  EXPECT_EQ(program->text(), "");
  ASSERT_NE(program->module, nullptr);
  EXPECT_EQ(program->module->routines.size(), 2u);
}

TEST(GskList, StepColumnCaseAndLeadingZerosDoNotMatter) {
  EXPECT_EQ(level2("0001 ld x002.01\n"), "2 bad-bit-number, 3 wrong-condition-count");
  EXPECT_EQ(
      level2(
          "0001 ld x002.1\n0002 out y0003.7\n0003\n\n4 Ld X1.0\n5 func ADDb\n6 prm 1\n7 Prm D1\n8 prm 1\n9 prm d2\n"),
      "7 wrong-condition-count, 7 missing-output");
}

TEST(GskList, Words) {
  EXPECT_EQ(level2("LOAD X0.0\nOUT Y0.0\n"), "2 unknown-command");
  EXPECT_EQ(level2("LD\nOUT Y0.0\n"), "2 bad-operand");
  EXPECT_EQ(level2("LD X0.0 X0.1\nOUT Y0.0\n"), "2 bad-operand");
  EXPECT_EQ(level2("LD X0.0\nLD X0.1\nORB X0.2\nOUT Y0.0\n"), "4 bad-operand");
  EXPECT_EQ(level2("LD X0.0\nOUT Y0.0 ; \xD0\xA1 in a comment is fine\n"), "");
  EXPECT_EQ(level2("LD \xD0\xA1"
                   "0.0\nOUT Y0.0\n"),
            "2 bad-character");
  EXPECT_EQ(level2("FUNC 999\nPRM 1\nOUT Y0.0\n"), "2 unknown-function");
  EXPECT_EQ(level2("FUNC NOPE\nPRM 1\nPRM 2\nOUT Y0.0\n"), "2 unknown-function");
  EXPECT_EQ(level2("FUNC 44\n"), "2 wrong-condition-count, 2 missing-output, 2 wrong-parameter-count");
  EXPECT_EQ(level2("dialect gsk\n"), "");
  EXPECT_EQ(level2("dialect nct\n"), "2 dialect-conflict");
}

TEST(GskList, Addresses) {
  const auto bit = [](const std::string& operand) { return level2("LD " + operand + "\nOUT Y0.0\n"); };
  EXPECT_EQ(bit("X127.7"), "");
  EXPECT_EQ(bit("X128.0"), "2 address-out-of-range");
  EXPECT_EQ(bit("R1099.0"), "");
  EXPECT_EQ(bit("R1100.0"), "2 address-out-of-range");
  EXPECT_EQ(bit("R99999999999999999999.0"), "2 address-out-of-range");
  EXPECT_EQ(bit("X0.8"), "2 bad-bit-number");
  EXPECT_EQ(bit("X0.10"), "2 bad-bit-number");
  EXPECT_EQ(bit("X0."), "2 bad-bit-number");
  EXPECT_EQ(bit("X0"), "2 bit-address-expected");
  EXPECT_EQ(bit("Q0.0"), "2 bad-operand");
  EXPECT_EQ(bit("100"), "2 bad-operand");
  EXPECT_EQ(bit("MF"), "") << "a signal of the CNC, F7.0";
  EXPECT_EQ(bit("*ESP"), "") << "G8.4";
  EXPECT_EQ(bit("RST"), "") << "F1.1: in an operand no command can stand";
  EXPECT_EQ(bit("*ESQ"), "2 bad-operand");
  const auto move = [](const std::string& from, const std::string& to) {
    return level2("LD X0.0\nFUNC MOVW\nPRM " + from + "\nPRM " + to + "\n");
  };
  EXPECT_EQ(move("X126", "Y126"), "");
  EXPECT_EQ(move("X127", "Y126"), "4 address-out-of-range");
  EXPECT_EQ(move("D10", "D1859"), "5 address-out-of-range");
  EXPECT_EQ(move("D10.0", "D20"), "4 byte-address-expected");
  EXPECT_EQ(move("D10", "X20"), "5 write-to-input");
  EXPECT_EQ(move("D10", "F20"), "5 write-to-input");
  EXPECT_EQ(move("D10", "T20"), "5 write-to-preset");
  EXPECT_EQ(move("D10", "C0"), "5 write-to-preset");
  EXPECT_EQ(move("D10", "C2"), "") << "the value of counter 1";
  EXPECT_EQ(move("D10", "C3"), "5 write-to-preset") << "its second byte is counter 2's preset";
  EXPECT_EQ(move("D10", "R999"), "5 system-area-write") << "its second byte is R1000";
}

TEST(GskList, Outputs) {
  const auto coil = [](const std::string& command) { return level2("LD X0.0\n" + command + "\n"); };
  EXPECT_EQ(coil("OUT X0.0"), "3 write-to-input");
  EXPECT_EQ(coil("SET F0.0"), "3 write-to-input");
  EXPECT_EQ(coil("RST T0.0"), "3 write-to-preset");
  EXPECT_EQ(coil("OUTI C4.0"), "3 write-to-preset");
  EXPECT_EQ(coil("OUT R1000.0"), "3 system-area-write");
  EXPECT_EQ(coil("OUT K31.7"), "");
}

TEST(GskList, Stack) {
  EXPECT_EQ(level2("LD X0.0\nLD X0.1\nOUT Y0.0\n"), "4 unbalanced-stack");
  EXPECT_EQ(level2("OUT Y0.0\n"), "2 unbalanced-stack");
  EXPECT_EQ(level2("AND X0.0\nAND X0.1\nOUT Y0.0\n"), "2 unbalanced-stack");
  EXPECT_EQ(level2("LD X0.0\nORB\nANB\nOUT Y0.0\n"), "3 unbalanced-stack");
  EXPECT_EQ(level2("LD X0.0\nOUT Y0.0\nOUT Y0.1\nRST Y0.2\n"), "") << "parallel outputs";
  EXPECT_EQ(level2("LD X0.0\nOUT Y0.0\nAND X0.1\nOUT Y0.1\n"), "4 multi-level-output");
  EXPECT_EQ(level2("LD X0.0\nOUT Y0.0\nANB\nOUT Y0.1\n"), "4 multi-level-output");
  EXPECT_EQ(level2("LD X0.0\nFUNC 26\nPRM 1\nAND X0.1\nOUT Y0.1\n"), "5 multi-level-output");
  EXPECT_EQ(level2("LD X0.0\nFUNC MOVB\nPRM D0\nPRM D1\nOUT Y0.1\nOUT Y0.2\n"), "6 unbalanced-stack");
  EXPECT_EQ(listed(compileList("FUNC 0\nFUNC 1\nLD X0.0\n")->codes()), "3 unbalanced-stack, 3 code-after-end2");
}

TEST(GskList, StackDepth) {
  std::string nine, ten;
  for (int i = 0; i < 9; ++i) nine += "LD X0.0\n";
  ten = nine + "LD X0.0\n";
  std::string joins;
  for (int i = 0; i < 8; ++i) joins += "ORB\n";
  EXPECT_EQ(level2(nine + joins + "OUT Y0.0\n"), "");
  EXPECT_EQ(level2(ten + joins + "ORB\nOUT Y0.0\n"), "11 stack-overflow");
}

TEST(GskList, Functions) {
  EXPECT_EQ(level2("FUNC TMR\nPRM 1\nOUT Y0.0\n"), "2 wrong-condition-count");
  EXPECT_EQ(level2("LD X0.0\nFUNC TMR\nOUT Y0.0\n"), "3 wrong-parameter-count");
  EXPECT_EQ(level2("LD X0.0\nFUNC TMR\nPRM 1\nPRM 2\nOUT Y0.0\n"), "3 wrong-parameter-count");
  EXPECT_EQ(level2("LD X0.0\nFUNC TMR\nPRM 1\nLD X0.1\nOUT Y0.0\n"), "3 missing-output");
  EXPECT_EQ(listed(compileList("PRM 1\nFUNC 0\nFUNC 1\n")->codes()), "1 stray-parameter");
  EXPECT_EQ(level2("PRM 1\n"), "1 wrong-parameter-count") << "END1 has none";
  EXPECT_EQ(level2("LD X0.0\nOUT Y0.0\nPRM 1\n"), "4 stray-parameter");
  EXPECT_EQ(level2("LD X0.0\nOUT Y0.0\nTABLE 1\n"), "4 stray-table");
  EXPECT_EQ(level2("LD X0.0\nFUNC MOVB\nPRM D0\nPRM D1\nTABLE 1\n"), "6 stray-table");
}

TEST(GskList, Parameters) {
  const auto add = [](const std::string& format, const std::string& operand) {
    return level2("LD R0.0\nLD R0.1\nFUNC 21\nPRM " + format + "\nPRM D10\nPRM " + operand + "\nPRM D20\nOUT R0.2\n");
  };
  EXPECT_EQ(add("0001", "255"), "");
  EXPECT_EQ(add("1", "-128"), "");
  EXPECT_EQ(add("0001", "256"), "7 constant-out-of-range");
  EXPECT_EQ(add("0001", "-129"), "7 constant-out-of-range");
  EXPECT_EQ(add("0004", "0xFFFFFFFF"), "");
  EXPECT_EQ(add("0004", "4294967296"), "7 constant-out-of-range");
  EXPECT_EQ(add("1002", "D30"), "");
  EXPECT_EQ(add("1002", "1000"), "7 bad-operand");
  EXPECT_EQ(add("0002", "D30"), "7 bad-operand");
  EXPECT_EQ(add("0003", "5"), "5 bad-format");
  EXPECT_EQ(add("2002", "5"), "5 bad-format");
  EXPECT_EQ(add("00002", "5"), "5 bad-format");
  EXPECT_EQ(add("X", "5"), "5 bad-format");
  const auto timer = [](const std::string& parameters) { return level2("LD X0.0\n" + parameters + "OUT Y0.0\n"); };
  EXPECT_EQ(timer("FUNC 2\nPRM 100\n"), "");
  EXPECT_EQ(timer("FUNC 2\nPRM 101\n"), "4 parameter-out-of-range");
  EXPECT_EQ(timer("FUNC 2\nPRM 0\n"), "4 parameter-out-of-range");
  EXPECT_EQ(timer("FUNC 3\nPRM 200\nPRM 999999\n"), "");
  EXPECT_EQ(timer("FUNC 3\nPRM 201\nPRM 7\n"), "4 parameter-out-of-range, 5 parameter-out-of-range");
  EXPECT_EQ(timer("FUNC 4\nPRM 3\nPRM D0\nPRM R0\n"), "4 parameter-out-of-range");
  EXPECT_EQ(timer("FUNC 4\nPRM 0\nPRM D0\nPRM D4\n"), "6 work-area-not-in-r");
  EXPECT_EQ(level2("LD X0.0\nFUNC MOVE\nPRM 0011\nPRM 111\nPRM D0\nPRM D1\n"), "5 bad-mask");
  EXPECT_EQ(level2("LD X0.0\nFUNC MOVE\nPRM 0012\nPRM 1111\nPRM D0\nPRM D1\n"), "4 bad-mask");
  EXPECT_EQ(level2("LD X0.0\nFUNC JMP\nPRM 1\nFUNC JMPE\n"), "4 parameter-out-of-range");
  EXPECT_EQ(level2("LD R0.0\nLD X0.0\nFUNC DSCHB\nPRM 1\nPRM D0\nPRM R20\nPRM D1\nPRM D2\nOUT Y0.0\n"),
            "7 not-a-data-table");
  const auto search = [](const std::string& table) {
    return level2("LD R0.0\nLD X0.0\nFUNC DSCHB\nPRM 4\nPRM D0\nPRM " + table + "\nPRM D4\nPRM D8\nOUT Y0.0\n");
  };
  EXPECT_EQ(search("D1856"), "");
  EXPECT_EQ(search("D1857"), "7 address-out-of-range");
  EXPECT_EQ(search("K31"), "7 not-a-data-table") << "though its end is outside K, too";
  EXPECT_EQ(search("K32"), "7 address-out-of-range") << "there is no such place";
}

TEST(GskList, CodeTable) {
  const auto codb = [](const std::string& rest) {
    return level2("LD R0.0\nLD X0.0\nFUNC CODB\nPRM 1\nPRM 2\nPRM D0\nPRM D1\n" + rest + "OUT Y0.0\n");
  };
  EXPECT_EQ(codb("TABLE 1\nTABLE -1\n"), "");
  EXPECT_EQ(codb("TABLE 1\n"), "4 table-size-mismatch");
  EXPECT_EQ(codb("TABLE 1\nTABLE 2\nTABLE 3\n"), "4 table-size-mismatch");
  EXPECT_EQ(codb("TABLE 1\nTABLE 256\n"), "10 constant-out-of-range");
  EXPECT_EQ(codb("TABLE 1\nTABLE 2\nPRM D5\n"), "11 stray-parameter");
}

TEST(GskList, Symbols) {
  EXPECT_EQ(level2("LD START\nOUT LAMP\nsymbol START X10.0 ; start key\nsymbol LAMP Y10.0\n"), "");
  EXPECT_EQ(level2("symbol A1 X10.0\n"), "2 bad-operand") << "an address of area A";
  EXPECT_EQ(level2("symbol L12 X10.0\nsymbol P1 X10.0\nsymbol out X10.0\nsymbol ADDB X10.0\n"),
            "2 bad-operand, 3 bad-operand, 4 bad-operand, 5 bad-operand");
  EXPECT_EQ(level2("symbol S1 X10.0\nsymbol S1 X10.1\n"), "3 duplicate-symbol");
  EXPECT_EQ(level2("symbol S1 X10.9\nLD S1\nOUT Y0.0\n"), "2 bad-bit-number") << "uses stay silent";
  EXPECT_EQ(level2("symbol S1 X10\nLD S1\nOUT Y0.0\n"), "3 bit-address-expected");
  EXPECT_EQ(level2("symbol S1\n"), "2 bad-operand");
  EXPECT_EQ(level2("symbol CONST R0.0\nLD R0.0\nOUT Y0.0\n"), "2 bad-operand") << "a command's name";
  EXPECT_EQ(level2("symbol MF R0.0\nLD MF\nOUT Y0.0\n"), "") << "a program's name goes before a signal's";
}

TEST(GskList, OneRunReportsAllErrors) {
  EXPECT_EQ(level2("LD X128.0\nOUT X0.0\nLD X0.0\nAND X0.9\nFUNC 2\nPRM 200\nLD X0.1\nOUT Y0.0\n"),
            "2 address-out-of-range, 3 write-to-input, 5 bad-bit-number, 6 missing-output, 7 parameter-out-of-range");
}

TEST(GskList, ProgramSize) {
  std::string text = "FUNC 0\n";
  for (int i = 0; i < 5999; ++i) text += "LD X0.0\nOUT R9.0\n";
  EXPECT_EQ(listed(compileList(text + "FUNC 1\n")->codes()), "") << "12000 steps";
  EXPECT_EQ(listed(compileList(text + "LD X0.0\nOUT R9.0\nFUNC 1\n")->codes()), "12001 program-too-large");
}

// "LINE:COLUMN CODE" of every report.
std::string placesOf(const std::unique_ptr<Compiled>& program) {
  Codes result;
  for (const Diagnostic* d : program->diagnostics.sorted()) {
    const LineCol at = program->sources.lineCol(d->range.begin);
    result.push_back(std::to_string(at.line) + ":" + std::to_string(at.column) + " " +
                     std::string(diagInfo(d->id).code));
  }
  return listed(result);
}

TEST(GskList, Positions) {
  const auto places = [](const std::string& text) { return placesOf(compileList("FUNC 0\n" + text + "FUNC 1\n")); };
  EXPECT_EQ(places("  LD   X0.9\n OUT Y0.0\n"), "2:8 bad-bit-number") << "the operand";
  EXPECT_EQ(places("0001\tLD\tX0.0\n0002\tOUT\tX0.0\n"), "3:10 write-to-input");
  EXPECT_EQ(places("LD X0.0\n  FUNC NOPE\n"), "3:8 unknown-function") << "its name";
  EXPECT_EQ(places("LD X0.0\n 7 FUNC TMR\n  PRM 1\n"), "3:4 missing-output") << "FUNC";
  EXPECT_EQ(places("LD X0.0\nFUNC JMP\n PRM   1\nFUNC JMPE\n"), "4:8 parameter-out-of-range");
  EXPECT_EQ(places("LD X0.0\nLD X0.1\n\tORB\n ANB\nOUT Y0.0\n"), "5:2 unbalanced-stack") << "the command";
  EXPECT_EQ(places("LD X0.0\nOUT Y0.0\n  AND X0.1\n"), "4:3 multi-level-output");
  EXPECT_EQ(places("  LOAD X0.0\n"), "2:3 unknown-command");
  EXPECT_EQ(places("LD X0.0\nOUT Y0.\xD0\x9E ; O\n"), "3:8 bad-character") << "the character itself";
  EXPECT_EQ(places("LD X0.0\nOUT Y0.0 Y0.1\n"), "3:10 bad-operand") << "what is too much";
  EXPECT_EQ(placesOf(compileList("FUNC 0\nLD X0.0\n  OUT Y0.0\n\n")), "3:1 missing-end2") << "the last line";
  EXPECT_EQ(placesOf(compileLadder("dialect gsk\nmodule LEVEL2\nrung\n|--[X0.0]--[X0.8]--{MOVB D0.0 X1}\n")),
            "4:13 bad-bit-number, 4:26 byte-address-expected, 4:31 write-to-input");
}

TEST(GskConfig, WrongValues) {
  const auto codes = [](const char* key, const char* value) {
    return listed(compileList("FUNC 0\nFUNC 1\n", {{{key, value}}})->codes());
  };
  EXPECT_EQ(codes("period_us", "8000"), "");
  EXPECT_EQ(codes("period_us", "10000"), "- constant-out-of-range");
  EXPECT_EQ(codes("tmr.1", "3145680"), "");
  EXPECT_EQ(codes("tmr.21", "3145680"), "- constant-out-of-range");
  EXPECT_EQ(codes("tmr.101", "8"), "- constant-out-of-range");
  EXPECT_EQ(codes("tmr.1", "-8"), "- constant-out-of-range");
  EXPECT_EQ(codes("tmr.1", "100ms"), "- bad-operand");
  EXPECT_EQ(codes("ctr.1", "many"), "- bad-operand");
  EXPECT_EQ(codes("ctr.100", "65535"), "");
  EXPECT_EQ(codes("ctr.1", "65536"), "- constant-out-of-range");
  EXPECT_EQ(codes("param.17", "x"), "") << "the NC model's";
}

TEST(GskConfig, ATimeIsInMilliseconds) {
  const std::string text = compileList("FUNC 0\nFUNC 1\n", {{{"tmr.1", "2s"}}})->text();
  EXPECT_NE(text.find("'2s' is not the value of tmr.1, a whole number of milliseconds"), std::string::npos) << text;
  EXPECT_NE(text.find("2s in milliseconds: 2000"), std::string::npos) << text;
}

TEST(GskList, HintsHowToMend) {
  const auto text = [](const std::string& operand) {
    return compileList("LD " + operand + "\nOUT Y0.0\nFUNC END1\nFUNC END2\n")->text();
  };
  EXPECT_NE(text("X9,0").find("write X9.0"), std::string::npos) << text("X9,0");
  EXPECT_NE(text("X9.O").find("not the letter O"), std::string::npos) << text("X9.O");
}

} // namespace
} // namespace rung::frontend::gsk::test

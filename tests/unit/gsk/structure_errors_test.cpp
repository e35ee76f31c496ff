// Diagnostics of the program's structure: ends, subprograms, regions, labels, calls, numbers.
#include <gtest/gtest.h>

#include "tests/unit/gsk/compile.h"

namespace rung::frontend::gsk::test {
namespace {

std::string codes(const std::string& text) { return listed(compileList(text)->codes()); }
// In Level 2; the text begins in line 2.
std::string level2(const std::string& text) { return codes("FUNC 0\n" + text + "FUNC 1\n"); }

TEST(GskEnds, MissingAndDouble) {
  EXPECT_EQ(codes("FUNC 0\nFUNC 1\n"), "");
  EXPECT_EQ(codes("LD X0.0\nOUT Y0.0\nFUNC 1\n; the end\n"), "3 missing-end1");
  EXPECT_EQ(codes("FUNC 0\nLD X0.0\nOUT Y0.0\n; the end\n\n"), "4 missing-end2");
  EXPECT_EQ(codes("LD X0.0\nOUT Y0.0"), "2 missing-end1, 2 missing-end2");
  EXPECT_EQ(codes(""), "1 missing-end1, 1 missing-end2");
  EXPECT_EQ(codes("FUNC 0\nFUNC 0\nFUNC 1\n"), "2 duplicate-end1");
  EXPECT_EQ(codes("FUNC 0\nFUNC 1\nFUNC 1\n"), "3 duplicate-end2");
  EXPECT_EQ(codes("FUNC 1\nFUNC 0\n"), "2 end-order");
}

TEST(GskEnds, CodeBehindEnd2) {
  EXPECT_EQ(codes("FUNC 0\nFUNC 1\nLD X0.0\nOUT Y0.0\nLD X0.1\nOUT Y0.1\n"), "3 code-after-end2");
  EXPECT_EQ(codes("FUNC 0\nLD X0.0\nFUNC CALL\nPRM P1\nFUNC 1\nLD X0.0\nFUNC SP\nPRM P1\nFUNC SPE\n"),
            "6 condition-ignored");
}

TEST(GskEnds, AWrongOrderIsOneMistake) {
  EXPECT_EQ(codes("LD X0.0\nOUT Y0.0\nFUNC 1\nLD X0.0\nOUT Y0.0\nFUNC 0\n"), "6 end-order");
  EXPECT_EQ(codes("FUNC 1\nFUNC 0\nLD X0.0\nOUT Y0.0\n"), "2 end-order, 3 code-after-end2");
  EXPECT_EQ(codes("FUNC 0\nLD X0.0\nFUNC JMPB\nPRM L1\nFUNC 1\nFUNC LBL\nPRM L1\n"), "6 code-after-end2")
      << "the label is misplaced, not missing";
  EXPECT_EQ(codes("FUNC 0\nLD X0.0\nFUNC COM\nFUNC 1\nFUNC COME\n"), "5 code-after-end2");
}

TEST(GskEnds, SubprogramsInFrontOfThem) {
  const std::string sub = "FUNC SP\nPRM P1\nFUNC SPE\n";
  const std::string other = "FUNC SP\nPRM P2\nFUNC CALLU\nPRM P1\nFUNC SPE\n";
  EXPECT_EQ(codes("FUNC 0\n" + sub + "FUNC CALLU\nPRM P2\n" + other + "FUNC 1\n"),
            "2 subprogram-misplaced, 7 subprogram-misplaced");
  EXPECT_EQ(codes("FUNC 0\n" + sub + "FUNC CALLU\nPRM P2\n" + other), "2 subprogram-misplaced, 11 missing-end2")
      << "each one stands where it does because of the one mistake";
  EXPECT_EQ(codes("FUNC SP\nPRM P1\nFUNC 0\nFUNC CALLU\nPRM P1\nFUNC 1\n"), "1 missing-spe, 1 subprogram-misplaced");
}

TEST(GskSubprograms, Text) {
  const std::string call = "FUNC 0\nFUNC CALLU\nPRM P1\nFUNC 1\n"; // four lines
  EXPECT_EQ(codes(call + "FUNC SP\nPRM P1\nFUNC SPE\n"), "");
  EXPECT_EQ(codes(call + "FUNC SP\nPRM P1\n"), "5 missing-spe");
  EXPECT_EQ(codes(call + "FUNC SP\nPRM P1\nFUNC SPE\nFUNC SPE\n"), "8 stray-spe");
  const std::string sub1 = "FUNC SP\nPRM P1\n";
  const std::string sub2 = "FUNC SP\nPRM P2\n";
  const std::string spe = "FUNC SPE\n";
  EXPECT_EQ(codes(call + sub1 + sub2 + spe + spe), "7 nested-subprogram, 8 subprogram-unused");
  EXPECT_EQ(codes(call + sub1 + sub2 + spe), "7 nested-subprogram, 8 subprogram-unused");
  EXPECT_EQ(codes(call + sub1 + sub2 + spe + spe + spe), "7 nested-subprogram, 8 subprogram-unused, 11 stray-spe");
  EXPECT_EQ(codes(call + sub1 + sub2 + spe + "FUNC SP\nPRM P3\nFUNC CALLU\nPRM P2\n" + spe),
            "7 nested-subprogram, 11 subprogram-unused")
      << "one SPE is missing, that is all";
  EXPECT_EQ(codes(call + sub1 + sub2 + spe + "LD X0.0\nOUT Y0.0\n" + "FUNC SP\nPRM P3\n" + spe + spe),
            "7 nested-subprogram, 8 subprogram-unused, 12 nested-subprogram, 13 subprogram-unused")
      << "two inside the first";
  EXPECT_EQ(codes(call + "FUNC SP\nPRM P1\nFUNC SPE\nFUNC SP\nPRM P1\nFUNC SPE\n"), "9 duplicate-subprogram");
  EXPECT_EQ(codes(call), "3 undefined-subprogram");
  EXPECT_EQ(codes("FUNC 0\nFUNC 1\nFUNC SP\nPRM P1\nFUNC SPE\n"), "4 subprogram-unused");
  EXPECT_EQ(codes("FUNC 0\nFUNC CALLU\nPRM P1\nFUNC SP\nPRM P1\nFUNC SPE\nLD X0.0\nOUT Y0.0\nFUNC 1\n"),
            "4 subprogram-misplaced");
  EXPECT_EQ(codes(call + "FUNC SP\nPRM P513\nFUNC SPE\n"), "6 parameter-out-of-range");
  EXPECT_EQ(codes("FUNC 0\nFUNC CALLU\nPRM P0\nFUNC 1\nFUNC SP\nPRM P0\nFUNC SPE\n"), "3 label-zero, 6 label-zero");
}

std::string chain(int length, const std::string& last) {
  std::string text = "FUNC 0\nFUNC CALLU\nPRM P1\nFUNC 1\n"; // Pn begins in line 5 n
  for (int i = 1; i <= length; ++i) {
    text += "FUNC SP\nPRM P" + std::to_string(i) + "\n";
    text += i < length ? "FUNC CALLU\nPRM P" + std::to_string(i + 1) + "\n" : last;
    text += "FUNC SPE\n";
  }
  return text;
}

TEST(GskSubprograms, Calls) {
  EXPECT_EQ(codes(chain(8, "")), "");
  EXPECT_EQ(codes(chain(9, "")), "42 nesting-too-deep") << "the call in P8";
  EXPECT_EQ(codes(chain(11, "")), "42 nesting-too-deep") << "once";
  EXPECT_EQ(codes(chain(3, "FUNC CALLU\nPRM P1\n")), "17 recursive-call");
  EXPECT_EQ(codes(chain(1, "FUNC CALLU\nPRM P1\n")), "7 recursive-call");
}

TEST(GskRegions, Jmp) {
  const std::string jmp = "LD X0.0\nFUNC JMP\nPRM 0\n"; // three lines
  EXPECT_EQ(level2(jmp + "FUNC JMPE\n"), "");
  EXPECT_EQ(level2(jmp), "3 missing-jmpe");
  EXPECT_EQ(level2("FUNC JMPE\n"), "2 stray-jmpe");
  EXPECT_EQ(level2(jmp + jmp + "FUNC JMPE\nFUNC JMPE\n"), "6 nested-jmp");
  EXPECT_EQ(level2(jmp + jmp + "FUNC JMPE\n"), "6 nested-jmp");
  EXPECT_EQ(codes(jmp + "FUNC 0\nFUNC JMPE\nFUNC 1\n"), "2 missing-jmpe, 5 stray-jmpe") << "not over END1";
}

TEST(GskRegions, Com) {
  const std::string com = "LD X0.0\nFUNC COM\n"; // two lines
  const std::string jmp = "LD X0.0\nFUNC JMP\nPRM 0\n";
  EXPECT_EQ(level2(com + "FUNC COME\n"), "");
  EXPECT_EQ(level2(com), "3 missing-come");
  EXPECT_EQ(level2("FUNC COME\n"), "2 stray-come");
  EXPECT_EQ(level2(com + com + "FUNC COME\nFUNC COME\n"), "5 nested-com");
  EXPECT_EQ(level2(com + jmp + "FUNC JMPE\nFUNC COME\n"), "");
  EXPECT_EQ(level2(jmp + com + "FUNC COME\nFUNC JMPE\n"), "");
  EXPECT_EQ(level2(jmp + com + "FUNC JMPE\nFUNC COME\n"), "3 jump-out-of-com") << "JMP reaches in";
  EXPECT_EQ(level2(com + jmp + "FUNC COME\nFUNC JMPE\n"), "7 jump-out-of-com") << "COME closes first";
}

TEST(GskRegions, AForgottenEndIsOneMistake) {
  const std::string com = "LD X0.0\nFUNC COM\n"; // two lines
  const std::string come = "FUNC COME\n";
  EXPECT_EQ(level2(com + com + come), "5 nested-com");
  EXPECT_EQ(level2(com + com + come + com + come), "5 nested-com") << "the first has no end";
  EXPECT_EQ(level2(com + com + come + com + come + come), "5 nested-com, 8 nested-com") << "two in one";
  EXPECT_EQ(level2(com + com + come + come + come), "5 nested-com, 8 stray-come");
  EXPECT_EQ(level2(com + com + come + come + com), "5 nested-com, 9 missing-come");
}

TEST(GskLabels, Jmpb) {
  const std::string jump = "LD X0.0\nFUNC JMPB\nPRM L1\n"; // three lines
  const std::string label = "FUNC LBL\nPRM L1\n";
  EXPECT_EQ(level2(jump + label), "");
  EXPECT_EQ(level2(label + jump), "");
  EXPECT_EQ(level2(jump), "4 undefined-label");
  EXPECT_EQ(level2(label), "3 label-unused");
  EXPECT_EQ(level2(jump + label + label), "8 duplicate-label");
  EXPECT_EQ(level2(jump + "LD X0.0\n" + label), "5 condition-ignored");
  EXPECT_EQ(level2("LD X0.0\nFUNC JMPB\nPRM L10000\n"), "4 parameter-out-of-range");
  EXPECT_EQ(level2("LD X0.0\nFUNC JMPB\nPRM 1\n"), "4 bad-operand");
  EXPECT_EQ(codes(jump + "FUNC 0\n" + label + "FUNC 1\n"), "3 jump-across-end");
  EXPECT_EQ(level2(jump + "LD X0.1\nFUNC COM\n" + label + "FUNC COME\n"), "4 jump-out-of-com");
  EXPECT_EQ(level2("LD X0.1\nFUNC COM\n" + jump + "FUNC COME\n" + label), "6 jump-out-of-com");
  EXPECT_EQ(level2("LD X0.1\nFUNC COM\n" + jump + label + "FUNC COME\n"), "");
}

TEST(GskLabels, Jmpc) {
  const std::string jump = "LD X0.0\nFUNC JMPC\nPRM L1\n";
  const std::string sub = "FUNC SP\nPRM P1\n" + jump + "FUNC SPE\n"; // JMPC's FUNC in its line 4, PRM in 5
  EXPECT_EQ(codes("FUNC 0\nFUNC CALLU\nPRM P1\nFUNC LBL\nPRM L1\nFUNC 1\n" + sub), "");
  EXPECT_EQ(level2(jump + "FUNC LBL\nPRM L1\n"), "3 jmpc-outside-subprogram");
  EXPECT_EQ(codes("FUNC CALLU\nPRM P1\nFUNC 0\nFUNC LBL\nPRM L1\nFUNC 1\n" + sub), "11 jump-across-end")
      << "Level 1 calls it";
  EXPECT_EQ(codes("FUNC LBL\nPRM L1\nFUNC 0\nFUNC CALLU\nPRM P1\nFUNC 1\n" + sub), "11 jump-across-end")
      << "a label of Level 1";
}

TEST(GskNumbers, TwiceIsAWarning) {
  const std::string tmr = "LD X0.0\nFUNC TMR\nPRM 5\nOUT R9.0\n"; // four lines
  const std::string tmrb = "LD X0.0\nFUNC TMRB\nPRM 5\nPRM 80\nOUT R9.0\n";
  EXPECT_EQ(level2(tmr + tmrb), "");
  EXPECT_EQ(level2(tmr + tmr), "8 duplicate-timer");
  EXPECT_EQ(level2("LD X0.0\nFUNC DIFU\nPRM 5\nOUT R0.0\nLD X0.0\nFUNC DIFD\nPRM 5\nOUT R0.1\n"),
            "8 duplicate-edge-number");
  const std::string ctr = "LD R0.0\nLD R0.1\nLD R0.2\nLD X0.0\nFUNC CTR\nPRM 7\nOUT R9.0\n"; // seven lines
  EXPECT_EQ(level2(ctr + ctr), "14 duplicate-counter");
  EXPECT_NE(compileList("FUNC 0\n" + ctr + ctr + "FUNC 1\n")->module, nullptr);
  EXPECT_EQ(compileList("FUNC 0\n" + ctr + ctr + "FUNC 1\n", {.strict = true})->module, nullptr);
}

TEST(GskCoils, OnlyOfAProgramWithoutErrors) {
  const std::string twice = "LD X0.0\nOUT Y0.0\nLD X0.1\nOUT Y0.0\n"; // four lines, from line 2 on
  EXPECT_EQ(level2(twice), "5 double-coil");
  EXPECT_EQ(level2(twice + "LD X0.0\nFUNC CALL\nPRM P9\n"), "8 undefined-subprogram");
  EXPECT_EQ(level2(twice + "LD R2000.0\nOUT Y1.0\n"), "6 address-out-of-range")
      << "the contact may read what the coils write";
}

TEST(GskCoils, StrictMakesThemErrors) {
  const std::string twice = "FUNC 0\nLD X0.0\nOUT Y0.0\nLD X0.1\nOUT Y0.0\nFUNC 1\n";
  const std::string latched = "FUNC 0\nLD X0.0\nSET Y0.0\nLD X0.1\nOUT Y0.0\nFUNC 1\n";
  for (const std::string& text : {twice, latched}) {
    EXPECT_NE(compileList(text)->module, nullptr);
    EXPECT_EQ(compileList(text, {.strict = true})->module, nullptr);
  }
}

TEST(GskCoils, BothPlacesAreNamed) {
  const std::string text = compileList("LD X0.0\nOUT Y0.0\nFUNC 0\nLD X0.1\nOUT Y0.0\nFUNC 1\n")->text();
  EXPECT_NE(text.find("test.pmc:5:1: warning: Y0.0 is driven by two coils"), std::string::npos) << text;
  EXPECT_NE(text.find("test.pmc:2:1: note: the other coil is here, in LEVEL1"), std::string::npos) << text;
}

// A jump that does not always pass the second coil, or leads back, and a subprogram that JMPC leaves.
TEST(GskCoils, JumpsChoose) {
  const std::string one = "LD X0.0\nOUT Y0.0\n";
  const std::string two = "LD X0.1\nOUT Y0.0\n";
  const std::string jump = "LD X0.7\nFUNC JMPB\nPRM L1\n";
  const std::string label = "FUNC LBL\nPRM L1\n";
  EXPECT_EQ(level2(one + jump + two + label), "");
  EXPECT_EQ(level2(jump + one + two + label), "8 double-coil");
  EXPECT_EQ(level2(jump + one + label + two), "10 double-coil");
  EXPECT_EQ(level2(one + jump + label + two), "10 double-coil");
  EXPECT_EQ(level2(label + one + jump + two), "") << "it may go round for ever";
  const std::string sub = "FUNC SP\nPRM P1\nLD X0.7\nFUNC JMPC\nPRM L1\nFUNC SPE\n";
  EXPECT_EQ(codes("FUNC 0\n" + one + "FUNC CALLU\nPRM P1\n" + two + label + "FUNC 1\n" + sub), "");
}

TEST(GskCoils, SubprogramsThatCallEachOther) {
  const auto sub = [](int number, const std::string& body) {
    return "FUNC SP\nPRM P" + std::to_string(number) + "\n" + body + "FUNC SPE\n";
  };
  const std::string coil = "LD X0.0\nOUT Y0.0\n";
  const std::string one = "FUNC CALLU\nPRM P1\n";
  const std::string two = "FUNC CALLU\nPRM P2\n";
  EXPECT_EQ(codes("FUNC 0\n" + one + two + "FUNC 1\n" + sub(1, coil) + sub(2, one)), "") << "one coil, run twice";
  EXPECT_EQ(codes("FUNC 0\n" + two + coil + "FUNC 1\n" + sub(1, coil) + sub(2, one)), "5 double-coil");
  EXPECT_EQ(codes(coil + "FUNC 0\n" + two + "FUNC 1\n" + sub(1, coil) + sub(2, one)), "10 double-coil");
  EXPECT_EQ(
      codes("FUNC 0\nLD X0.1\nFUNC CALL\nPRM P1\nLD X0.2\nFUNC CALL\nPRM P2\nFUNC 1\n" + sub(1, coil) + sub(2, coil)),
      "");
}

TEST(GskRecovery, ALostFunctionCausesNoFurtherErrors) {
  EXPECT_EQ(level2("LD X0.0\nFUNC JMQ\nPRM 0\nFUNC JMPE\n"), "3 unknown-function");
  EXPECT_EQ(level2("FUMC 33\nFUNC COME\nLD X0.0\nFUNC JMPB\nPRM L1\n"), "2 unknown-command");
}

TEST(GskRecovery, AWrongOperandDoesNotHideTheRest) {
  EXPECT_EQ(level2("LD X0.0 X0.1\nOUT Y0.0\nFUNC COME\n"), "2 bad-operand, 4 stray-come");
  EXPECT_EQ(level2("LD \xD0\xA5"
                   "0.0\nLD X0.1\nOUT Y0.0\nFUNC JMPE\n"),
            "2 bad-character, 4 unbalanced-stack, 5 stray-jmpe")
      << "the values are counted all the same";
  EXPECT_EQ(level2("LD X0.0\nFUNC MOVB\nPRM\nPRM D1\nLD X0.0\nFUNC MOVB\nPRM X128\nPRM D0 D1\n"),
            "4 bad-operand, 8 address-out-of-range, 9 bad-operand");
  EXPECT_EQ(level2("LD X0.0\nFUNC NUMEB\nPRM 1 2\nPRM 500\nPRM D0\n"), "4 bad-operand")
      << "without its format nothing is known about the constant";
  EXPECT_EQ(listed(compileList("FUNC 0\nLD X0.0\nOUT\n")->codes()), "3 bad-operand, 3 missing-end2");
}

// A broken rung may have lost what its boxes begin or end; one without such boxes hides nothing.
TEST(GskRecovery, ABrokenRungHidesWhatItsBoxesMayBe) {
  const std::string text = "dialect gsk\nmodule LEVEL2\nrung\n|--[X0.0]--{JMPB L5}\nrung\n";
  EXPECT_EQ(listed(compileLadder(text + "|--[X0.1--(Y0.0)\n")->codes()), "4 undefined-label, 6 unclosed-element");
  EXPECT_EQ(listed(compileLadder(text + "|--[X0.1]--{MOVB R0 R1\n")->codes()), "4 undefined-label, 6 unclosed-element");
  EXPECT_EQ(listed(compileLadder(text + "|--[X0.1--{LBL L5}\n")->codes()), "6 unclosed-element");
}

} // namespace
} // namespace rung::frontend::gsk::test

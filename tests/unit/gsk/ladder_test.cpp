// Ladder text: what list a drawing becomes, that both forms give one program, and the errors of drawings.
#include <gtest/gtest.h>

#include "frontend/dialects/gsk/language.h"
#include "frontend/network/read/ladder_reader.h"
#include "tests/unit/gsk/compile.h"

namespace rung::frontend::gsk::test {
namespace {

// The command list of a rung, on one line; the errors where it has any.
std::string listOf(const std::string& drawing) {
  SourceManager sources;
  Diagnostics diagnostics;
  const FileId file = sources.addBuffer("test.lad", "dialect gsk\nmodule LEVEL2\nrung\n" + drawing);
  frontend::network::Context context{.language = kLanguage, .sources = sources, .diagnostics = diagnostics};
  frontend::network::Program program(kLanguage);
  frontend::network::UnitAssembler units(context, program);
  const frontend::ladder::LadderFile parsed = frontend::network::parseLadderFile(context, file);
  frontend::network::readLadder(context, parsed, units);
  if (diagnostics.hasErrors()) return renderText(diagnostics, sources);
  std::string text;
  for (const frontend::network::Network& network : program.units[kLanguage.mainLevel()].networks)
    text += commandText(kLanguage, network);
  for (char& c : text)
    if (c == '\n') c = ';';
  return text;
}

TEST(GskLadder, Contacts) {
  EXPECT_EQ(listOf("|--[X2.1]--[/X002.2]--(Y0.0)\n"), "LD X2.1;ANI X2.2;OUT Y0.0;");
  EXPECT_EQ(listOf("|--[/X2.1]--(/Y0.0)\n"), "LDI X2.1;OUTI Y0.0;");
  EXPECT_EQ(listOf("|--[X0.0]--+--(S Y0.0)\n           +--(R Y0.1)\n"), "LD X0.0;SET Y0.0;RST Y0.1;");
  EXPECT_EQ(listOf("|--[X0.0]--(R10.0)\n"), "LD X0.0;OUT R10.0;") << "no blank: a coil on R10.0";
}

TEST(GskLadder, ParallelOfSingleContactsIsOr) {
  EXPECT_EQ(listOf("|--[X0.0]--+--[/X0.1]--(Y0.0)\n"
                   "|--[/Y0.0]-+\n"),
            "LD X0.0;ORI Y0.0;ANI X0.1;OUT Y0.0;");
}

TEST(GskLadder, ParallelOfSeriesIsOrb) {
  EXPECT_EQ(listOf("|--[X0.0]--[X0.1]--+--(Y0.0)\n"
                   "|--[X0.2]--[X0.3]--+\n"
                   "|--[X0.4]----------+\n"),
            "LD X0.0;AND X0.1;LD X0.2;AND X0.3;ORB;OR X0.4;OUT Y0.0;");
}

TEST(GskLadder, ParallelBlockInSeriesIsAnb) {
  EXPECT_EQ(listOf("|--[X0.0]--+--[X0.1]--+--[X0.3]--(Y0.0)\n"
                   "           +--[X0.2]--+\n"),
            "LD X0.0;LD X0.1;OR X0.2;ANB;AND X0.3;OUT Y0.0;");
}

TEST(GskLadder, NestedBlocks) {
  EXPECT_EQ(listOf("|--[X0.0]--+--[X0.1]--+--[X0.2]--+--+--(Y0.0)\n"
                   "           |          +--[X0.3]--+  |\n"
                   "           +--[X0.4]----------------+\n"
                   "|--[X0.5]---------------------------+\n"),
            "LD X0.0;LD X0.1;LD X0.2;OR X0.3;ANB;OR X0.4;ANB;OR X0.5;OUT Y0.0;");
}

TEST(GskLadder, Boxes) {
  EXPECT_EQ(listOf("|--[X0.0]--{TMR 1}--(Y0.0)\n"), "LD X0.0;FUNC 2;PRM 1;OUT Y0.0;");
  EXPECT_EQ(listOf("|--[R0.1]--{ADDB 0002 D10 1000 D20}--(R10.0)\n"
                   "|--[R0.0]--{ACT                  }\n"),
            "LD R0.1;LD R0.0;FUNC 21;PRM 0002;PRM D10;PRM 1000;PRM D20;OUT R10.0;");
  EXPECT_EQ(listOf("|--[R0.0]--{CTR 1 }--(Y0.0)\n"
                   "|--[R0.1]--{UPDOWN}\n"
                   "|--[R0.2]--{RST   }\n"
                   "|--[X0.3]--{ACT   }\n"),
            "LD R0.0;LD R0.1;LD R0.2;LD X0.3;FUNC 6;PRM 1;OUT Y0.0;");
  EXPECT_EQ(listOf("|--[R0.0]--{CODB 1 2 D10 D11 TABLE 10 -1}--(R10.0)\n"
                   "|--[R0.1]--{ACT                         }\n"),
            "LD R0.0;LD R0.1;FUNC 9;PRM 1;PRM 2;PRM D10;PRM D11;TABLE 10;TABLE -1;OUT R10.0;");
  EXPECT_EQ(listOf("|--{JMPE}\n"), "FUNC 36;");
  EXPECT_EQ(listOf("|--[X0.0]--[X0.1]--{JMP 0}\n"), "LD X0.0;AND X0.1;FUNC 35;PRM 0;");
  EXPECT_EQ(listOf("|--{LBL L001}\n"), "FUNC 41;PRM L1;");
}

TEST(GskLadder, OnePartOfTheDrawingForTwoPins) {
  EXPECT_EQ(listOf("|--[R0.0]--+--[R0.1]--{ADDB 1 D10 1 D10}--(R10.0)\n"
                   "           +----------{ACT             }\n"),
            "LD R0.0;AND R0.1;LD R0.0;FUNC 21;PRM 0001;PRM D10;PRM 1;PRM D10;OUT R10.0;");
}

// ---- one program in two forms --------------------------------------------------------------------------------------

TEST(GskLadder, BothFormsGiveOneProgram) {
  const auto ladder = compileLadder(R"(dialect gsk
symbol START X10.0
module LEVEL1
rung
|--[X8.4]--(Y8.0)
module LEVEL2
rung "start"
|--[START]--+--(Y10.0)
|--[Y10.0]--+
rung
|--[X10.1]--{CALL P1}
module SUB P1
rung
|--[X10.2]--(S Y10.1)
)");
  const auto list = compileList(R"(symbol START X10.0
LD X8.4
OUT Y8.0
FUNC END1
LD START
OR Y10.0
OUT Y10.0
LD X10.1
FUNC CALL
PRM P1
FUNC END2
FUNC SP
PRM P1
LD X10.2
SET Y10.1
FUNC SPE
)");
  ASSERT_NE(ladder->module, nullptr) << ladder->text();
  ASSERT_NE(list->module, nullptr) << list->text();
  ASSERT_EQ(ladder->module->routines.size(), list->module->routines.size());
  for (size_t r = 0; r < list->module->routines.size(); ++r) {
    const auto& a = ladder->module->routines[r];
    const auto& b = list->module->routines[r];
    EXPECT_EQ(a.name, b.name);
    ASSERT_EQ(a.rungs.size(), b.rungs.size()) << a.name;
    for (size_t i = 0; i < a.rungs.size(); ++i) {
      EXPECT_EQ(a.rungs[i].key, b.rungs[i].key) << a.name << " " << i;
      EXPECT_EQ(a.rungs[i].ops.size(), b.rungs[i].ops.size()) << a.name << " " << i;
    }
  }
  EXPECT_EQ(ladder->module->routines[1].rungs[0].title, "start");
}

// ---- errors --------------------------------------------------------------------------------------------------------

// Of a rung of Level 2; the drawing begins in line 4.
std::string errorsOf(const std::string& drawing) {
  return listed(compileLadder("dialect gsk\nmodule LEVEL2\nrung\n" + drawing)->codes());
}

TEST(GskLadderErrors, Shapes) {
  EXPECT_EQ(errorsOf("|--[@X0.0]--(Y0.0)\n"), "4 unsupported-element");
  EXPECT_EQ(errorsOf("|--[X0.0]--(Y0.0)--[X0.1]--(Y0.1)\n"), "4 multi-level-output");
  EXPECT_EQ(errorsOf("|--[X0.0]--{TMR 1}--[X0.1]--(Y0.1)\n"), "4 multi-level-output");
  EXPECT_EQ(errorsOf("|--[X0.0]--+--(Y0.0)\n           +--[X0.1]--(Y0.1)\n"), "5 multi-level-output");
  EXPECT_EQ(errorsOf("|--[X0.0]--{MOVB D0 D1}--(Y0.1)\n"), "4 element-after-closing");
  EXPECT_EQ(errorsOf("|--[X0.0]--{TMR 1}\n"), "4 missing-output");
  EXPECT_EQ(errorsOf("|--(Y0.0)\n"), "4 missing-condition");
  EXPECT_EQ(errorsOf("|--{MOVB D0 D1}\n"), "4 missing-condition");
  EXPECT_EQ(errorsOf("|--[X0.0]--{ADDB 1 D10 1 D10}--(R10.0)\n|----------{ACT             }\n"), "5 missing-condition");
  EXPECT_EQ(errorsOf("|--[X0.0]--[X0.1]\n"), "4 missing-closing-element");
  EXPECT_EQ(errorsOf("|--[X0.0]--{END1}\n"), "4 unsupported-element");
  EXPECT_EQ(errorsOf("|--[X0.0]--{NOPE 1}\n"), "4 unknown-function");
  EXPECT_EQ(errorsOf("|--[X0.0]--{COME}\n"), "4 first-column-required");
  EXPECT_EQ(errorsOf("|--[X0.0]--{LBL L1}\nrung\n|--[X0.0]--{JMPB L1}\n"), "4 condition-ignored");
}

TEST(GskLadderErrors, Bridge) {
  EXPECT_EQ(errorsOf("|--[X0.0]--+--[X0.1]------------+--(Y0.0)\n"
                     "           +--[X0.2]--+         |\n"
                     "|--[X0.3]-------------+--[X0.4]-+\n"),
            "4 not-series-parallel");
}

TEST(GskLadderErrors, Pins) {
  EXPECT_EQ(errorsOf("|--[R0.0]--{ADDB 1 D10 1 D10}--(R10.0)\n"), "4 missing-pin");
  EXPECT_EQ(errorsOf("|--[R0.0]--{ADDB 1 D10 1 D10}--(R10.0)\n|--[R0.1]--{RST             }\n"), "5 unknown-pin");
}

TEST(GskLadderErrors, Operands) {
  EXPECT_EQ(errorsOf("|--[X128.0]--[X0.9]--(X0.0)\n"), "4 address-out-of-range, 4 bad-bit-number, 4 write-to-input");
  EXPECT_EQ(errorsOf("|--[X0.0]--{TMR 101}--(Y0.0)\n"), "4 parameter-out-of-range");
  EXPECT_EQ(errorsOf("|--[X0.0]--{TMR}--(Y0.0)\n"), "4 wrong-parameter-count");
}

TEST(GskLadderErrors, Modules) {
  const auto codes = [](const std::string& text) { return listed(compileLadder("dialect gsk\n" + text)->codes()); };
  const std::string rung = "rung\n|--[X0.0]--(Y0.0)\n";
  EXPECT_EQ(codes("module LEVEL1\nrung\n|--[X0.0]--(Y0.1)\nmodule LEVEL2\n" + rung), "");
  EXPECT_EQ(codes("module LEVEL2\n" + rung), "") << "Level 1 may be missing";
  EXPECT_EQ(codes("module LEVEL2\n" + rung + "module LEVEL2\n" + rung), "5 duplicate-module");
  EXPECT_EQ(codes("module MAIN\n" + rung), "2 malformed-statement");
  EXPECT_EQ(codes("module SUB P513\n" + rung), "2 parameter-out-of-range");
  EXPECT_EQ(codes("module SUB 5\n" + rung), "2 bad-operand");
  EXPECT_EQ(codes("module LEVEL2\n" + rung + "module SUB P5\n" + rung), "5 subprogram-unused");
  EXPECT_EQ(codes("module LEVEL2\nrung\n|--{CALLU P5}\nmodule SUB P5\n" + rung + "module SUB P5\n" + rung),
            "8 duplicate-subprogram");
  EXPECT_EQ(codes("const LIMIT 50\nmodule LEVEL2\nrung\n|--[X0.0]--{NUMEB 1 LIMIT D0}\n"), "");
  EXPECT_EQ(codes("message 1 \"x\"\nmodule LEVEL2\n" + rung), "2 unsupported-element");
  EXPECT_EQ(listed(compileLadder("dialect nct\nmodule LEVEL2\n" + rung)->codes()), "1 dialect-conflict");
}

TEST(GskLadderErrors, ProgramSize) {
  const auto codes = [](int rungs, const std::string& rest) {
    std::string text = "dialect gsk\nmodule LEVEL2\n"; // two steps: END1, END2
    for (int i = 0; i < rungs; ++i) text += "rung\n|--[X0.0]--(R9.0)\n";
    return listed(compileLadder(text + rest)->codes());
  };
  EXPECT_EQ(codes(5999, ""), "") << "12000 steps";
  EXPECT_EQ(codes(5999, "rung\n|--{LBL L1}\n"), "12002 program-too-large, 12002 label-unused");
  const std::string sub = "rung\n|--{CALLU P1}\nmodule SUB P1\n"; // five steps
  EXPECT_EQ(codes(5996, sub), "") << "11999 steps";
  EXPECT_EQ(codes(5997, sub), "11999 program-too-large") << "12001 steps; SPE is one too many";
  const std::string condition = "; condition: LD X0.0\n";
  EXPECT_EQ(codes(5996, sub + condition), "11998 condition-ignored") << "12000 steps";
  EXPECT_EQ(codes(5996, sub + condition + "; condition: AND X0.0\n"),
            "11997 program-too-large, 11998 condition-ignored")
      << "12001 steps; SPE, counted last, is one too many";
}

// Comments directly after `module SUB Pn` are the condition before SP where a list would take them for one (P13).
TEST(GskLadderErrors, ConditionBeforeSp) {
  const auto compiled = [](const std::string& comments) {
    return compileLadder("dialect gsk\nmodule LEVEL2\nrung\n|--{CALLU P1}\nmodule SUB P1\n" + comments +
                         "rung\n|--[X0.0]--(Y0.0)\n");
  };
  const auto codes = [&](const std::string& comments) { return listed(compiled(comments)->codes()); };
  const std::string load = "; condition: LD X0.0\n";
  const std::string ignored = "6 condition-ignored";
  EXPECT_EQ(codes(load), ignored);
  EXPECT_EQ(codes(load + "; condition: ANI MF\n"), ignored) << "a signal";
  EXPECT_EQ(codes(load + load + "; condition: ORB\n; a title\n"), ignored);
  EXPECT_EQ(codes("\n" + load), "") << "not directly";
  EXPECT_EQ(codes("; condition: OR X0.0\n"), "") << "nothing to join";
  EXPECT_EQ(codes(load + load), "") << "two values";
  EXPECT_EQ(codes("; condition: LD X0.9\n"), "") << "not a bit";
  std::string deep = load;
  for (int i = 0; i < 8; ++i) deep += load;
  std::string joined;
  for (int i = 0; i < 8; ++i) joined += "; condition: ORB\n";
  EXPECT_EQ(codes(deep + joined), ignored) << "nine values";
  EXPECT_EQ(codes(load + deep + joined + "; condition: ORB\n"), "") << "ten values";
  const auto titleOf = [&](const std::string& comments) {
    return compiled(comments)->module->routines.back().rungs.front().title;
  };
  EXPECT_EQ(titleOf(load), "");
  EXPECT_EQ(titleOf(load + "; a title\n"), "a title");
  EXPECT_EQ(titleOf(load + load), "condition: LD X0.0") << "a comment like any other";
}

TEST(GskLadderErrors, LostRungsCauseNoFurtherErrors) {
  EXPECT_EQ(listed(compileLadder("dialect gsk\nmodule LEVEL2\nrung\n|--[X0.0]--{JMP 0\nrung\n|--{JMPE}\n")->codes()),
            "4 unclosed-element");
}

TEST(GskLadderErrors, OperandsOfALostRungAreChecked) {
  EXPECT_EQ(errorsOf("|--[X0.9]--{MOVB D0 D5000\n"), "4 bad-bit-number, 4 unclosed-element");
  EXPECT_EQ(errorsOf("|--[X0.9]--+--(Y0.0)\n           +--[X0.1]--{MOVB D0 D5000}\n"),
            "4 bad-bit-number, 4 multi-level-output, 5 address-out-of-range");
  EXPECT_EQ(errorsOf("|--[X0.0]--{TMR 101}---\n"), "4 parameter-out-of-range, 4 missing-closing-element");
  EXPECT_EQ(errorsOf("|--[X0.0]--{NOPE 1}---\n"), "4 unknown-function, 4 missing-closing-element");
}

} // namespace
} // namespace rung::frontend::gsk::test

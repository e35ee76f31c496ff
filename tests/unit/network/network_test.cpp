// That frontend/network knows no dialect: a language that is made up here is read, checked, laid out and converted.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include "frontend/network/check/analyse.h"
#include "frontend/network/convert/convert.h"
#include "frontend/network/format.h"
#include "frontend/network/read/reading.h"
#include "ir/support/diag_render.h"
#include "tests/support/cases.h"
#include "tests/support/words.h"
#include "tests/unit/network/little_language.h"

namespace rung::frontend::network::test {
namespace {

using rung::test::joined;
using rung::test::lacking;
using testing::HasSubstr;

// A program that was read and checked.
struct Checked {
  SourceManager sources;
  Diagnostics diagnostics;
  Context context;
  const Language& language;
  Program program;
  std::vector<FileId> files;

  Checked(const std::string& name, const std::string& text, const Language& language = kLittle)
      : context{.language = language, .sources = sources, .diagnostics = diagnostics}, language(language),
        program(language) {
    files.push_back(sources.addBuffer(name, text));
    Reading reading(context, program);
    reading.add(files[0]);
    const bool understood = reading.read();
    analyse(context, program, !understood);
  }

  // "LINE code: message" of every report.
  std::vector<std::string> reports() const {
    std::vector<std::string> result;
    for (const Diagnostic* d : diagnostics.sorted())
      result.push_back(std::to_string(sources.lineCol(d->range.begin).line) + " " + std::string(diagInfo(d->id).code) +
                       ": " + messageOf(*d));
    return result;
  }

  // Every unit with its networks, commands after commands.
  std::vector<std::string> units() const {
    std::vector<std::string> result;
    for (const Unit& unit : program.units) {
      std::string text = nameOf(language, unit) + ":";
      for (const Network& network : unit.networks) text += " | " + commandText(language, network);
      for (char& c : text)
        if (c == '\n') c = ';';
      result.push_back(text);
    }
    return result;
  }
};

Checked list(const std::string& text) { return {"test.lst", text}; }
Checked ladder(const std::string& text) { return {"test.lad", "dialect little\n" + text}; }

// The reports of networks in SLOW, whose first line is number 2.
std::vector<std::string> reportsOf(const std::string& networks) {
  return list("DO FASTEND\n" + networks + "DO SLOWEND\n").reports();
}

const std::string kProgram = R"(dialect little
symbol LAMP Q0.1 ; green

; the door
GET  *DOOR
WITHN i00.1
PUT  LAMP
DO   10

GET  I0.2
GETN I0.3 ; why not
GET  I0.4
WITH I0.5
MERGE
DO   CLOCK
ARG  2
PUT  M0.0
HOLD M0.1

GET  M0.0
DO   PICK
ARG  M2
ARG  2
ROW  7
ROW  8
GET  M0.1
DO   VISIT
ARG  U3
DO   11

DO   PART
ARG  U3
GET  M0.2
DO   COPY
ARG  I2
ARG  Q1
DO   PARTEND
)";

const std::string kDrawn = R"(dialect little
symbol LAMP Q0.1  ; green

module FAST

rung "the door"
|--[*DOOR]--[/i00.1]--(LAMP)

module SLOW

rung
; [/I0.3] why not
|--[I0.2]-------------{CLOCK 2}--+--(M0.0)
|--[/I0.3]---------+--{GO     }  +--(S M0.1)
|--[I0.4]--[I0.5]--+
)";

TEST(Network, AListIsReadIntoUnits) {
  const Checked program = list(kProgram);
  EXPECT_EQ(joined(program.reports()), "");
  EXPECT_EQ(joined(program.units()),
            "FAST: | GET I1.7;WITHN I0.1;PUT Q0.1; | DO 10;\n"
            "SLOW: | GET I0.2;GETN I0.3;GET I0.4;WITH I0.5;MERGE;DO 20;ARG 2;PUT M0.0;HOLD M0.1;"
            " | GET M0.0;DO 22;ARG M2;ARG 2;ROW 7;ROW 8; | GET M0.1;DO 14;ARG U3; | DO 11;\n"
            "U3: | GET M0.2;DO 21;ARG I2;ARG Q1; | DO 13;\n");
  EXPECT_EQ(program.program.units[0].networks[0].title, "the door");
  EXPECT_EQ(program.program.units[kSlow].networks[2].callee, 2u);
  EXPECT_TRUE(program.program.units[2].runBy[kSlow]);
  EXPECT_FALSE(program.program.units[2].runBy[kFast]);
}

TEST(Network, ALadderIsReadIntoTheSameUnits) {
  const Checked program = ladder("module SLOW\nrung\n|--[I0.0]--+--[/I0.1]--(/Q0.0)\n|--[M0.0]--+\n"
                                 "rung\n|--[I0.0]--{VISIT U1}\nmodule EXTRA U1\nrung\n|--[I0.0]--{PICK M2 1 ROW 5}\n");
  EXPECT_EQ(joined(program.reports()), "");
  EXPECT_EQ(joined(program.units()), "FAST: | DO 10;\n"
                                     "SLOW: | GET I0.0;ELSE M0.0;WITHN I0.1;PUTN Q0.0;"
                                     " | GET I0.0;DO 14;ARG U1; | DO 11;\n"
                                     "U1: | GET I0.0;DO 22;ARG M2;ARG 1;ROW 5; | DO 13;\n");
}

// All that is said about wrong programs in the words of the language.
TEST(NetworkGolden, Mistakes) {
  rung::test::Golden golden("tests/golden/network", {".cases"});
  for (const std::filesystem::path& file : golden.inputs())
    rung::test::expectCases(golden, file, [&](const rung::test::Case& one) {
      const std::string text = one.input + "\n";
      return joined(Checked(file.stem() == "ladder" ? "test.lad" : "test.lst", text).reports());
    });
}

TEST(Network, LimitsAreTheLanguages) {
  std::string deep;
  for (int i = 0; i < 4; ++i) deep += "GET I0.0\n";
  const std::vector<std::string> overflow = reportsOf(deep + "MERGE\nMERGE\nMERGE\nPUT Q0.0\n");
  ASSERT_EQ(overflow.size(), 1u);
  EXPECT_EQ(lacking(overflow[0], {"5 stack-overflow"}), "");
  std::string steps;
  for (int i = 0; i < 38; ++i) steps += i == 0 ? "GET I0.0\n" : "PUT M0." + std::to_string(i % 8) + "\n";
  EXPECT_EQ(joined(reportsOf(steps)), "");
  EXPECT_EQ(joined(reportsOf(steps + "PUT M1.0\n")), "41 program-too-large: the program has more than 40 steps\n");
  std::string calls = "GET I0.0\nDO VISIT\nARG U1\nDO SLOWEND\n";
  for (int i = 1; i <= 3; ++i) {
    calls += "DO PART\nARG U" + std::to_string(i) + "\n";
    if (i < 3) calls += "GET I0.0\nDO VISIT\nARG U" + std::to_string(i + 1) + "\n";
    calls += "DO PARTEND\n";
  }
  const std::vector<std::string> nested = list("DO FASTEND\n" + calls).reports();
  ASSERT_EQ(nested.size(), 1u);
  EXPECT_EQ(lacking(nested[0], {"nested more than 2 deep"}), "");
}

TEST(Network, NoMoreIsNeededThanTheEndsOfTheLevels) {
  Language ends = kLittle;
  ends.rows = std::span(kRowPointers).first(2);
  ends.subprogram = {};
  const Checked program("test.lst", "symbol K4 M0.0\nGET I0.0\nPUT K4\nDO 10\nGET K4\nDO COPY\nDO 11\n", ends);
  EXPECT_EQ(joined(program.reports()), "6 unknown-function: unknown function command 'COPY'\n");
  EXPECT_EQ(program.program.units[kFast].networks.size(), 2u) << "K4 is a name here: there are no labels";
}

std::string converted(const std::string& name, const std::string& text, Form to, const Language& language = kLittle) {
  Checked program(name, text, language);
  EXPECT_EQ(joined(program.reports()), "");
  return convertProgram(language, program.sources, program.files, to, program.diagnostics).value_or("");
}

TEST(Network, ConvertsToLadderAndBack) {
  const std::string drawn = converted("test.lst", kProgram, Form::Ladder);
  EXPECT_EQ(drawn.substr(0, kDrawn.size()), kDrawn);
  EXPECT_THAT(drawn, HasSubstr("|--[M0.0]--{PICK M2 2 ROW 7 8}\n"));
  EXPECT_THAT(drawn, HasSubstr("module EXTRA U3\n"));
  const std::string back = converted("test.lad", drawn, Form::List);
  EXPECT_EQ(list(back).units(), list(kProgram).units());
  EXPECT_THAT(back, HasSubstr("GETN I0.3         ; why not\n"));
  EXPECT_EQ(converted("test.lst", back, Form::Ladder), drawn);
}

TEST(Network, BlocksThatADrawingDoesNotHaveAreAHint) {
  const std::string text = "DO 10\nGET I0.0\nGET I0.1\nMEET\nPUT Q0.0\nDO 11\n";
  const std::string drawn = converted("test.lst", text, Form::Ladder);
  EXPECT_THAT(drawn, HasSubstr("; list: GET GET MEET\n"));
  EXPECT_EQ(list(converted("test.lad", drawn, Form::List)).units(), list(text).units());
}

TEST(Network, AThirdLevelIsARow) {
  const ThreeLevels three;
  const std::string text = "GET I0.0\nPUT Q0.0\nDO FASTEND\nGET I0.1\nPUT Q0.1\nDO SLOWEND\n"
                           "GET I0.2\nDO VISIT\nARG U1\nDO IDLEEND\nDO PART\nARG U1\nGET I0.3\nPUT Q0.3\nDO PARTEND\n";
  const Checked program("test.lst", text, three.language());
  EXPECT_EQ(joined(program.reports()), "");
  EXPECT_EQ(joined(program.units()), "FAST: | GET I0.0;PUT Q0.0; | DO 10;\n"
                                     "SLOW: | GET I0.1;PUT Q0.1; | DO 11;\n"
                                     "IDLE: | GET I0.2;DO 14;ARG U1; | DO 30;\n"
                                     "U1: | GET I0.3;PUT Q0.3; | DO 13;\n");
  EXPECT_EQ(program.program.units[3].runBy, std::vector<bool>({false, false, true}));

  const std::string drawn = converted("test.lst", text, Form::Ladder, three.language());
  EXPECT_THAT(drawn, HasSubstr("module IDLE\n"));
  EXPECT_EQ(Checked("test.lad", drawn, three.language()).units(), program.units());
  const std::string back = converted("test.lad", drawn, Form::List, three.language());
  EXPECT_EQ(Checked("test.lst", back, three.language()).units(), program.units());
}

TEST(Network, EndsOfThreeLevelsHaveTheirOrder) {
  const ThreeLevels three;
  const auto reports = [&](const std::string& text) {
    return joined(Checked("test.lst", text, three.language()).reports());
  };
  EXPECT_EQ(reports("DO FASTEND\nDO IDLEEND\n"), "2 missing-end2: SLOWEND (DO 11) is missing\n");
  EXPECT_EQ(reports("DO FASTEND\nDO SLOWEND\n"), "2 missing-end2: IDLEEND (DO 30) is missing\n");
  EXPECT_EQ(reports("DO FASTEND\nDO IDLEEND\nDO SLOWEND\n"),
            "3 end-order: SLOWEND (DO 11) comes after IDLEEND (DO 30)\n");
  EXPECT_EQ(reports("DO FASTEND\nDO SLOWEND\nDO PART\nARG U1\nDO PARTEND\nDO IDLEEND\n"),
            "3 subprogram-misplaced: a subprogram begins before IDLEEND\n4 subprogram-unused: subprogram U1 is never "
            "called\n");
  EXPECT_EQ(reports("GET I0.0\nPUT Q0.0\nDO FASTEND\nDO SLOWEND\nGET I0.1\nPUT Q0.0\nDO IDLEEND\n"),
            "6 double-coil: Q0.0 is driven by two coils\n")
      << "the first and the last level";
}

TEST(Network, FormatsItsLists) {
  SourceManager sources;
  Diagnostics diagnostics;
  const FileId file = sources.addBuffer("test.lst", "get I0.0\ndo clock\narg 1 ; x\n");
  EXPECT_EQ(format(kLittle, sources, file, diagnostics), "GET  I0.0\nDO   CLOCK\nARG  1            ; x\n");
}

} // namespace
} // namespace rung::frontend::network::test

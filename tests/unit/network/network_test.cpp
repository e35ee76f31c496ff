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
#include "tests/unit/network/little_language.h"

namespace rung::network::test {
namespace {

using convert::Form;
using testing::ElementsAre;
using testing::HasSubstr;

// A program that was read and checked.
struct Checked {
  SourceManager sources;
  Diagnostics diagnostics;
  Context context;
  Program program;
  std::vector<FileId> files;

  Checked(const std::string& name, const std::string& text, const Language& language = kLittle)
      : context{.language = language, .sources = sources, .diagnostics = diagnostics} {
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
      std::string text = nameOf(kLittle, unit) + ":";
      for (const Network& network : unit.networks) text += " | " + commandText(kLittle, network);
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
  EXPECT_THAT(program.reports(), ElementsAre());
  EXPECT_THAT(program.units(),
              ElementsAre("FAST: | GET I1.7;WITHN I0.1;PUT Q0.1; | DO 10;",
                          "SLOW: | GET I0.2;GETN I0.3;GET I0.4;WITH I0.5;MERGE;DO 20;ARG 2;PUT M0.0;HOLD M0.1;"
                          " | GET M0.0;DO 22;ARG M2;ARG 2;ROW 7;ROW 8; | GET M0.1;DO 14;ARG U3; | DO 11;",
                          "U3: | GET M0.2;DO 21;ARG I2;ARG Q1; | DO 13;"));
  EXPECT_EQ(program.program.units[0].networks[0].title, "the door");
  EXPECT_EQ(program.program.units[kLevel2].networks[2].callee, 2u);
  EXPECT_TRUE(program.program.units[2].fromLevel2);
  EXPECT_FALSE(program.program.units[2].fromLevel1);
}

TEST(Network, ALadderIsReadIntoTheSameUnits) {
  const Checked program = ladder("module SLOW\nrung\n|--[I0.0]--+--[/I0.1]--(/Q0.0)\n|--[M0.0]--+\n"
                                 "rung\n|--[I0.0]--{VISIT U1}\nmodule EXTRA U1\nrung\n|--[I0.0]--{PICK M2 1 ROW 5}\n");
  EXPECT_THAT(program.reports(), ElementsAre());
  EXPECT_THAT(program.units(), ElementsAre("FAST: | DO 10;",
                                           "SLOW: | GET I0.0;ELSE M0.0;WITHN I0.1;PUTN Q0.0;"
                                           " | GET I0.0;DO 14;ARG U1; | DO 11;",
                                           "U1: | GET I0.0;DO 22;ARG M2;ARG 1;ROW 5; | DO 13;"));
}

TEST(Network, MistakesAreNamedInItsWords) {
  EXPECT_THAT(reportsOf("WITH I0.0\nPUT Q0.0\n"),
              ElementsAre(HasSubstr("2 unbalanced-stack: a network begins with GET or GETN")));
  EXPECT_THAT(reportsOf("GET I0.0\nMEET\nPUT Q0.0\n"), ElementsAre(HasSubstr("3 unbalanced-stack: MEET joins")));
  EXPECT_THAT(reportsOf("LD I0.0\n"), ElementsAre("2 unknown-command: unknown command 'LD'"));
  EXPECT_THAT(reportsOf("GET I0.0\nARG 1\nPUT Q0.0\n"),
              ElementsAre("3 stray-parameter: ARG without a function command before it"));
  EXPECT_THAT(reportsOf("GET I0.0\nPUT Q0.0\nROW 1\n"),
              ElementsAre("4 stray-table: ROW is allowed only after the parameters of PICK"));
  EXPECT_THAT(reportsOf("GET I0.0\nDO LATER\n"), ElementsAre(HasSubstr("3 not-built-yet")));
  EXPECT_THAT(reportsOf("GET I0.0\nDO SKIP\n"), ElementsAre("3 missing-jmpe: SKIP is not closed with SKIPEND"));
  EXPECT_THAT(reportsOf("GET I0.0\nDO HOP\nARG K4\n"), ElementsAre(HasSubstr("4 undefined-label: label K4")));
  EXPECT_THAT(list("GET I0.0\nPUT Q0.0\n").reports(),
              ElementsAre("2 missing-end1: FASTEND (DO 10) is missing", "2 missing-end2: SLOWEND (DO 11) is missing"));
  EXPECT_THAT(reportsOf("symbol K4 M0.0\n"), ElementsAre(HasSubstr("2 bad-operand"))) << "like a label";
  EXPECT_THAT(ladder("module LEVEL1\n").reports(),
              ElementsAre(HasSubstr("module FAST, module SLOW or module EXTRA Un")));
  EXPECT_THAT(ladder("module SLOW\nrung\n|--[@I0.0]--(Q0.0)\n").reports(), ElementsAre(HasSubstr("use RISE")));
  EXPECT_THAT(list("dialect other\nDO 10\nDO 11\n").reports(), ElementsAre(HasSubstr("1 dialect-conflict")));
}

TEST(Network, AreasSayWhatMayBeWritten) {
  EXPECT_THAT(reportsOf("GET Q4.0\nPUT Q0.0\n"), ElementsAre(HasSubstr("Q0 to Q3")));
  EXPECT_THAT(reportsOf("GET X0.0\nPUT Q0.0\n"), ElementsAre(HasSubstr("2 bad-operand")));
  EXPECT_THAT(reportsOf("GET I0.0\nPUT I0.1\n"), ElementsAre(HasSubstr("3 write-to-input")));
  EXPECT_THAT(reportsOf("GET I0.0\nPUT Z3.1\n"), ElementsAre(HasSubstr("3 write-to-preset")));
  EXPECT_THAT(reportsOf("GET I0.0\nPUT Z4.1\n"), ElementsAre());
  EXPECT_THAT(reportsOf("GET I0.0\nPUT M12.0\n"), ElementsAre("3 system-area-write: M12.0 is in the system area of M"));
  EXPECT_THAT(reportsOf("GET I0.0\nDO PICK\nARG Q0\nARG 1\nROW 1\n"), ElementsAre(HasSubstr("4 work-area-not-in-r")));
  EXPECT_THAT(reportsOf("GET I0.0\nPUT Q0.0\nGET I0.1\nPUT Q0.0\n"), ElementsAre(HasSubstr("5 double-coil")));
  EXPECT_THAT(reportsOf("GET I0.0\nPUT M0.0\nGET I0.1\nPUT M0.0\n"), ElementsAre()) << "nobody sees it";
}

TEST(Network, AnUndeclaredNameIsOneReport) {
  EXPECT_THAT(reportsOf("GET LAMB\nGET LAMB\nMEET\nPUT LAMB\n"),
              ElementsAre("2 bad-operand: 'LAMB' is not a bit address, signal or declared name"));
  EXPECT_THAT(ladder("module SLOW\nrung\n|--[LAMB]--(LAMB)\n").reports(), ElementsAre(HasSubstr("4 bad-operand")));
}

TEST(Network, LimitsAreTheLanguages) {
  std::string deep;
  for (int i = 0; i < 4; ++i) deep += "GET I0.0\n";
  EXPECT_THAT(reportsOf(deep + "MERGE\nMERGE\nMERGE\nPUT Q0.0\n"), ElementsAre(HasSubstr("5 stack-overflow")));
  std::string steps;
  for (int i = 0; i < 38; ++i) steps += i == 0 ? "GET I0.0\n" : "PUT M0." + std::to_string(i % 8) + "\n";
  EXPECT_THAT(reportsOf(steps), ElementsAre());
  EXPECT_THAT(reportsOf(steps + "PUT M1.0\n"), ElementsAre("41 program-too-large: the program has more than 40 steps"));
  std::string calls = "GET I0.0\nDO VISIT\nARG U1\nDO SLOWEND\n";
  for (int i = 1; i <= 3; ++i) {
    calls += "DO PART\nARG U" + std::to_string(i) + "\n";
    if (i < 3) calls += "GET I0.0\nDO VISIT\nARG U" + std::to_string(i + 1) + "\n";
    calls += "DO PARTEND\n";
  }
  EXPECT_THAT(list("DO FASTEND\n" + calls).reports(), ElementsAre(HasSubstr("nested more than 2 deep")));
}

TEST(Network, NoMoreIsNeededThanTheEndsOfTheLevels) {
  Language ends = kLittle;
  ends.rows = std::span(kRowPointers).first(2);
  ends.subprogram = {};
  const Checked program("test.lst", "symbol K4 M0.0\nGET I0.0\nPUT K4\nDO 10\nGET K4\nDO COPY\nDO 11\n", ends);
  EXPECT_THAT(program.reports(), ElementsAre("6 unknown-function: unknown function command 'COPY'"));
  EXPECT_EQ(program.program.units[kLevel1].networks.size(), 2u) << "K4 is a name here: there are no labels";
}

std::string converted(const std::string& name, const std::string& text, Form to) {
  Checked program(name, text);
  EXPECT_THAT(program.reports(), ElementsAre());
  return convertProgram(kLittle, program.sources, program.files, to, program.diagnostics).value_or("");
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

TEST(Network, FormatsItsLists) {
  SourceManager sources;
  Diagnostics diagnostics;
  const FileId file = sources.addBuffer("test.lst", "get I0.0\ndo clock\narg 1 ; x\n");
  EXPECT_EQ(format(kLittle, sources, file, diagnostics), "GET  I0.0\nDO   CLOCK\nARG  1            ; x\n");
}

} // namespace
} // namespace rung::network::test

// The statements around the drawings.
#include <gtest/gtest.h>

#include "ladder_testing.h"

namespace rung::frontend::ladder {
namespace {

/// All statements of a file in order, one a line.
std::string outline(const Parsed& parsed) {
  const LadderFile& file = parsed.ladder;
  std::string text;
  const auto word = [](const Word& w) { return w.quoted ? "\"" + std::string(w.text) + "\"" : std::string(w.text); };
  for (const Statement& s : file.statements) {
    switch (s.kind) {
    case StatementKind::Dialect:
    case StatementKind::Comment:
    case StatementKind::Blank: continue;
    case StatementKind::Module:
      text += "module";
      for (const Word& w : file.modules[s.index].name) text += " " + word(w);
      break;
    case StatementKind::Declaration: {
      const Declaration& d = file.declarations[s.index];
      constexpr const char* kNames[] = {"symbol", "const", "message", "button", "data"};
      text += kNames[static_cast<size_t>(d.kind)] + (" " + word(d.name) + " " + word(d.value));
      if (!d.comment.empty()) text += " ; " + std::string(d.comment);
      break;
    }
    case StatementKind::Section: text += "section " + word(file.sections[s.index].title); break;
    case StatementKind::Rung: {
      const Rung& r = file.rungs[s.index];
      text += "rung in " + (r.module == UINT32_MAX ? "nothing" : std::to_string(r.module)) + (r.bad ? " bad" : "");
      break;
    }
    }
    text += "\n";
  }
  return text;
}

TEST(Statements, AllKindsInOrder) {
  const Parsed parsed(R"(; a comment first
dialect nct                       ; first statement of the file
module MAIN

symbol START   7000.00            ; a bit
symbol SW2     N_SW,#1
const  LIMIT   #10
message 20 "Mount tool {#0:F0}; please"
button 23 "LUBRICATION"

section "Spindle"

rung "start"
|--[START]--(MOTOR)

module SUB P1
symbol LATE 6000
rung
|--[A]--(B)
)");
  EXPECT_EQ(parsed.errors(), "");
  EXPECT_EQ(parsed.ladder.dialect, "nct");
  EXPECT_EQ(outline(parsed), R"(module MAIN
symbol START 7000.00 ; a bit
symbol SW2 N_SW,#1
const LIMIT #10
message 20 "Mount tool {#0:F0}; please"
button 23 "LUBRICATION"
section "Spindle"
rung in 0
module SUB P1
symbol LATE 6000
rung in 1
)");
}

TEST(Statements, RungKeepsCommentAndLines) {
  const Parsed parsed("dialect nct\nmodule M\nrung \"a; b\" ; not this\n|--[A]--+--(X)   \n        +--(Y)  ; last\n\n");
  ASSERT_EQ(parsed.errors(), "");
  const Rung& rung = parsed.ladder.rungs.at(0);
  EXPECT_EQ(rung.comment, "a; b");
  EXPECT_EQ(rung.firstLine, 3u);
  EXPECT_EQ(rung.lastLine, 5u);
  EXPECT_EQ(parsed.sources.lineCol(rung.range.begin), (LineCol{"t.lad", 3, 1}));
  EXPECT_EQ(parsed.sources.lineCol(rung.range.end), (LineCol{"t.lad", 5, 23}));
  EXPECT_EQ(parsed.sources.text(rung.statement), "rung \"a; b\"");
}

TEST(Statements, EmptyCommentIsNotNoComment) {
  const Parsed parsed("dialect nct\nmodule M\nrung \"\"\n|--[A]--(X)\nrung\n|--[A]--(X)\n");
  EXPECT_TRUE(parsed.ladder.rungs.at(0).hasComment);
  EXPECT_FALSE(parsed.ladder.rungs.at(1).hasComment);
}

TEST(Statements, NextStatementEndsADrawingToo) {
  const Parsed parsed("dialect nct\nmodule M\nrung\n|--[A]--(X)\nsymbol B 1\nrung\n|--[A]--(Y)\nrung\n|--[C]--(Z)");
  EXPECT_EQ(parsed.errors(), "");
  EXPECT_EQ(outline(parsed), "module M\nrung in 0\nsymbol B 1\nrung in 0\nrung in 0\n");
}

TEST(Statements, CommentLinesDoNotEndADrawing) {
  EXPECT_EQ(elementsOf("|--[A]--+--(X)\n; in between\n   ; and indented\n|--[B]--+\n"),
            "e0 [A] n0 -> n1\ne1 [B] n0 -> n1\ne2 (X) n1 -> .\n; in between\n; and indented\n");
}

TEST(Statements, CommentsBelongToTheRungOrAreStatements) {
  const Parsed parsed("dialect nct\nmodule M ; m\n\n; above\nrung\n; inside\n|--[A]--(X) ; after\n; below\n");
  EXPECT_EQ(parsed.errors(), "");
  std::string kinds;
  for (const Statement& s : parsed.ladder.statements) kinds += std::to_string(static_cast<int>(s.kind));
  EXPECT_EQ(kinds, "016545") << "dialect, module, blank, comment, rung, comment";
  EXPECT_EQ(parsed.ladder.statements.at(1).comment, "m");
  EXPECT_EQ(parsed.ladder.comments.at(0).text, "above");
  EXPECT_EQ(parsed.ladder.comments.at(1).text, "below");
  const auto& own = parsed.ladder.rungs.at(0).comments;
  ASSERT_EQ(own.size(), 2u);
  EXPECT_TRUE(own[0].alone && own[0].text == "inside" && own[0].line == 6);
  EXPECT_TRUE(!own[1].alone && own[1].text == "after" && own[1].line == 7);
}

TEST(Statements, LineEndsOfDos) {
  const Parsed parsed("dialect nct\r\nmodule M\r\nrung\r\n|--[A]--(X) ; r\r\n\r\nsymbol B 1 ; c\r\n");
  EXPECT_EQ(parsed.errors(), "");
  EXPECT_EQ(dumpRung(parsed.ladder.rungs.at(0)), "rung 3-4\ne0 [A] n0 -> n1\ne1 (X) n1 -> .\n; r\n");
  EXPECT_EQ(parsed.ladder.declarations.at(0).comment, "c");
}

TEST(Statements, CommentsAndTextsMayBeInAnyAlphabet) {
  const Parsed parsed(
      "\xEF\xBB\xBF"
      "dialect gsk ; \u4E3B\u8F74\nmodule M\nmessage 1 \"\u4E3B\"\nrung \"\u00E9\"\n|--[A]--(X) ; \u4E3B\n");
  EXPECT_EQ(parsed.errors(), "");
  EXPECT_EQ(parsed.ladder.rungs.at(0).comments.at(0).text, "\u4E3B");
}

TEST(Statements, PeekDialect) {
  SourceManager sources;
  const auto peek = [&](const char* text) { return peekDialect(sources, sources.addBuffer("f", text)); };
  EXPECT_EQ(peek("; x\n\n  dialect gsk ; y\n"), "gsk");
  EXPECT_EQ(peek("dialect\n"), "");
  EXPECT_EQ(peek("module M\ndialect gsk\n"), "");
  EXPECT_EQ(peek(""), "");
}

std::string errorsOf(std::string text) { return Parsed(std::move(text)).errors(); }

TEST(StatementErrors, MissingDialect) {
  EXPECT_EQ(errorsOf(""), "1:1 missing-dialect\n");
  EXPECT_EQ(errorsOf("; only a comment\n"), "1:1 missing-dialect\n");
  EXPECT_EQ(errorsOf("\nmodule MAIN\nmodule INT0\n"), "2:1 missing-dialect\n");
}

TEST(StatementErrors, MisplacedDialect) {
  EXPECT_EQ(errorsOf("dialect nct\nmodule M\ndialect nct\n"), "3:1 misplaced-dialect\n");
  EXPECT_EQ(errorsOf("dialect nct\ndialect gsk\n"), "2:1 misplaced-dialect\n");
}

TEST(StatementErrors, UnknownStatement) {
  EXPECT_EQ(errorsOf("dialect nct\nmodul M\n"), "2:1 unknown-statement\n");
  EXPECT_EQ(errorsOf("dialct nct\n"), "1:1 unknown-statement\n");
  EXPECT_EQ(errorsOf("dialect nct\n  \"rung\"\n"), "2:3 unknown-statement\n");
  // The drawing below a misspelt word belongs to it.
  EXPECT_EQ(errorsOf("dialect nct\nmodule M\nrnug\n|--[A]--(X)\n|--[B]--(Y)\n"), "3:1 unknown-statement\n");
}

TEST(StatementErrors, MalformedStatements) {
  EXPECT_EQ(errorsOf("dialect nct gsk\n"), "1:1 malformed-statement\n");
  for (const char* statement : {"module", "module \"MAIN\"", "symbol", "symbol A", "symbol A 1 2", "symbol A \"1\"",
                                "symbol \"A\" 1", "const A", "message 20", "message 20 text", "message \"text\"",
                                "button 1 2", "section", "section Spindle", "section \"a\" \"b\""}) {
    EXPECT_EQ(errorsOf(std::string("dialect nct\n ") + statement + "\n"), "2:2 malformed-statement\n") << statement;
  }
}

TEST(StatementErrors, MalformedRungStillHasItsDrawing) {
  const Parsed parsed("dialect nct\nmodule M\nrung start\n|--[A]--(X)\n");
  EXPECT_EQ(parsed.errors(), "3:1 malformed-statement\n");
  EXPECT_EQ(parsed.ladder.rungs.at(0).elements.size(), 2u);
}

TEST(StatementErrors, RungOutsideModuleIsSaidOnce) {
  EXPECT_EQ(errorsOf("dialect nct\nrung\n|--[A]--(X)\nrung\n|--[A]--(X)\nmodule M\nrung\n|--[A]--(X)\n"),
            "2:1 rung-outside-module\n");
}

TEST(StatementErrors, StrayDrawingIsSaidOnceABlock) {
  EXPECT_EQ(errorsOf("dialect nct\nmodule M\n|--[A]--(X)\n|--[B]--(X)\n\n|--[C]--(X)\n"),
            "3:1 stray-drawing\n6:1 stray-drawing\n");
  EXPECT_EQ(errorsOf("dialect nct\nmodule M\nrung\n|--[A]--(X)\n\n|--[B]--(Y)\n"), "6:1 stray-drawing\n");
}

TEST(StatementErrors, UnterminatedQuote) {
  EXPECT_EQ(errorsOf("dialect nct\nmessage 20 \"text\nmodule M\n"), "2:12 unterminated-quote\n");
  EXPECT_EQ(errorsOf("dialect nct\nmodule M\nrung \"text\n|--[A]--(X)\n"), "3:6 unterminated-quote\n");
}

TEST(StatementErrors, BadCharacterAndTab) {
  EXPECT_EQ(errorsOf("dialect nct\nsymbol \u0410B 1\n"), "2:8 bad-character\n");
  EXPECT_EQ(errorsOf("dialect nct\nsymbol\tA\t1\n"), "2:7 tab-character\n");
  EXPECT_EQ(errorsOf("dialect nct\nmodule M ; a\tb\n"), "2:13 tab-character\n");
}

TEST(StatementErrors, TextThatIsNotUtf8IsNotReadAtAll) {
  EXPECT_EQ(errorsOf("dialect nct\nmodule M ; caf\xE9\nrubbish\n"), "2:15 bad-encoding\n");
  EXPECT_EQ(errorsOf(std::string("\x7F"
                                 "ELF\0\0\xFF",
                                 7)),
            "1:5 bad-encoding\n");
}

} // namespace
} // namespace rung::frontend::ladder

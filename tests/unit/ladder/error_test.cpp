// Mistakes in drawings: their code and place. The drawing begins in line 4.
#include <gtest/gtest.h>

#include "ladder_testing.h"

namespace rung::frontend::ladder {
namespace {

std::string errorsOf(const std::string& drawing) { return parseDrawing(drawing).errors(); }

TEST(DrawingErrors, EmptyRung) {
  EXPECT_EQ(errorsOf(""), "3:1 empty-rung\n");
  EXPECT_EQ(errorsOf("|\n"), "3:1 empty-rung\n");
  EXPECT_EQ(errorsOf("\n|--[A]--(X)\n"), "3:1 empty-rung\n") << "one mistake";
  EXPECT_EQ(errorsOf("|--------\n|\n"), "3:1 empty-rung\n");
}

TEST(DrawingErrors, UnclosedElement) {
  EXPECT_EQ(errorsOf("|--[A--(X)\n"), "4:4 unclosed-element\n");
  EXPECT_EQ(errorsOf("|--[A)--(X)\n"), "4:4 unclosed-element\n");
  EXPECT_EQ(errorsOf("|--[A]--(X\n"), "4:9 unclosed-element\n");
  EXPECT_EQ(errorsOf("|--[A]--{MOV A B--(X)\n"), "4:9 unclosed-element\n");
  EXPECT_EQ(errorsOf("|--[A]--{MOV A B--{MOV C D}\n"), "4:9 unclosed-element\n");
  EXPECT_EQ(errorsOf("|--[A]--{"), "4:9 unclosed-element\n");
  EXPECT_EQ(errorsOf("|--[A]--["), "4:9 unclosed-element\n");
}

TEST(DrawingErrors, BadElement) {
  for (const char* element : {"[]", "[ ]", "[/]", "[@]", "[/%]", "[A B]", "()", "(/)", "(A B)", "(S A B)", "{}", "{ }",
                              "{\"MSG\" 1}", "(X ; no comment)"}) {
    EXPECT_EQ(errorsOf(std::string("|--[A]--") + element + "\n"), "4:9 bad-element\n") << element;
  }
}

TEST(DrawingErrors, UnterminatedQuote) {
  EXPECT_EQ(errorsOf("|--[A]--{MSG #1 \"text}--(X)\n"), "4:17 unterminated-quote\n");
}

TEST(DrawingErrors, StrayTextAndCharacters) {
  EXPECT_EQ(errorsOf("|--A--(X)\n"), "4:4 stray-text\n");
  EXPECT_EQ(errorsOf("|--[A]]--(X)\n"), "4:7 stray-text\n");
  EXPECT_EQ(errorsOf("|--[A]\u2013(X)\n"), "4:7 bad-character\n");
  EXPECT_EQ(errorsOf("|--[\u0410]--(X)\n"), "4:5 bad-character\n");
  EXPECT_EQ(errorsOf("|--[A]--{MOV \u0410 B}\n"), "4:14 bad-character\n");
  EXPECT_EQ(errorsOf("|--[A\x01]--(X)\n"), "4:6 bad-character\n");
}

TEST(DrawingErrors, Tab) {
  EXPECT_EQ(errorsOf("|--[A]\t--(X)\n"), "4:7 tab-character\n");
  EXPECT_EQ(errorsOf("|--[A]--(X)\t; c\n\t+--[B]--(Y)\n"), "4:12 tab-character\n5:1 tab-character\n");
}

TEST(DrawingErrors, GapInAWire) {
  EXPECT_EQ(errorsOf("|--[A]-- --(X)\n"), "4:10 dangling-wire\n");
  EXPECT_EQ(errorsOf("|--[A]--  (X)\n"), "4:11 dangling-wire\n");
  EXPECT_EQ(errorsOf("| --[A]--(X)\n"), "4:3 dangling-wire\n");
  EXPECT_EQ(errorsOf(" --[A]--(X)\n"), "4:2 dangling-wire\n");
  EXPECT_EQ(errorsOf("[A]--(X)\n"), "4:1 dangling-wire\n");
}

TEST(DrawingErrors, WireThatEndsNowhere) {
  EXPECT_EQ(errorsOf("|--[A]--+--(X)\n        +--\n"), "5:9 dangling-wire\n");
  EXPECT_EQ(errorsOf("|--[A]--(X)\n|--\n"), "5:2 dangling-wire\n");
  EXPECT_EQ(errorsOf("|--[A]--+--(X)\n        +\n"), "5:9 dangling-wire\n");
  EXPECT_EQ(errorsOf("|--[A]--+--(X)\n       +--(Y)\n"), "5:8 dangling-wire\n");
}

TEST(DrawingErrors, BranchThatEndsInAWire) {
  EXPECT_EQ(errorsOf("|--[A]--\n"), "4:7 missing-closing-element\n");
  EXPECT_EQ(errorsOf("|--[A]--+\n"), "4:7 missing-closing-element\n");
  EXPECT_EQ(errorsOf("|--[A]--+--(X)\n        +--[B]--\n"), "5:15 missing-closing-element\n");
  EXPECT_EQ(errorsOf("|--[A]--+--+\n        +--+\n"), "4:7 missing-closing-element\n");
}

TEST(DrawingErrors, WireBehindACoil) { EXPECT_EQ(errorsOf("|--[A]--(X)--\n"), "4:12 element-after-closing\n"); }

TEST(DrawingErrors, VerticalWires) {
  EXPECT_EQ(errorsOf("|--[A]--+--(X)\n        |\n"), "5:9 dangling-wire\n");
  EXPECT_EQ(errorsOf("|--[A]--(X)\n        |\n        +--(Y)\n"), "5:9 dangling-wire\n");
  EXPECT_EQ(errorsOf("|--[A]--|--(X)\n"), "4:7 dangling-wire\n");
  EXPECT_EQ(errorsOf("|--[A]--+--[B]--+--(X)\n        |--[C]--|\n"), "5:9 dangling-wire\n");
  EXPECT_EQ(errorsOf("|--[A]--+--[B]--+--(X)\n        +--[C]--|\n        +--[D]--+\n"), "5:15 dangling-wire\n");
  EXPECT_EQ(errorsOf(" |--[A]--(X)\n"), "4:2 dangling-wire\n");
}

// Only after what ends a line is a '|' the right rail.
TEST(DrawingErrors, RightRail) {
  EXPECT_EQ(errorsOf("|--[A]--|\n"), "4:7 dangling-wire\n");
  EXPECT_EQ(errorsOf("|--[A]--{CEQ B C}--|--(X)\n|--[D]--{CEQ E F}--|\n"), "4:18 dangling-wire\n5:18 dangling-wire\n");
  EXPECT_EQ(errorsOf("|--[A]--(X)--|\n|--[B]-------|\n"), "5:7 missing-closing-element\n");
  EXPECT_EQ(errorsOf("|--[A]--(X)--|--(Y)\n"), "4:12 dangling-wire\n");
}

TEST(DrawingErrors, SeveralBadElementsOfALine) {
  EXPECT_EQ(errorsOf("|--[A B]--[~C]--[\u0410]--(SET D)\n"),
            "4:4 bad-element\n4:11 bad-element\n4:18 bad-character\n4:22 bad-element\n");
  EXPECT_EQ(errorsOf("|--[]--{MOV A\n"), "4:4 bad-element\n4:8 unclosed-element\n");
}

TEST(DrawingErrors, ContactsOfBars) {
  EXPECT_EQ(errorsOf("|--| |--( )--|\n"), "4:4 stray-text\n4:9 bad-element\n");
  EXPECT_EQ(errorsOf("|--|A|--(X)\n"), "4:5 stray-text\n");
}

TEST(DrawingErrors, NegationAfterTheEdge) {
  for (const char* element : {"[~A]", "[@/A]", "[%~A]", "[//A]", "(~A)", "(S /A)"})
    EXPECT_EQ(errorsOf(std::string("|--[B]--") + element + "\n"), "4:9 bad-element\n") << element;
}

TEST(DrawingErrors, NothingLeadsFromTheRail) {
  EXPECT_EQ(errorsOf("|--[A]--(X)\n   +--[B]--(Y)\n   +--[C]--(Z)\n"), "5:4 dangling-wire\n");
}

TEST(DrawingErrors, ShortCircuit) {
  EXPECT_EQ(errorsOf("|--+--[A]--+--(X)\n   +-------+\n"), "4:7 short-circuit\n");
  EXPECT_EQ(
      errorsOf("|--[A]--+--{CNT C}--+--(X)\n        +--{U/D  }  |\n        +--{R    }  |\n        +-----------+\n"),
      "4:12 short-circuit\n");
}

TEST(DrawingErrors, PowerLoop) {
  EXPECT_EQ(errorsOf("|--[A]--+--[B]--+---(X)\n"
                     "        |       +--[C]--+\n"
                     "        +---------------+\n"),
            "5:20 power-loop\n");
  EXPECT_EQ(errorsOf("|--+--[A]--+----------(X)\n"
                     "   |       +--[B]--+\n"
                     "   +---------------+\n"),
            "5:15 power-loop\n");
}

TEST(DrawingErrors, MisalignedBox) {
  EXPECT_EQ(errorsOf("|--[A]--{CNT C}--(F)\n|--[B]---{U/D }\n|--[C]--{R    }\n"), "5:10 misaligned-box\n");
  EXPECT_EQ(errorsOf("|--[A]--{CNT C}--(F)\n|--[B]--{U/D  }\n|--[C]-{R}\n"), "6:8 misaligned-box\n");
  // Without a table the padding tells.
  EXPECT_EQ(parseDrawing("|--[A]--{CNT C}--(F)\n|--[B]---{U/D }\n", {}).errors(), "5:10 misaligned-box\n");
}

TEST(DrawingErrors, PinLineHasNoOutput) {
  EXPECT_EQ(errorsOf("|--[A]--{CNT C}\n|--[B]--{U/D  }--(F)\n|--[C]--{R    }\n"), "5:16 dangling-wire\n");
}

TEST(DrawingErrors, OneErrorALineAndGoOnWithTheNextRung) {
  const Parsed parsed(
      "dialect t\nmodule M\nrung\n|--[A-[B--[C\n|--(--[D\n\nrung\n|--[A]-- --  (X)\n\nrung\n|--[A]--(X)\n");
  EXPECT_EQ(parsed.errors(), "4:4 unclosed-element\n5:4 unclosed-element\n8:10 dangling-wire\n");
  EXPECT_TRUE(parsed.ladder.rungs.at(0).bad);
  EXPECT_TRUE(parsed.ladder.rungs.at(1).bad);
  EXPECT_FALSE(parsed.ladder.rungs.at(2).bad);
  EXPECT_EQ(parsed.ladder.rungs.at(2).elements.size(), 2u);
}

TEST(DrawingErrors, WhatCanBeReadStays) {
  const Parsed broken = parseDrawing("|--[A]--+--[B]--{MOV C\n"
                                     "        +--[/D]--(E)\n"
                                     "|--[@F]--{CNT G}--(H)\n"
                                     "|--[I]---{R    }\n");
  EXPECT_EQ(broken.errors(), "4:17 unclosed-element\n");
  EXPECT_EQ(dumpRung(broken.ladder.rungs.at(0)), "rung 3-7 bad\n"
                                                 "e0 [A] n0 -> n1\n"
                                                 "e1 [B] n1 -> n2\n"
                                                 "e2 unread n2 -> .\n"
                                                 "e3 [/D] n1 -> n3\n"
                                                 "e4 (E) n3 -> .\n"
                                                 "e5 [@F] n0 -> n4\n"
                                                 "e6 {CNT G} n4 R=n5 -> n6\n"
                                                 "e7 (H) n6 -> .\n"
                                                 "e8 [I] n0 -> n5\n");
}

} // namespace
} // namespace rung::frontend::ladder

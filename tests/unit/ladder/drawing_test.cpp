// Drawings and the nets and elements that they mean.
#include <gtest/gtest.h>

#include "ladder_testing.h"

namespace rung::frontend::ladder {
namespace {

TEST(Drawing, Latch) {
  EXPECT_EQ(elementsOf(R"(|--[START]--+--[/STOP]--(MOTOR)
|--[MOTOR]--+
)"),
            R"(e0 [START] n0 -> n1
e1 [MOTOR] n0 -> n1
e2 [/STOP] n1 -> n2
e3 (MOTOR) n2 -> .
)");
}

TEST(Drawing, InnerBranchAndSet) {
  EXPECT_EQ(elementsOf(R"(|--[A]--+--[B]--+--[@C]--(S LATCH)
        +--[/D]-+
)"),
            R"(e0 [A] n0 -> n1
e1 [B] n1 -> n2
e2 [/D] n1 -> n2
e3 [@C] n2 -> n3
e4 (S LATCH) n3 -> .
)");
}

TEST(Drawing, TwoOutputs) {
  EXPECT_EQ(elementsOf(R"(|--[A]--+--(X)
        +--[B]--(R Y)
)"),
            R"(e0 [A] n0 -> n1
e1 (X) n1 -> .
e2 [B] n1 -> n2
e3 (R Y) n2 -> .
)");
}

// The right rail adds nothing; lines that do not reach it have it alone.
TEST(Drawing, RightRail) {
  const char* expected = "e0 [A] n0 -> n1\ne1 [B] n0 -> n1\ne2 (X) n1 -> .\ne3 [C] n0 -> n2\ne4 {MOV D E} n2 -> .\n";
  EXPECT_EQ(elementsOf("|--[A]--+--(X)\n|--[B]--+\n|\n|--[C]--{MOV D E}\n"), expected);
  EXPECT_EQ(elementsOf("|--[A]--+--(X)------|\n"
                       "|--[B]--+           |\n"
                       "|                   |\n"
                       "|--[C]--{MOV D E}---|\n"),
            expected);
  EXPECT_EQ(elementsOf("|--[A]--+--(X)|\n|--[B]--+\n|\n|--[C]--{MOV D E}|\n"), expected) << "need not be straight";
}

TEST(Drawing, BoxWithOutput) {
  EXPECT_EQ(elementsOf("|--[EN]--{TOND T_WARM #500 #0}--(WARM)\n"),
            "e0 [EN] n0 -> n1\ne1 {TOND T_WARM #500 #0} n1 -> n2\ne2 (WARM) n2 -> .\n");
}

constexpr const char* kCounter = R"(|--[CLK]---{CNT PARTS #0 #10 #10}--(FULL)
|--[DOWN]--{U/D                 }
|--[CLEAR]-{R                   }
)";

TEST(Drawing, BoxWithSeveralPins) {
  const char* expected = R"(e0 [CLK] n0 -> n1
e1 [DOWN] n0 -> n2
e2 [CLEAR] n0 -> n3
e3 {CNT PARTS #0 #10 #10} n1 U/D=n2 R=n3 -> n4
e4 (FULL) n4 -> .
)";
  EXPECT_EQ(elementsOf(kCounter), expected);
  EXPECT_EQ(elementsOf(kCounter, {}), expected);
}

TEST(Drawing, PinLinesNeedNotBePadded) {
  EXPECT_EQ(elementsOf("|--[A]--{CNT C #0}--(F)\n|--[B]--{u/d}\n|--[C]--{R}\n"),
            "e0 [A] n0 -> n1\ne1 [B] n0 -> n2\ne2 [C] n0 -> n3\ne3 {CNT C #0} n1 u/d=n2 R=n3 -> n4\ne4 (F) n4 -> .\n");
}

TEST(Drawing, PinLineWithUnknownNameIsTheDialectsBusiness) {
  EXPECT_EQ(elementsOf("|--[A]--{CNT C #0}--(F)\n|--[B]--{UP}\n"),
            "e0 [A] n0 -> n1\ne1 [B] n0 -> n2\ne2 {CNT C #0} n1 UP=n2 -> n3\ne3 (F) n3 -> .\n");
}

TEST(Drawing, BoxesBelowEachOtherAreApartWhenTheTableSaysSo) {
  const char* drawing = "|--[A]--+--{MOV A B}\n        +--{RET}\n";
  EXPECT_EQ(elementsOf(drawing), "e0 [A] n0 -> n1\ne1 {MOV A B} n1 -> .\ne2 {RET} n1 -> .\n");
  // Without a table a box of one word exactly below another is its pin.
  EXPECT_EQ(elementsOf(drawing, {}), "e0 [A] n0 -> n1\ne1 {MOV A B} n1 RET=n1 -> .\n");
}

TEST(Drawing, BoxWithAllItsPinsIsFollowedByAnother) {
  EXPECT_EQ(elementsOf(R"(|--[A]--{CNT C}--(F)
|--[B]--{U/D  }
|--[C]--{R    }
|--[D]--{RET}
)"),
            R"(e0 [A] n0 -> n1
e1 [B] n0 -> n2
e2 [C] n0 -> n3
e3 {CNT C} n1 U/D=n2 R=n3 -> n4
e4 (F) n4 -> .
e5 [D] n0 -> n5
e6 {RET} n5 -> .
)");
}

TEST(Drawing, TwoBoxesWithPinsSideBySide) {
  EXPECT_EQ(elementsOf(R"(|--[A]--{CNT C}--+--{CNT D}--(F)
|--[B]--{U/D  }  +--{U/D  }
|--[C]--{R    }  +--{R    }
)"),
            R"(e0 [A] n0 -> n1
e1 [B] n0 -> n2
e2 [C] n0 -> n3
e3 {CNT C} n1 U/D=n2 R=n3 -> n4
e4 {CNT D} n4 U/D=n4 R=n4 -> n5
e5 (F) n5 -> .
)");
}

TEST(Drawing, OutputOfABoxBranchesBesideItsPins) {
  EXPECT_EQ(elementsOf(R"(|--[A]--{CNT C}--+--(F)
|--[B]--{U/D  }  |
|--[C]--{R    }  +--(G)
)"),
            R"(e0 [A] n0 -> n1
e1 [B] n0 -> n2
e2 [C] n0 -> n3
e3 {CNT C} n1 U/D=n2 R=n3 -> n4
e4 (F) n4 -> .
e5 (G) n4 -> .
)");
}

TEST(Drawing, VerticalWireOverLinesInBetween) {
  EXPECT_EQ(elementsOf(R"(|--[A]--+--[B]------+--(X)
|       |           |
|       +--[C]--[D]-+
)"),
            R"(e0 [A] n0 -> n1
e1 [B] n1 -> n2
e2 [C] n1 -> n3
e3 [D] n3 -> n2
e4 (X) n2 -> .
)");
}

TEST(Drawing, LonePlusPassesOnLikeABar) {
  EXPECT_EQ(elementsOf("|--[A]--+--(X)\n        +\n        +--(Y)\n"),
            "e0 [A] n0 -> n1\ne1 (X) n1 -> .\ne2 (Y) n1 -> .\n");
}

TEST(Drawing, WiresInOtherColumnsStayApart) {
  EXPECT_EQ(
      elementsOf("|--[A]--+--[B]--(X)\n|--[C]-------+--(Y)\n             +--(Z)\n|--[D]--+--(V)\n        +--(W)\n"),
      R"(e0 [A] n0 -> n1
e1 [B] n1 -> n2
e2 (X) n2 -> .
e3 [C] n0 -> n3
e4 (Y) n3 -> .
e5 (Z) n3 -> .
e6 [D] n0 -> n4
e7 (V) n4 -> .
e8 (W) n4 -> .
)");
}

TEST(Drawing, BridgeIsLegal) {
  EXPECT_EQ(elementsOf(R"(|--[A]--+--[B]-----------+--(X)
|       +--[E]--+        |
|--[C]----------+--[D]---+
)"),
            R"(e0 [A] n0 -> n1
e1 [B] n1 -> n2
e2 [E] n1 -> n3
e3 [C] n0 -> n3
e4 [D] n3 -> n2
e5 (X) n2 -> .
)");
}

TEST(Drawing, ReadyElementsOfUpperLinesGoFirst) {
  EXPECT_EQ(elementsOf("|--[A]------------(X)\n|--[B]--(Y)\n"),
            "e0 [A] n0 -> n1\ne1 (X) n1 -> .\ne2 [B] n0 -> n2\ne3 (Y) n2 -> .\n");
  // X waits for the lower line, but not longer than it must.
  EXPECT_EQ(elementsOf("|--[A]-----------+--(X)\n|--[B]--[C]--+---+\n             +--(Y)\n"),
            "e0 [A] n0 -> n1\ne1 [B] n0 -> n2\ne2 [C] n2 -> n1\ne3 (X) n1 -> .\ne4 (Y) n1 -> .\n");
}

TEST(Drawing, RailFeedsABranchThroughPlus) {
  EXPECT_EQ(elementsOf("|--+--[A]--+--(X)\n|  +--[B]--+\n"), "e0 [A] n0 -> n1\ne1 [B] n0 -> n1\ne2 (X) n1 -> .\n");
  EXPECT_EQ(elementsOf("|--[A]--(X)\n+--[B]--(Y)\n|--[C]--(Z)\n"),
            "e0 [A] n0 -> n1\ne1 (X) n1 -> .\ne2 [B] n0 -> n2\ne3 (Y) n2 -> .\ne4 [C] n0 -> n3\ne5 (Z) n3 -> .\n");
}

TEST(Drawing, ElementsMayTouch) {
  EXPECT_EQ(elementsOf("|[A][B](X)\n"), "e0 [A] n0 -> n1\ne1 [B] n1 -> n2\ne2 (X) n2 -> .\n");
  EXPECT_EQ(elementsOf("|{END}\n"), "e0 {END} n0 -> .\n");
}

TEST(Drawing, ElementForms) {
  EXPECT_EQ(elementsOf("|--[ A ]--[/ B]--[/%C]--[%D]--[!E]--[@!F]--[G,#-1]--( X )\n"),
            R"(e0 [A] n0 -> n1
e1 [/B] n1 -> n2
e2 [/%C] n2 -> n3
e3 [%D] n3 -> n4
e4 [!E] n4 -> n5
e5 [@!F] n5 -> n6
e6 [G,#-1] n6 -> n7
e7 (X) n7 -> .
)");
}

TEST(Drawing, BlankTellsAResetFromACoil) {
  const Parsed parsed =
      parseDrawing("|--[A]--+--(R R10.0)\n        +--(R10.0)\n        +--(R)\n        +--(S  S)\n        +--(/!Q)\n");
  ASSERT_EQ(parsed.errors(), "");
  const Rung& rung = parsed.ladder.rungs[0];
  const auto coil = [&](size_t i) { return std::pair(rung.elements[i].coil, rung.operandOf(rung.elements[i]).text); };
  EXPECT_EQ(coil(1), std::pair(CoilKind::Reset, std::string_view("R10.0")));
  EXPECT_EQ(coil(2), std::pair(CoilKind::Plain, std::string_view("R10.0")));
  EXPECT_EQ(coil(3), std::pair(CoilKind::Plain, std::string_view("R")));
  EXPECT_EQ(coil(4), std::pair(CoilKind::Set, std::string_view("S")));
  EXPECT_EQ(coil(5), std::pair(CoilKind::Negated, std::string_view("!Q")));
}

TEST(Drawing, BoxOperandsMayBeTexts) {
  const Parsed parsed = parseDrawing("|--[A]--{ MSG #1 \"a } ; {#0:F0} \u4E2D\"  W }--(X) ; remark\n");
  ASSERT_EQ(parsed.errors(), "");
  EXPECT_EQ(dumpRung(parsed.ladder.rungs[0]),
            "rung 3-4\ne0 [A] n0 -> n1\ne1 {MSG #1 \"a } ; {#0:F0} \u4E2D\" W} n1 -> n2\n"
            "e2 (X) n2 -> .\n; remark\n");
}

TEST(Drawing, ColumnsCountCharacters) {
  EXPECT_EQ(
      elementsOf("|--[A]--{M \"\u4E2D\u00E9\"}--+--(X)\n|--[B]--{M \"ab\"}--+\n"),
      "e0 [A] n0 -> n1\ne1 {M \"\u4E2D\u00E9\"} n1 -> n2\ne2 [B] n0 -> n3\ne3 {M \"ab\"} n3 -> n2\ne4 (X) n2 -> .\n");
}

TEST(Drawing, MnemonicsMayLookLikeWires) {
  EXPECT_EQ(elementsOf("|--[A]--{+F D A B}\n|--[B]--{-F D A B}\n|--[C]--{/F D A B}\n"),
            "e0 [A] n0 -> n1\ne1 {+F D A B} n1 -> .\ne2 [B] n0 -> n2\ne3 {-F D A B} n2 -> .\ne4 [C] n0 -> n3\ne5 {/F D "
            "A B} n3 -> .\n");
}

TEST(Drawing, CommentsAfterLinesAreKept) {
  EXPECT_EQ(elementsOf("|--[A]--+--(X) ;  first  \n        |    ; of nothing\n        +--[B]--(Y)\n"),
            "e0 [A] n0 -> n1\ne1 (X) n1 -> .\ne2 [B] n1 -> n2\ne3 (Y) n2 -> .\n; first\n; of nothing\n");
  EXPECT_EQ(elementsOf("|--[A]--{CNT C}\n|--[B]--{U/D  } ; pin\n|--[C]--{R    }\n"),
            "e0 [A] n0 -> n1\ne1 [B] n0 -> n2\ne2 [C] n0 -> n3\ne3 {CNT C} n1 U/D=n2 R=n3 -> .\n; pin\n");
}

TEST(Drawing, NothingOnTheRightIsNoOutput) {
  const Parsed parsed = parseDrawing("|--[A]\n");
  EXPECT_EQ(parsed.errors(), "");
  EXPECT_FALSE(parsed.ladder.rungs.at(0).elements.at(0).output.valid());
}

TEST(Drawing, DriversAndConsumersOfNets) {
  const Parsed parsed = parseDrawing(kCounter);
  const Rung& rung = parsed.ladder.rungs.at(0);
  EXPECT_TRUE(rung.driversOf(kRail).empty());
  const auto consumers = rung.consumersOf(kRail);
  EXPECT_EQ(std::vector<ElementId>(consumers.begin(), consumers.end()),
            (std::vector{ElementId{0}, ElementId{1}, ElementId{2}}));
  const Element& box = rung.elements[3];
  for (const Pin& pin : rung.pinsOf(box)) {
    ASSERT_EQ(rung.driversOf(pin.input).size(), 1u);
    ASSERT_EQ(rung.consumersOf(pin.input).size(), 1u);
    EXPECT_EQ(rung.consumersOf(pin.input)[0], ElementId{3});
  }
  EXPECT_EQ(rung.driversOf(box.output)[0], ElementId{3});
}

TEST(Drawing, PlacesOfElementsOperandsAndPins) {
  const Parsed parsed = parseDrawing(kCounter);
  const Rung& rung = parsed.ladder.rungs.at(0);
  const auto at = [&](SourceRange range) {
    const LineCol place = parsed.sources.lineCol(range.begin);
    return std::to_string(place.line) + ":" + std::to_string(place.column) + " " +
           std::string(parsed.sources.text(range));
  };
  const Element& box = rung.elements[3];
  EXPECT_EQ(at(box.range), "4:12 {CNT PARTS #0 #10 #10}");
  EXPECT_EQ(box.line, 4u);
  EXPECT_EQ(box.column, 12u);
  EXPECT_EQ(at(box.mnemonicRange), "4:13 CNT");
  EXPECT_EQ(at(rung.operandsOf(box)[1].range), "4:23 #0");
  EXPECT_EQ(at(rung.pinsOf(box)[2].range), "6:12 {R                   }");
  EXPECT_EQ(at(rung.operandOf(rung.elements[0]).range), "4:5 CLK");
}

} // namespace
} // namespace rung::frontend::ladder

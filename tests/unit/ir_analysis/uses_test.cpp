// What rungs use, and what decides whether they run.
#include "ir/analysis/uses.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "ir/text/text.h"

namespace rung::ir {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr const char* kHead = R"(module "t" dialect "gsk"
space X unit 1 units 8 input
space D unit 4 units 10
space @X2 unit 1 units 8 hidden
slot $0 bit init 0 transient "RLO"
slot $1 bit init 0 "edge"
fault F
)";

std::string rung(int number, const std::string& ops, const std::string& transfer = "}") {
  return "  rung " + std::to_string(number) + " \"\" loc(-:0:0-0) key(0x0000000000000001) weight 1 {\n" + ops + "  " +
         transfer + "\n";
}

Module moduleOf(const std::string& text) {
  ParseOutcome outcome = parse(kHead + text);
  EXPECT_TRUE(outcome.module) << outcome.error.line << ": " << outcome.error.message;
  return outcome.module ? std::move(*outcome.module) : Module{};
}

// Routine R of rungs that end in these transfers; %0 is a bit.
Uses flowOf(const std::vector<std::string>& transfers) {
  std::string text = "routine R {\n";
  int number = 0;
  for (const std::string& transfer : transfers) text += rung(number++, "    %0:bit = load X[0.0]\n", transfer);
  return Uses(moduleOf(text + "}\nroutine S {\n" + rung(0, "") + "}\n"));
}

BitRange bits(uint32_t space, uint32_t first, uint32_t count) { return {SpaceId{space}, first, count}; }

TEST(Uses, EachUseOnceInOrder) {
  const Uses uses(moduleOf("routine R {\n" +
                           rung(0, "    %0:bit = load X[1.2]\n    %1:bit = load X[1.2]\n    %2:i16 = load D[3]\n"
                                   "    store.i16 D[4], %2\n    store.bit X[1.2], %0\n") +
                           "}\n"));
  ASSERT_EQ(uses.rungCount(), 1u);
  EXPECT_THAT(uses.of(0),
              ElementsAre(Use{bits(0, 10, 1), Type::Bit, false, false}, Use{bits(1, 96, 16), Type::I16, false, false},
                          Use{bits(1, 128, 16), Type::I16, true, false}, Use{bits(0, 10, 1), Type::Bit, true, false}));
}

TEST(Uses, BitsThatNeverChangeAreReadWithoutAnOperation) {
  const Uses uses(moduleOf("routine R {\n" +
                           rung(0, "    reads X[1.2]\n    reads X[1.2]\n    reads D[3.17]\n    %0:bit = const 1\n"
                                   "    store.bit X[0.0], %0\n") +
                           "}\n"));
  EXPECT_THAT(uses.of(0),
              ElementsAre(Use{bits(0, 10, 1), Type::Bit, false, false}, Use{bits(1, 113, 1), Type::Bit, false, false},
                          Use{bits(0, 0, 1), Type::Bit, true, false}));
}

// A coil that sets its bit depends on nothing that it finds there; a contact of the same rung does.
TEST(Uses, WhatAConditionalWritePutsBackIsKept) {
  const std::string set = "    %0:bit = load X[0.0]\n    %1:bit = const 1\n    %2:bit = load X[1.2]\n"
                          "    %3:bit = select.bit %0, %1, %2\n    store.bit X[1.2], %3\n";
  const auto keptOf = [](const std::string& ops) {
    const Uses uses(moduleOf("routine R {\n" + rung(0, ops) + "}\n"));
    std::vector<bool> kept;
    for (const RungUse& use : uses.of(0))
      if (!use.writes) kept.push_back(use.keeps);
    return kept;
  };
  EXPECT_THAT(keptOf(set), ElementsAre(false, true));
  EXPECT_THAT(keptOf(set + "    %4:bit = load X[1.2]\n    store.bit X[1.3], %4\n"), ElementsAre(false, false));
  EXPECT_THAT(keptOf("    %0:bit = load X[0.0]\n    %1:bit = const 1\n    %2:bit = select.bit %0, %1, %0\n"
                     "    store.bit X[0.0], %2\n"),
              ElementsAre(false))
      << "the value itself decides";
  EXPECT_THAT(keptOf("    %0:bit = load X[0.0]\n    %1:bit = const 1\n    %2:bit = load X[1.2]\n"
                     "    %3:bit = select.bit %0, %1, %2\n    store.bit X[1.3], %3\n"),
              ElementsAre(false, false))
      << "it goes elsewhere";
}

TEST(Uses, WhereAnIndexIsAddedTo) {
  const Uses uses(moduleOf("routine R {\n" +
                           rung(0, "    %0:i32 = load D[0]\n    %1:i32 = const 3\n    %2:i32 = add %0, %1\n"
                                   "    %3:i32 = load_at D[1 count 9], %2\n    %4:i32 = load_at D[1 count 9], %0\n"
                                   "    %5:i32 = const 7\n    %6:bit = load_bit_at D[1 count 9], %2, %5\n") +
                           "}\n"));
  std::vector<BitRange> elements;
  for (const RungUse& use : uses.of(0)) elements.push_back(use.element);
  EXPECT_THAT(elements, ElementsAre(bits(1, 0, 32), bits(1, 128, 32), bits(1, 32, 288), bits(1, 135, 1)));
}

TEST(Uses, AWindowReachesAllItsElements) {
  const Uses uses(
      moduleOf("routine R {\n" +
               rung(0, "    %0:i32 = const 3\n    %1:i32 = load_at D[2 count 5], %0\n"
                       "    store_at.i32 D[8 count 2], %0, %1\n    %2:bit = load_bit_at D[0 count 1], %0, %1\n") +
               "}\n"));
  EXPECT_THAT(uses.of(0),
              ElementsAre(Use{bits(1, 64, 160), Type::I32, false, true}, Use{bits(1, 256, 64), Type::I32, true, true},
                          Use{bits(1, 0, 32), Type::Bit, false, true}));
}

TEST(Uses, WritersOverlapTheirPlace) {
  const Uses uses(moduleOf("routine R {\n" + rung(0, "    %0:bit = load X[0.0]\n    store.bit D[0.5], %0\n") +
                           rung(1, "    %0:i32 = load D[0]\n    store.i32 D[1], %0\n") +
                           rung(2, "    %0:i32 = load D[0]\n    store_at.i32 D[0 count 10], %0, %0\n") + "}\n"));
  EXPECT_THAT(uses.writersOf(bits(1, 0, 32)).certain, ElementsAre(0u));
  EXPECT_THAT(uses.writersOf(bits(1, 0, 32)).computed, ElementsAre(2u));
  EXPECT_THAT(uses.writersOf(bits(1, 4, 1)).certain, IsEmpty());
  EXPECT_THAT(uses.writersOf(bits(1, 40, 1)).certain, ElementsAre(1u));
  EXPECT_TRUE(uses.writersOf(bits(0, 0, 1)).none());
}

TEST(Uses, CopiesLeadBackToTheirSource) {
  const Uses uses(
      moduleOf("routine R {\n" + rung(0, "") +
               "}\ntask T entry R period 0 budget 9 fault F parts 1 {\n  begin X[2] -> @X2[4] size 2\n}\n"));
  EXPECT_THAT(uses.copiedFrom(bits(2, 4 * 8 + 3, 1)), ElementsAre(bits(0, 2 * 8 + 3, 1)));
  EXPECT_THAT(uses.copiedFrom(bits(2, 5 * 8, 32)), ElementsAre(bits(0, 3 * 8, 8)));
  EXPECT_THAT(uses.copiedFrom(bits(2, 0, 8)), IsEmpty());
  EXPECT_THAT(uses.copiedFrom(bits(0, 16, 8)), IsEmpty());
  EXPECT_EQ(uses.copiedWhole(bits(0, 2 * 8 + 3, 1)), bits(2, 4 * 8 + 3, 1));
  EXPECT_EQ(uses.copiedWhole(bits(0, 3 * 8, 16)), std::nullopt) << "only its first half";
  EXPECT_EQ(uses.copiedWhole(bits(2, 4 * 8, 8)), std::nullopt) << "it is a copy";
}

TEST(Uses, JumpsOverARungAndReturnsAheadOfItDecide) {
  const Uses uses = flowOf({"} goto 3 if %0", "} goto 2 if %0", "}", "} ret if %0", "}"});
  EXPECT_THAT(uses.decidersOf(4), ElementsAre(3u));
  EXPECT_THAT(uses.decidersOf(2), ElementsAre(0u)) << "a jump to the rung itself passes only others by";
  EXPECT_THAT(uses.decidersOf(1), ElementsAre(0u));
  EXPECT_THAT(uses.decidersOf(0), IsEmpty());
}

TEST(Uses, LoopsAreNotDecisions) {
  const Uses uses = flowOf({"}", "} goto 0 if %0", "}"});
  EXPECT_THAT(uses.decidersOf(2), IsEmpty());
}

TEST(Uses, WhereNothingFallsThroughTheJumpsDecide) {
  const Uses uses = flowOf({"} goto 3 if %0", "} end", "}", "}", "} goto 2 if %0"});
  EXPECT_THAT(uses.decidersOf(3), ElementsAre(0u, 4u));
  EXPECT_THAT(uses.decidersOf(2), ElementsAre(4u));
}

TEST(Uses, ASwitchDecides) {
  const Uses uses(moduleOf("routine R {\n" + rung(0, "    %0:i32 = load D[0]\n", "} switch %0 [1, 2]") + rung(1, "") +
                           rung(2, "") + "}\n"));
  EXPECT_THAT(uses.decidersOf(2), ElementsAre(0u));
}

TEST(Uses, Callers) {
  const Uses uses = flowOf({"} call S if %0", "}", "} call S"});
  EXPECT_THAT(uses.callersOf(3), ElementsAre(0u, 2u));
  EXPECT_THAT(uses.callersOf(1), IsEmpty());
  EXPECT_TRUE(uses.calls(0));
  EXPECT_FALSE(uses.calls(1));
}

} // namespace
} // namespace rung::ir

// The cut of a routine into parts: pieces, the lightest heaviest part, borders near to their shares.
#include "ir/core/parts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "ir/core/builder.h"

namespace rung::ir {
namespace {

using Borders = std::vector<uint32_t>;

std::vector<PartPiece> piecesOf(const std::vector<uint64_t>& weights) {
  std::vector<PartPiece> pieces;
  for (uint64_t weight : weights) pieces.push_back({static_cast<uint32_t>(pieces.size()), weight});
  return pieces;
}

uint64_t heaviestOf(const std::vector<uint64_t>& weights, const Borders& borders) {
  uint64_t most = 0;
  uint64_t sum = 0;
  for (uint32_t i = 0; i < weights.size(); ++i) {
    if (std::find(borders.begin(), borders.end(), i) != borders.end()) sum = 0;
    sum += weights[i];
    most = std::max(most, sum);
  }
  return most;
}

// Tries every partition.
uint64_t bestCut(const std::vector<uint64_t>& weights, uint32_t parts, uint32_t first, Borders& borders) {
  if (parts == 1) return heaviestOf(weights, borders);
  uint64_t best = UINT64_MAX;
  for (uint32_t i = first; i + parts - 1 <= weights.size(); ++i) {
    borders.push_back(i);
    best = std::min(best, bestCut(weights, parts - 1, i + 1, borders));
    borders.pop_back();
  }
  return best;
}

TEST(Parts, EqualPiecesAreSharedEvenly) {
  EXPECT_EQ(cutParts(piecesOf({2, 2}), 2), Borders{1});
  EXPECT_EQ(cutParts(piecesOf({2, 3}), 2), Borders{1});
  EXPECT_EQ(cutParts(piecesOf({2, 2, 2, 3}), 2), Borders{2});
  EXPECT_EQ(cutParts(piecesOf({5, 5, 5, 5, 5, 5}), 3), (Borders{2, 4}));
  EXPECT_EQ(cutParts(piecesOf({2, 2, 2}), 2), Borders{2});
}

TEST(Parts, OneHeavyPieceStandsAlone) {
  EXPECT_EQ(cutParts(piecesOf({1, 1, 100, 1, 1}), 3), (Borders{2, 3}));
  EXPECT_EQ(cutParts(piecesOf({100, 1, 1, 1}), 4), (Borders{1, 2, 3}));
  EXPECT_EQ(cutParts(piecesOf({1, 1, 1, 100}), 2), Borders{3});
}

TEST(Parts, MorePartsThanPieces) {
  EXPECT_EQ(cutParts(piecesOf({4, 1, 1}), 9), (Borders{1, 2}));
  EXPECT_EQ(cutParts(piecesOf({4}), 3), Borders{});
  EXPECT_EQ(longestPart(piecesOf({4, 1, 1}), 9), 4u);
}

TEST(Parts, AsManyAsNeeded) {
  EXPECT_EQ(partsNeeded(piecesOf({2, 2, 2, 2}), 8), 1u);
  EXPECT_EQ(partsNeeded(piecesOf({2, 2, 2, 2}), 7), 2u);
  EXPECT_EQ(partsNeeded(piecesOf({2, 2, 2, 2}), 3), 4u);
  EXPECT_EQ(partsNeeded(piecesOf({2, 2, 2, 2}), 2), 4u);
  EXPECT_EQ(partsNeeded(piecesOf({2, 3, 2}), 2), 0u);
}

TEST(Parts, NoCutHasALighterHeaviestPart) {
  std::mt19937 random(7);
  for (int round = 0; round < 500; ++round) {
    std::vector<uint64_t> weights(2 + random() % 8);
    for (uint64_t& weight : weights) weight = 1 + random() % 9;
    const uint32_t parts = 2 + static_cast<uint32_t>(random() % (weights.size() - 1));
    const Borders borders = cutParts(piecesOf(weights), parts);
    ASSERT_EQ(borders.size(), parts - 1);
    ASSERT_TRUE(std::is_sorted(borders.begin(), borders.end()));
    Borders tried;
    const uint64_t best = bestCut(weights, parts, 1, tried);
    ASSERT_EQ(heaviestOf(weights, borders), best);
    ASSERT_EQ(longestPart(piecesOf(weights), parts), best);
    ASSERT_LE(partsNeeded(piecesOf(weights), best), parts);
  }
}

TEST(Parts, PiecesAreRungsOfTheSourceWithWhatTheyCall) {
  Module module;
  module.files = {"a"};
  const auto rung = [](uint32_t line, uint32_t weight) {
    Rung made;
    made.begin = {FileIndex{0}, line, 1};
    made.weight = weight;
    return made;
  };
  Routine sub{"P1", {rung(20, 4), rung(21, 3)}};
  Routine main{"L2", {rung(1, 1), rung(1, 2), rung(2, 3), rung(2, 1), rung(3, 2), rung(9, 1)}};
  main.rungs[2].transfer = {.kind = TransferKind::Call, .callee = RoutineId{1}};
  module.routines = {main, sub};
  for (Rung& r : module.routines[0].rungs)
    if (r.begin.line == 3) RungBuilder(module, r).i32(0);
  const std::vector<PartPiece> pieces = partPieces(module, RoutineId{0});
  ASSERT_EQ(pieces.size(), 3u);
  EXPECT_EQ(pieces[0].firstRung, 0u);
  EXPECT_EQ(pieces[0].weight, 2u); // the compiler's rung takes no time of its own
  EXPECT_EQ(pieces[1].firstRung, 2u);
  EXPECT_EQ(pieces[1].weight, 10u);
  EXPECT_EQ(pieces[2].firstRung, 4u);
  EXPECT_EQ(pieces[2].weight, 3u); // with the closing rung
}

} // namespace
} // namespace rung::ir

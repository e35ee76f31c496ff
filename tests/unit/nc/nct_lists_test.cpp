// The lists of NCT's services: complete, and what each says of its blocks and codes.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "rtlib/nc/nct/axis_codes.h"
#include "rtlib/nc/nct/operand_block.h"
#include "rtlib/nc/nct/scope_symbols.h"
#include "rtlib/nc/nct/service_functions.h"
#include "rtlib/nc/nct/windows.h"

namespace rung::nc::nct {
namespace {

TEST(NctServiceFunctions, AreThoseOfTheManual) {
  std::vector<uint16_t> reads, writes;
  for (const ServiceFunction& f : serviceFunctions())
    (f.access == FunctionAccess::Read ? reads : writes).push_back(f.code);
  std::ranges::sort(reads);
  std::ranges::sort(writes);
  EXPECT_EQ(reads, (std::vector<uint16_t>{10, 31, 32, 62, 101, 104, 107, 108, 201, 304, 307, 308, 309}));
  EXPECT_EQ(writes, (std::vector<uint16_t>{11, 34,  35,  40,  41,  60,  61,  63,  70,  81,
                                           90, 100, 102, 103, 105, 106, 202, 300, 303, 306}));
  EXPECT_EQ(findServiceFunction(12), nullptr);
  EXPECT_EQ(findServiceFunction(-10), nullptr);
  EXPECT_EQ(findServiceFunction(65536 + 10), nullptr);
}

TEST(NctServiceFunctions, CodesHaveAMeaning) {
  for (const ServiceFunction& f : serviceFunctions()) {
    for (uint32_t code = 0; code < 400; ++code)
      if (f.hasCode(code)) {
        EXPECT_NE(findExecutionCode(code), nullptr) << f.code << ": " << code;
      }
    for (const uint32_t always : {kExecuted, kBadFunction, kBadAmount}) EXPECT_TRUE(f.hasCode(always)) << f.code;
    EXPECT_EQ(f.hasCode(400), false) << f.code;
  }
  EXPECT_EQ(findExecutionCode(5), nullptr);
  EXPECT_EQ(findExecutionCode(342)->meaning, "working space is empty");
}

// The amount counts the words behind word 1, so the last one is amount + 1; MR 62 and MW 63 print one word more than
// their largest amount (l.4029, l.4075), which is why 6 is allowed.
TEST(NctServiceFunctions, AmountsReachTheirWords) {
  for (const ServiceFunction& f : serviceFunctions()) {
    uint32_t most = 0;
    for (uint32_t amount = 0; amount < 2 * kBlockWords; ++amount)
      if (f.allowsAmount(amount)) most = amount;
    EXPECT_EQ(most + 1, f.words.back().last) << f.code;
    EXPECT_FALSE(f.allowsAmount(0)) << f.code;
    EXPECT_FALSE(f.allowsAmount(-1)) << f.code;
    EXPECT_LT(most, kBlockWords - 1) << f.code;
  }
}

// Only whole columns: F and user data 2 to 20 are doubles (l.4805).
TEST(NctServiceFunctions, RecordsEndWithWholeColumns) {
  const ServiceFunction& tool = *findServiceFunction(102);
  std::vector<int> amounts;
  for (int amount = 0; amount < 60; ++amount)
    if (tool.allowsAmount(amount)) amounts.push_back(amount);
  EXPECT_EQ(amounts, (std::vector<int>{3,  4,  5,  6,  7,  8,  9,  10, 11, 12, 13, 14, 16, 17, 19, 21, 23,
                                       25, 27, 29, 31, 33, 35, 37, 39, 41, 43, 45, 47, 49, 51, 53, 55}));
  const ServiceFunction& pallet = *findServiceFunction(303);
  amounts.clear();
  for (int amount = 0; amount < 60; ++amount)
    if (pallet.allowsAmount(amount)) amounts.push_back(amount);
  EXPECT_EQ(amounts, (std::vector<int>{3, 4, 5, 6, 7, 8, 10, 12, 14}));
}

TEST(NctOperandBlock, RemembersWhatWasAnswered) {
  std::vector<uint32_t> words(kBlockStride);
  words[1] = 3;
  Block block(words);
  EXPECT_EQ(block.amount(), 3);
  block.setReal(31, -12.5);
  block.setWord(kBlockWords - 1, -1);
  block.setWord(kBlockWords, 7); // nothing
  EXPECT_EQ(block.real(31), -12.5);
  EXPECT_EQ(block.word(kBlockWords - 1), -1);
  EXPECT_EQ(block.word(kBlockWords), 0);
  for (uint32_t n = 0; n <= kBlockWords; ++n)
    EXPECT_EQ(block.isAnswered(n), n == 31 || n == 32 || n == kBlockWords - 1) << n;
}

TEST(NctScopeSymbols, AreThoseOfTheManual) {
  EXPECT_EQ(scopeSymbols().size(), 46u);
  for (uint32_t i = 0; i < scopeSymbols().size(); ++i) EXPECT_EQ(findScopeSymbol(scopeSymbols()[i].name), i);
  EXPECT_EQ(findScopeSymbol("actposax"), findScopeSymbol("ActPosAx"));
  EXPECT_FALSE(findScopeSymbol("Position"));
  EXPECT_EQ(scopeSymbols()[*findScopeSymbol("DirectPlcDouble")].param1.maximum(4000), 3998);
  EXPECT_EQ(scopeSymbols()[*findScopeSymbol("PlcDouble")].param1.maximum(4000), 9998);
}

TEST(NctAxisCodes, OnlyFeedsNeedASpeed) {
  EXPECT_EQ(axisCodes().size(), 15u);
  for (const AxisCode& code : axisCodes()) EXPECT_EQ(code.needsSpeed(), code.code >= 2 && code.code <= 5);
}

TEST(NctWindows, GoByTheirIdentifiers) {
  EXPECT_EQ(screenWindows().size(), 40u);
  EXPECT_TRUE(findScreenWindow(1010)->hasViews);
  EXPECT_EQ(findScreenWindow(4030)->parameter2, "pocket number");
  EXPECT_EQ(findScreenWindow(6062)->line, 4203);
  EXPECT_EQ(findScreenWindow(101), nullptr);
}

} // namespace
} // namespace rung::nc::nct

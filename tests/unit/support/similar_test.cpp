// Which known word a misspelt one is like.
#include "rtlib/text/similar.h"

#include <gtest/gtest.h>

#include <initializer_list>

namespace rung {
namespace {

std::string_view best(std::string_view word, std::initializer_list<std::string_view> candidates) {
  return text::mostSimilar(word, candidates);
}

TEST(Similar, OneChange) {
  EXPECT_EQ(best("ADB", {"SUBB", "ADDB"}), "ADDB");   // one less
  EXPECT_EQ(best("ADDDB", {"SUBB", "ADDB"}), "ADDB"); // one more
  EXPECT_EQ(best("ADCB", {"SUBB", "ADDB"}), "ADDB");  // another
  EXPECT_EQ(best("DADB", {"SUBB", "ADDB"}), "ADDB");  // exchanged
  EXPECT_EQ(best("addb", {"ADDA", "ADDB"}), "ADDB");  // case counts as none
}

TEST(Similar, TwoChangesInLongerWordsOnly) {
  EXPECT_EQ(best("KEY_ATOU", {"KEY_AUTO"}), "KEY_AUTO");
  EXPECT_EQ(best("KEX_AUTA", {"KEY_AUTO"}), "KEY_AUTO");
  EXPECT_EQ(best("ABCD", {"ABXY"}), "");
}

TEST(Similar, TheClosestAndThenTheFirst) {
  EXPECT_EQ(best("MOVEX", {"MOVNY", "MOVE", "MOVEA"}), "MOVE");
  EXPECT_EQ(best("MOVX", {"MOVB", "MOVW"}), "MOVB");
}

TEST(Similar, NothingInCommonIsNoLikeness) {
  EXPECT_EQ(best("A", {"B"}), "");
  EXPECT_EQ(best("", {"A"}), "");
  EXPECT_EQ(best("LONGER_THAN_THIRTY_TWO_CHARACTERS_X", {"LONGER_THAN_THIRTY_TWO_CHARACTERS_Y"}), "");
  EXPECT_EQ(best("ANY", {}), "");
}

bool certain(std::string_view word, std::initializer_list<std::string_view> candidates) {
  return text::likeliest(word, candidates).certain;
}

TEST(Similar, SlipsOfTheHandAreCertain) {
  EXPECT_TRUE(certain("ready", {"READY"}));
  EXPECT_TRUE(certain("RAEDY", {"READY"}));
  EXPECT_TRUE(certain("ANDD", {"AND", "ANI", "OR"}));
  EXPECT_TRUE(certain("CLOSEDOR", {"CLOSEDOOR"}));
  EXPECT_TRUE(certain("PUMPRUN", {"PUMP_RUN"}));
}

TEST(Similar, WhatMayBeANameOfItsOwnIsNot) {
  EXPECT_FALSE(certain("VALVE_B", {"VALVE_A"}));
  EXPECT_FALSE(certain("PUMP2", {"PUMP1"}));
  EXPECT_FALSE(certain("PUMP_RUNS", {"PUMP_RUN"}));
  EXPECT_FALSE(certain("ANDN", {"AND"}));
  EXPECT_FALSE(certain("LS_AA", {"LS_A"}));
  EXPECT_FALSE(certain("LS_BA", {"LS_AB"}));
  EXPECT_FALSE(certain("LS_12", {"LS_21"}));
  EXPECT_FALSE(certain("K11", {"K1_1"}));
  EXPECT_FALSE(certain("ANY", {}));
}

TEST(Similar, NotOfTwoThatAreAsClose) {
  EXPECT_FALSE(certain("WRR", {"WR", "RR"}));
  EXPECT_FALSE(certain("WRR", {"RR", "WR"}));
  EXPECT_FALSE(certain("ready", {"READY", "Ready"}));
  EXPECT_TRUE(certain("ready", {"READY", "READ"}));
}

} // namespace
} // namespace rung

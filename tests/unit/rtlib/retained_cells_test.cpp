// Retained cells from one program to another: by name and by address; and descriptions, good and bad ones.
#include "rtlib/retain/retained_cells.h"

#include <zlib.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <random>

#include "rtlib/load/program_info.h"
#include "rtlib/retain/retained_memory.h"
#include "tests/unit/rtlib/test_program.h"

namespace {

using namespace rung::runtime;
using rung::test::TestProgram;
using testing::ElementsAre;
using testing::IsEmpty;
using Bytes = std::vector<uint8_t>;

// Space D with 16 bytes, of which bytes 4 to 11 are kept, and HEAP with 8, whose addresses the compiler gives out, all
// kept.
void build(TestProgram& test) {
  test.addPacked("D", 1, 16, 0);
  test.addPacked("HEAP", 1, 8, 16);
  test.spaces[1].flags = RUNG_SPACE_ALLOCATED;
  test.retains = {{4, 8}, {16, 8}};
  test.scan = {{RUNG_STEP_ADVANCE, RUNG_NONE, 1000}};
}

RetainLayout layoutOf(const std::function<void(TestProgram&)>& change) {
  TestProgram test;
  build(test);
  change(test);
  test.link();
  EXPECT_EQ(checkProgram(test.program), "");
  return RetainMap(test.program).layout();
}

std::vector<std::string> inWords(const std::vector<StateChange>& changes) {
  std::vector<std::string> out;
  for (const StateChange& c : changes)
    out.push_back(std::string(kChangeKinds[static_cast<size_t>(c.kind)]) + " " + c.formerName + " " + c.name);
  return out;
}

const Bytes kImage = {4, 5, 6, 7, 8, 9, 10, 11, 20, 21, 22, 23, 24, 25, 26, 27};
const Bytes kInitial(16, 99);

TEST(RetainedCells, TheSameCellsTakeAll) {
  const auto names = [](TestProgram& t) { t.addSymbol("COUNT", 0, 6, RUNG_TYPE_I16); };
  const RetainLayout cells = layoutOf(names);
  EXPECT_EQ(cells.hash, layoutOf(names).hash);
  const RetainedTaken taken = takeRetained(cells.description, cells.description, kImage, kInitial);
  EXPECT_THAT(taken.image, ElementsAre(4, 5, 6, 7, 8, 9, 10, 11, 99, 99, 99, 99, 99, 99, 99, 99))
      << "what has no name lies elsewhere in HEAP tomorrow";
  EXPECT_THAT(taken.changes, IsEmpty());
}

TEST(RetainedCells, NamesAndAddresses) {
  const RetainLayout former = layoutOf([](TestProgram& t) {
    t.addSymbol("COUNT", 0, 4, RUNG_TYPE_I16);
    t.addSymbol("GONE", 0, 8, RUNG_TYPE_I8);
    t.addSymbol("TYPED", 0, 9, RUNG_TYPE_I8);
    t.addSymbol("FLAG", 0, 10, RUNG_TYPE_BIT, 3);
    t.addSymbol("FIRST", 1, 0, RUNG_TYPE_I16);
    t.addSymbol("SECOND", 1, 2, RUNG_TYPE_I16);
    t.addSymbol("OUTSIDE", 0, 12, RUNG_TYPE_I8);
  });
  const RetainLayout now = layoutOf([](TestProgram& t) {
    t.addSymbol("COUNT", 0, 6, RUNG_TYPE_I16);
    t.addSymbol("TYPED", 0, 9, RUNG_TYPE_BIT);
    t.addSymbol("FLAG", 0, 10, RUNG_TYPE_BIT, 3);
    t.addSymbol("SECOND", 1, 0, RUNG_TYPE_I16);
    t.addSymbol("FIRST", 1, 4, RUNG_TYPE_I16);
    t.addSymbol("OUTSIDE", 0, 13, RUNG_TYPE_I8);
  });
  EXPECT_NE(former.hash, now.hash);
  const RetainedTaken taken = takeRetained(now.description, former.description, kImage, kInitial);
  EXPECT_THAT(taken.image, ElementsAre(99, 99, 4, 5, 8, 99, 10, 11,     // D4 to D11
                                       22, 23, 99, 99, 20, 21, 99, 99)) // HEAP
      << "of byte 9, the cell TYPED";
  EXPECT_THAT(inWords(taken.changes),
              ElementsAre("moved  COUNT", "moved  FIRST", "removed  GONE", "moved  SECOND", "retyped  TYPED"));
}

TEST(RetainedCells, TheDialectSaysHowNamesAreCompared) {
  const RetainLayout former = layoutOf([](TestProgram& t) { t.addSymbol("Count", 0, 4, RUNG_TYPE_I8); });
  const RetainLayout now = layoutOf([](TestProgram& t) { t.addSymbol("COUNT", 0, 11, RUNG_TYPE_I8); });
  const auto taken = [&](const Naming& naming) {
    return takeRetained(now.description, former.description, kImage, kInitial, naming);
  };
  EXPECT_EQ(taken({.ignoresCase = true}).image[7], 4);
  EXPECT_THAT(inWords(taken({.ignoresCase = true}).changes), ElementsAre("moved  COUNT"));
  EXPECT_THAT(inWords(taken({}).changes), ElementsAre("removed  Count"));
}

TEST(RetainedCells, WhatWasNotKeptStartsAnew) {
  const RetainLayout former = layoutOf([](TestProgram& t) { t.retains = {{6, 2}, {16, 8}}; });
  const RetainLayout now = layoutOf([](TestProgram&) {});
  const Bytes image = {6, 7, 20, 21, 22, 23, 24, 25, 26, 27};
  EXPECT_THAT(takeRetained(now.description, former.description, image, kInitial).image,
              ElementsAre(99, 99, 6, 7, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99));
  const Bytes initial(10, 98);
  const RetainedTaken smaller = takeRetained(former.description, now.description, kImage, initial);
  EXPECT_THAT(smaller.image, ElementsAre(6, 7, 98, 98, 98, 98, 98, 98, 98, 98));
  EXPECT_THAT(inWords(smaller.changes), ElementsAre("removed  D+4 to D+5", "removed  D+8 to D+11"));
}

TEST(RetainedCells, AnotherDialectAndAnotherSizeAreNotTaken) {
  const RetainLayout now = layoutOf([](TestProgram&) {});
  const RetainLayout other = layoutOf([](TestProgram& t) { t.dialect = "else"; });
  const RetainedTaken others = takeRetained(now.description, other.description, kImage, kInitial);
  EXPECT_THAT(others.image, IsEmpty());
  EXPECT_EQ(others.otherDialect, "else");
  EXPECT_THAT(takeRetained(now.description, now.description, Bytes(15), kInitial).image, IsEmpty());
}

// Whatever it is: nothing is taken, or an image of the size that it has to have.
TEST(RetainedCells, DamagedDescriptions) {
  const std::string good = layoutOf([](TestProgram& t) {
                             t.addSymbol("COUNT OF ALL", 0, 6, RUNG_TYPE_I16);
                             t.addSymbol("NOTE", 1, 0, RUNG_TYPE_TEXT, 0, 8);
                           }).description;
  const auto taken = [&](const std::string& former) { return takeRetained(good, former, kImage, kInitial).image; };
  EXPECT_EQ(taken(good).size(), kInitial.size());
  EXPECT_THAT(taken(""), IsEmpty());
  EXPECT_THAT(taken("abc"), IsEmpty());
  EXPECT_THAT(taken(std::string("\xFF\xFF\xFF\xFF", 4) + good.substr(4)), IsEmpty()) << "too long";
  std::mt19937 random(1);
  for (int i = 0; i < 20'000; ++i) {
    std::string bad = good;
    bad[random() % bad.size()] = static_cast<char>(random());
    if (random() % 4 == 0) bad.resize(random() % bad.size());
    const Bytes image = taken(bad);
    EXPECT_TRUE(image.empty() || image.size() == kInitial.size());
  }
}

// Compressed again, so that what is in it is looked at.
TEST(RetainedCells, DescriptionsThatDoNotHold) {
  const auto taken = [](const std::string& text) {
    std::string packed(4 + compressBound(text.size()), 0);
    uLongf length = packed.size() - 4;
    for (size_t i = 0; i < 4; ++i) packed[i] = static_cast<char>(text.size() >> (8 * i));
    compress(reinterpret_cast<Bytef*>(&packed[4]), &length, reinterpret_cast<const Bytef*>(text.data()), text.size());
    packed.resize(4 + length);
    return takeRetained(layoutOf([](TestProgram&) {}).description, packed, Bytes{1, 2}, kInitial).image.size();
  };
  const std::string good = "dialect\ttest\nspace\tD\t0\t6\nkept\t0\t4\t2\n";
  EXPECT_EQ(taken(good), 16u);
  EXPECT_EQ(taken(good + "cell\tA\t0\t4\t0\t3\t1\t2\n"), 16u);
  for (const char* bad :
       {"else\n", "kept\t1\t0\t0\n", "kept\t0\t6\t1\n", "kept\t0\t4294967295\t2\n", "kept\t0\t4\n", "kept\t0\tx\t0\n",
        "kept\t0\t0\t0\t0\n", "space\tE\t0\t4294967295\n", "cell\tA\t0\t0\t0\t2\t1\t2\n", "cell\tA\t0\t5\t0\t3\t1\t2\n",
        "cell\tA\t0\t4\t0\t9\t1\t2\n", "cell\tA\t0\t4\t0\t2\t0\t2\n", "cell\tA\t0\t4\t8\t1\t1\t2\n",
        "cell\tA\t0\t4\t1\t2\t1\t2\n", "cell\tA\t7\t4\t0\t2\t1\t2\n", "cell\tA\t0\t4\t0\t2\t4294967295\t2\n",
        "cell\tB\t0\t4\t0\t2\t1\t2\ncell\tA\t0\t4\t0\t2\t1\t2\n"})
    EXPECT_EQ(taken(good + bad), 0u) << bad;
}

} // namespace

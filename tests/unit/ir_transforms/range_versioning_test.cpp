// Versions of a rung, for numbers of the program or for small ones, and rungs that get none.
#include <gtest/gtest.h>

#include "ir/transforms/passes.h"
#include "ir/transforms/pipeline.h"
#include "tests/unit/ir_transforms/passes_testing.h"

namespace rung::ir {
namespace {

// As a dialect lowers a coil and a contact with an index: outside of what exists a flag is set.
constexpr const char* kRung = R"(%0:i32 = load D[0]
%1:i32 = const 10
%2:i32 = add %0, %1
%3:i32 = const 60
%4:bit = lt_u.i32 %2, %3
%5:i32 = const 3
%6:bit = load_bit_at D[1 count 60], %2, %5
%7:bit = and %4, %6
%8:bit = le_u.i32 %3, %2
%9:bit = load B[0.0]
%10:bit = or %9, %8
store.bit B[0.0], %10
store_bit_at.bit D[1 count 60], %2, %0, %7
note "a coil")";

TEST(RangeVersioning, SmallNumbers) {
  Module module = moduleOf(kRung, "} goto 2 if %7");
  runPasses(module, {.verifyEach = true});
  EXPECT_EQ(bodyOf(module), R"(%0:i32 = load D[0]
%1:i32 = const 31
%2:bit = le_u.i32 %0, %1
if mostly, %2
%3:i32 = const 3
%4:i32 = and %0, %1
%5:bit = load_bit_at D[11 count 32], %4, %3
store_bit_at.bit D[11 count 32], %4, %4, %5
else %5
%6:i32 = const 10
%7:i32 = add %0, %6
%8:i32 = const 60
%9:bit = lt_u.i32 %7, %8
%10:i32 = const 3
%11:bit = load_bit_at D[1 count 60], %7, %10
%12:bit = and %9, %11
%13:bit = le_u.i32 %8, %7
%14:bit = load B[0.0]
%15:bit = or %14, %13
store.bit B[0.0], %15
store_bit_at.bit D[1 count 60], %7, %0, %12
note "a coil"
%16:bit = endif %12
} goto 2 if %16
)");
}

// What the program puts into the cell, and what it computes of it.
TEST(RangeVersioning, NumbersOfTheProgram) {
  Module module = moduleOf({{"MAIN",
                             {{"%0:i32 = const 0\nstore.i32 D[0], %0"},
                              {"%0:i32 = const 7\nstore.i32 D[0], %0"},
                              {"%0:i32 = load D[0]\n%1:i32 = add %0, %0\nstore.i32 D[1], %1"},
                              {"%0:i32 = load D[1]\n%1:i32 = load D[0]\n%2:i32 = load_at D[10 count 30], %0\n"
                               "store_at.i32 D[20 count 9], %1, %2"}}}},
                           {"MAIN"});
  versionRanges(module);
  foldConstants(module);
  reuseValues(module);
  foldConstants(module);
  removeDeadOps(module);
  EXPECT_EQ(bodyOf(module, RoutineId{0}, 3), R"(%0:i32 = load D[0]
%1:i32 = const 0
%2:bit = eq.i32 %0, %1
%3:i32 = load D[1]
%4:bit = eq.i32 %3, %1
%5:bit = and %2, %4
if %5
%6:i32 = load D[10]
store.i32 D[20], %6
else
%7:i32 = const 7
%8:bit = eq.i32 %0, %7
%9:i32 = const 14
%10:bit = eq.i32 %3, %9
%11:bit = and %8, %10
if mostly, %11
%12:i32 = load D[24]
store.i32 D[27], %12
else
%13:i32 = load_at D[10 count 30], %3
store_at.i32 D[20 count 9], %0, %13
endif
endif
)");
}

TEST(RangeVersioning, FiveNumbersAreTooMany) {
  std::vector<RungText> rungs;
  for (int i = 0; i < 5; ++i) rungs.push_back({"%0:i32 = const " + std::to_string(i) + "\nstore.i32 D[0], %0"});
  rungs.push_back({"%0:i32 = load D[0]\n%1:i32 = load_at D[10 count 30], %0\nstore_at.i32 D[20 count 9], %0, %1"});
  const Module before = moduleOf({{"MAIN", rungs}}, {"MAIN"});
  Module module = before;
  versionRanges(module);
  EXPECT_EQ(bodyOf(module, RoutineId{0}, 5), bodyOf(before, RoutineId{0}, 5));
}

bool isGuarded(const std::string& lines) {
  const std::string body = after(versionRanges, lines);
  return body.find("else") != std::string::npos;
}

TEST(RangeVersioning, OnlyWhereItPays) {
  const std::string index = "%0:i32 = load D[0]\n%1:i32 = const 10\n%2:i32 = add %0, %1\n";
  const std::string compares = "%3:i32 = const 60\n%4:bit = lt_u.i32 %2, %3\n%5:bit = le_u.i32 %3, %2\n";
  const std::string load = "%6:i32 = load_at D[0 count 60], %2\n";
  const std::string store = "store_at.i32 D[0 count 60], %2, %6\n";
  EXPECT_TRUE(isGuarded(index + compares + load + store));
  EXPECT_FALSE(isGuarded(index + compares + load)) << "one place";
  EXPECT_FALSE(isGuarded("%0:i32 = const 5\n%1:i32 = const 6\n%2:i32 = slot_load $0\n" + compares + load + store))
      << "not from a cell";
  EXPECT_FALSE(isGuarded("%0:i32 = const 5\n%1:i32 = const 6\n%2:i32 = const 5\n" + compares + load + store))
      << "known anyway";
}

TEST(RangeVersioning, AsManyCellsAsFew) {
  std::string lines;
  for (int i = 0; i < 3; ++i) lines += "%" + std::to_string(i) + ":i32 = load D[" + std::to_string(i) + "]\n";
  lines += "%3:i32 = const 40\n";
  for (int i = 0; i < 3; ++i) {
    lines += "store_at.i32 D[10 count 40], %" + std::to_string(i) + ", %0\n";
    lines += "%" + std::to_string(4 + i) + ":bit = lt_u.i32 %" + std::to_string(i) + ", %3\n";
  }
  EXPECT_TRUE(isGuarded(lines)) << after(versionRanges, lines);
  EXPECT_FALSE(isGuarded(lines + "%7:i32 = load D[3]\nstore_at.i32 D[10 count 40], %7, %0")) << "a fourth";
}

TEST(RangeVersioning, AnIndexThatTheRungChanges) {
  const std::string body = after(versionRanges, R"(%0:i32 = load D[0]
%1:i32 = const 60
%2:bit = lt_u.i32 %0, %1
store_at.i32 D[1 count 60], %0, %0
%3:i32 = load D[5]
store.i32 D[0], %3
%4:i32 = load D[0]
%5:bit = lt_u.i32 %4, %1
store_at.i32 D[1 count 60], %4, %0
%6:bit = le_u.i32 %1, %0
%7:bit = ne.i32 %0, %1
%8:bit = eq.i32 %0, %1)");
  EXPECT_NE(body.find("store_at.i32 D[1 count 32]"), std::string::npos) << body;
  const size_t shortWay = body.find("else");
  EXPECT_NE(body.substr(0, shortWay).find("store_at.i32 D[1 count 60], %"), std::string::npos)
      << "what the cell holds in the end is unknown\n"
      << body;
}

} // namespace
} // namespace rung::ir

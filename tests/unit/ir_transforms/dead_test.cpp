// Dead operations and regions.
#include <gtest/gtest.h>

#include "ir/transforms/passes.h"
#include "tests/unit/ir_transforms/passes_testing.h"

namespace rung::ir {
namespace {

std::string alive(std::string_view lines, std::string_view transfer = "}") {
  return after(removeDeadOps, lines, transfer);
}
void expectUnchanged(std::string_view lines) { EXPECT_EQ(alive(lines), bodyOf(moduleOf(lines))); }

TEST(Dead, UnusedResults) {
  EXPECT_EQ(alive(R"(%0:i32 = load D[0]
%1:i32 = load D[1]
%2:i32 = add %0, %1
%3:i32 = mul %2, %2
note "stays"
%4:bit = load B[0.0]
%5:bit = load B[0.1]
%6:i32 = slot_load $0
%7:i32 = load_at D[0 count 4], %6 @9
store.i32 D[2], %1 @10)",
                  "} goto 2 if %5"),
            "%0:i32 = load D[1]\nnote \"stays\"\n%1:bit = load B[0.1]\nstore.i32 D[2], %0 @10\n} goto 2 if %1\n");
}

TEST(Dead, EffectsStay) {
  expectUnchanged(R"(%0:i32 = load D[0]
%1:i32 = service_poll %0
%2:i64 = service_result 1, %0
%3:i32 = service_request S
%4:bit = load B[0.0]
store.bit B[0.1], %4
store.bit B[0.1], %4
trap F, %4)");
}

TEST(Dead, ValueOfASwitch) {
  EXPECT_EQ(alive("%0:i32 = load D[0]\n%1:i32 = load D[1]", "} switch %1 [2, 3]"),
            "%0:i32 = load D[1]\n} switch %0 [2, 3]\n");
}

TEST(Dead, RegionsGoAsAWhole) {
  EXPECT_EQ(alive(R"(%0:bit = load B[0.0]
%1:i32 = load D[0]
if %0
  %2:i32 = add %1, %1
  if %0
  endif
  %3:i32, %4:i32 = loop 5, %1
    %5:i32 = add %4, %2
  %6:i32 = endloop %5
else %6
%7:i32 = endif %1
note "end")"),
            "note \"end\"\n");
}

TEST(Dead, ResultsOfAnIfGoOneByOne) {
  EXPECT_EQ(alive(R"(%0:bit = load B[0.0]
if %0
  %1:i32 = load D[0]
  %2:i32 = load D[1]
  %3:i32 = load D[2]
else %1, %2, %3
  %4:i32 = load D[3]
  %5:i32 = load D[4]
  %6:i32 = load D[5]
%7:i32, %8:i32, %9:i32 = endif %4, %5, %6
store.i32 D[9], %8)"),
            R"(%0:bit = load B[0.0]
if %0
%1:i32 = load D[1]
else %1
%2:i32 = load D[4]
%3:i32 = endif %2
store.i32 D[9], %3
)");
}

TEST(Dead, AnElseWithoutEffect) {
  EXPECT_EQ(alive(R"(%0:bit = load B[0.0]
if %0
  store.bit B[0.1], %0
else
  %1:i32 = load D[3]
endif)"),
            "%0:bit = load B[0.0]\nif %0\nstore.bit B[0.1], %0\nendif\n");
}

TEST(Dead, AnElseWithEffectAlone) {
  expectUnchanged(R"(%0:bit = load B[0.0]
if %0
else
store.bit B[0.1], %0
endif)");
}

// A remark keeps nothing alive; it goes with its region.
TEST(Dead, NotesOfDeadRegions) {
  EXPECT_EQ(alive(R"(note "first"
%0:bit = load B[0.0]
if %0
  note "dead"
else
  note "dead too"
endif
%1:i32 = loop 3
  note "in a loop"
endloop)"),
            "note \"first\"\n");
  EXPECT_EQ(alive(R"(%0:bit = load B[0.0]
if %0
  note "alive"
  store.bit B[0.1], %0
else
  note "dead"
endif
note "after")"),
            "%0:bit = load B[0.0]\nif %0\nnote \"alive\"\nstore.bit B[0.1], %0\nendif\nnote \"after\"\n");
}

TEST(Dead, EffectsDeepInside) {
  EXPECT_EQ(alive(R"(%0:bit = load B[0.0]
%1:i32 = loop 3
  if %0
    %2:i32 = loop 2
      trap F, %0
    endloop
  else
    if %0
    endif
  endif
endloop)"),
            R"(%0:bit = load B[0.0]
%1:i32 = loop 3
if %0
%2:i32 = loop 2
trap F, %0
endloop
endif
endloop
)");
}

TEST(Dead, CarriedValuesOfALoopThatIsNeeded) {
  expectUnchanged(R"(%0:i32 = load D[0]
%1:i32, %2:i32, %3:i32 = loop 3, %0, %0
  %4:i32 = add %2, %3
%5:i32, %6:i32 = endloop %3, %4
store.i32 D[1], %5)");
}

} // namespace
} // namespace rung::ir

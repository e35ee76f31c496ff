// Reuse of operations, loads and stored values; and what keeps from it.
#include <gtest/gtest.h>

#include "ir/transforms/passes.h"
#include "tests/unit/ir_transforms/passes_testing.h"

namespace rung::ir {
namespace {

std::string reused(std::string_view lines) { return after(reuseValues, lines); }
// Nothing can be used again.
void expectUnchanged(std::string_view lines) { EXPECT_EQ(reused(lines), bodyOf(moduleOf(lines))); }

TEST(Reuse, EqualOperations) {
  EXPECT_EQ(reused(R"(%0:i32 = load D[0]
%1:i32 = load D[1]
%2:i32 = add %0, %1
%3:i32 = add %1, %0
%4:i32 = sub %0, %1
%5:i32 = sub %1, %0
%6:i32 = const 7
%7:i32 = const 7
%8:i64 = const 7
%9:i64 = now
%10:i64 = now
%11:bit = lt_s.i32 %6, %7
message show, %2, %3, %7, %10)"),
            R"(%0:i32 = load D[0]
%1:i32 = load D[1]
%2:i32 = add %0, %1
%3:i32 = sub %0, %1
%4:i32 = sub %1, %0
%5:i32 = const 7
%6:i64 = const 7
%7:i64 = now
%8:bit = lt_s.i32 %5, %5
message show, %2, %2, %5, %7
)");
}

TEST(Reuse, OfMemory) {
  EXPECT_EQ(reused(R"(%0:i32 = load D[0]
%1:i32 = load D[0]
store.i32 D[1], %1
%2:i32 = load D[1]
%3:bit = load B[0.0]
store.bit B[0.1], %3
%4:bit = load B[0.1]
%5:bit = load B[0.0]
trap F, %4
trap F, %5
slot_store.i32 $1, %2
%6:i32 = slot_load $1
%7:i32 = slot_load $0
%8:i32 = slot_load $0
store.i32 D[5], %6
store.i32 D[6], %8)"),
            R"(%0:i32 = load D[0]
store.i32 D[1], %0
%1:bit = load B[0.0]
store.bit B[0.1], %1
trap F, %1
trap F, %1
slot_store.i32 $1, %0
%2:i32 = slot_load $0
store.i32 D[5], %0
store.i32 D[6], %2
)");
}

TEST(Reuse, Interference) {
  const std::string head =
      "%0:i32 = load D[60]\n%1:i16 = load D[61]\n%2:i64 = load D[56]\n%3:bit = load D[63.0]\n%4:i32 = const 3\n";
  struct Pair {
    const char* load;
    const char* store;
    bool interferes;
  };
  const Pair pairs[] = {
      {"i32 = load D[2]", "store.i16 D[2+2], %1", true},
      {"i32 = load D[2]", "store.i16 D[3], %1", false},
      {"i32 = load D[2]", "store.i16 D[1+2], %1", false},
      {"i32 = load D[2]", "store.i32 D[1+1], %0", true},
      {"i16 = load D[2]", "store.i32 D[2], %0", true}, // the same place, but another type
      {"f64 = load D[2]", "store.i64 D[2], %2", true},
      {"i32 = load D[2]", "store.bit D[2.31], %3", true},
      {"i32 = load D[2]", "store.bit D[3.0], %3", false},
      {"bit = load D[2.5]", "store.bit D[2.6], %3", false},
      {"bit = load D[2.5]", "store.i32 D[2], %0", true},
      {"bit = load D[2.8]", "store.i64 D[1], %2", true},
      {"bit = load D[2.8]", "store.i64 D[0], %2", false},
      {"i32 = load D[2]", "store.i32 B[8], %0", false},
      {"i32 = load D[2]", "slot_store.i32 $0, %0", false},
      {"i32 = slot_load $0", "slot_store.i32 $1, %0", false},
      {"i32 = slot_load $0", "store.i32 B[0], %0", false},
      {"i32 = load D[2]", "store_at.i32 D[0 count 3], %0, %0", true},
      {"i32 = load D[2]", "store_at.i32 D[0 count 2], %0, %0", false},
      {"i32 = load D[2]", "store_at.i64 D[0 count 2], %0, %2", true}, // the last element reaches over its unit
      {"i32 = load D[2]", "store_at.i32 D[3 count 2], %0, %0", false},
      {"bit = load D[2.31]", "store_bit_at.bit D[2 count 1], %0, %0, %3", true},
      {"bit = load D[2.31]", "store_bit_at.bit D[3 count 1], %0, %0, %3", false},
      {"i32 = load_at D[2 count 2], %0", "store.bit D[2.0], %3", true},
      {"i32 = load_at D[2 count 2], %0", "store_at.i32 D[2 count 2], %0, %0",
       true}, // outside of the window it would read 0
      {"i32 = load_at D[2 count 2], %0", "store.i32 B[0], %0", false},
      {"i32 = load_at D[2 count 2], %0", "slot_store.i32 $0, %0", false},
      {"bit = load_bit_at D[2 count 2], %0, %4", "store.i32 D[2], %0", true},
      {"bit = load_bit_at D[2 count 2], %0, %4", "note \"nothing\"", false},
      {"i32 = load D[2]", "trap F, %3", false},
  };
  for (const Pair& pair : pairs) {
    const std::string text = head + "%5:" + pair.load + "\n" + pair.store + "\n%6:" + pair.load;
    const std::string before = bodyOf(moduleOf(text));
    const std::string now = reused(text);
    EXPECT_EQ(now == before, pair.interferes) << text << "\ngives\n" << now;
  }
}

TEST(Reuse, StoredValueOfTheLastStore) {
  EXPECT_EQ(reused(R"(%0:i32 = const 1
%1:i32 = const 2
store.i32 D[0], %0
store.i32 D[0], %1
%2:i32 = load D[0]
store.i32 D[1], %2)"),
            "%0:i32 = const 1\n%1:i32 = const 2\nstore.i32 D[0], %0\nstore.i32 D[0], %1\nstore.i32 D[1], %1\n");
}

TEST(Reuse, AStoreOfWhatIsThere) {
  EXPECT_EQ(reused(R"(%0:i32 = load D[0]
store.i32 D[0], %0
%1:bit = load B[0.0]
if %1
  store.bit B[0.0], %1
  slot_store.i32 $0, %0
  slot_store.i32 $0, %0
endif
slot_store.i32 $0, %0)"),
            R"(%0:i32 = load D[0]
%1:bit = load B[0.0]
if %1
slot_store.i32 $0, %0
endif
slot_store.i32 $0, %0
)");
}

TEST(Reuse, AStoreOfWhatMayHaveBeenWrittenOver) {
  expectUnchanged("%0:i32 = load D[0]\nstore_at.i32 D[0 count 4], %0, %0\nstore.i32 D[0], %0");
  expectUnchanged("%0:i32 = load D[0]\n%1:bit = load B[0.0]\nstore.bit D[0.3], %1\nstore.i32 D[0], %0");
  expectUnchanged("%0:i32 = load D[0]\n%1:i16 = trunc %0\nstore.i16 D[0], %1");
}

TEST(Reuse, WindowsOfASpaceApart) {
  EXPECT_EQ(reused(R"(%0:i32 = load D[0]
%1:i32 = load D[20]
store_at.i32 D[2 count 4], %0, %1
store_at.i32 D[40 count 4], %0, %1
%2:i32 = load D[20]
store.i32 D[1], %2
%3:i32 = load D[5]
store_at.i32 D[4 count 1], %0, %1
store_at.i32 D[5 count 1], %0, %1
%4:i32 = load D[5]
store.i32 D[1], %4)"),
            R"(%0:i32 = load D[0]
%1:i32 = load D[20]
store_at.i32 D[2 count 4], %0, %1
store_at.i32 D[40 count 4], %0, %1
store.i32 D[1], %1
%2:i32 = load D[5]
store_at.i32 D[4 count 1], %0, %1
store_at.i32 D[5 count 1], %0, %1
%3:i32 = load D[5]
store.i32 D[1], %3
)");
}

TEST(Reuse, LeavesTheStoreOfATypeThatDiffers) {
  expectUnchanged("%0:i32 = const 1\nstore.i32 D[0], %0\n%1:i16 = load D[0]\n%2:i32 = load D[0+1]");
}

TEST(Reuse, ValuesOfARegionEndWithIt) {
  EXPECT_EQ(reused(R"(%0:bit = load B[0.0]
if %0
  %1:i32 = load D[0]
  %2:i32 = load D[0]
  store.i32 D[1], %2
else
  %3:i32 = load D[0]
  store.i32 D[2], %3
endif
%4:i32 = load D[0]
%5:bit = load B[0.0]
%6:i32 = load D[1]
trap F, %5
store.i32 D[3], %4
store.i32 D[4], %6)"),
            R"(%0:bit = load B[0.0]
if %0
%1:i32 = load D[0]
store.i32 D[1], %1
else
%2:i32 = load D[0]
store.i32 D[2], %2
endif
%3:i32 = load D[0]
%4:i32 = load D[1]
trap F, %0
store.i32 D[3], %3
store.i32 D[4], %4
)");
}

TEST(Reuse, AStoreInARegionCountsBehindIt) {
  expectUnchanged(R"(%0:bit = load B[0.0]
%1:i32 = load D[1]
if %0
  store.i32 D[0], %1
endif
%2:i32 = load D[0]
store.i32 D[1], %2)");
  // Also when the value was stored before.
  expectUnchanged(R"(%0:bit = load B[0.0]
%1:i32 = load D[0]
slot_store.i32 $0, %1
if %0
  %2:i32 = const 4
  slot_store.i32 $0, %2
endif
%3:i32 = slot_load $0
store.i32 D[1], %3)");
}

TEST(Reuse, LoopsThatWriteForgetWhatWasReadBefore) {
  expectUnchanged(R"(%0:i32 = load D[0]
%1:i32 = loop 3
  %2:i32 = load D[0]
  %3:i32 = loop 2
    %4:i32 = add %2, %3
    store.i32 D[0], %4
  endloop
endloop
%5:i32 = load D[0]
store.i32 D[1], %5)");
}

TEST(Reuse, LoopsThatDoNotWrite) {
  EXPECT_EQ(reused(R"(%0:i32 = load D[0]
%1:i64 = now
%2:i32 = loop 3
  %3:i32 = load D[0]
  message show, %3, %2, %2, %1
endloop)"),
            R"(%0:i32 = load D[0]
%1:i64 = now
%2:i32 = loop 3
message show, %0, %2, %2, %1
endloop
)");
}

TEST(Reuse, HostCallsAreAllMade) {
  expectUnchanged(R"(%0:i32 = const 1
%1:i32 = service_poll %0
%2:i32 = service_poll %0
%3:i64 = service_result 0, %0
%4:i64 = service_result 0, %0
%5:i32 = service_request S, %3
%6:i32 = service_request S, %3)");
}

TEST(Reuse, TransfersFollow) {
  EXPECT_EQ(after(reuseValues, "%0:bit = load B[0.0]\n%1:bit = load B[0.0]", "} goto 2 if %1"),
            "%0:bit = load B[0.0]\n} goto 2 if %0\n");
}

} // namespace
} // namespace rung::ir

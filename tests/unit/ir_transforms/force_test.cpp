// Forced bits: what becomes of the operations that would write them.
#include "ir/transforms/force.h"

#include <gtest/gtest.h>

#include "ir/transforms/pipeline.h"
#include "tests/unit/ir_transforms/passes_testing.h"

namespace rung::ir {
namespace {

constexpr uint32_t kB = 0; // spaces of moduleOf
constexpr uint32_t kD = 1;

std::string forced(const std::vector<rung_forced_byte>& bytes, std::string_view lines) {
  Module module = moduleOf(lines);
  forceBits(module, bytes);
  return bodyOf(module);
}

TEST(Force, ABit) {
  EXPECT_EQ(forced({{kB, 1, 1, 1}}, R"(%0:bit = load B[0.0]
store.bit B[1.0], %0
store.bit B[1.1], %0
%1:bit = load B[1.0])"),
            R"(%0:bit = load B[0.0]
%1:bit = const 1
store.bit B[1.0], %1
store.bit B[1.1], %0
%2:bit = load B[1.0]
)");
}

TEST(Force, ABitOfAByte) {
  EXPECT_EQ(forced({{kB, 1, 0x81, 0x80}}, R"(%0:i8 = load B[0]
store.i8 B[1], %0)"),
            R"(%0:i8 = load B[0]
store.i8 B[1], %0
%1:bit = const 0
store.bit B[1.0], %1
%2:bit = const 1
store.bit B[1.7], %2
)");
}

TEST(Force, AWord) {
  const std::vector<rung_forced_byte> word = {{kD, 4, 255, 0x34}, {kD, 5, 255, 0x12}, {kD, 6, 255, 0}, {kD, 7, 255, 0}};
  EXPECT_EQ(forced(word, R"(%0:i32 = load D[0]
store.i32 D[1], %0)"),
            R"(%0:i32 = load D[0]
%1:i32 = const 4660
store.i32 D[1], %1
)");
}

TEST(Force, AByteOfAWord) {
  EXPECT_EQ(forced({{kD, 5, 255, 0x12}}, R"(%0:i32 = load D[0]
store.i32 D[1], %0)"),
            R"(%0:i32 = load D[0]
store.i32 D[1], %0
%1:i8 = const 18
store.i8 D[1+1], %1
)");
}

TEST(Force, AStoreAtAComputedAddress) {
  EXPECT_EQ(forced({{kB, 3, 4, 0}}, R"(%0:i32 = load D[0]
%1:i8 = load B[0]
store_at.i8 B[2 count 4], %0, %1
store_at.i8 B[4 count 4], %0, %1)"),
            R"(%0:i32 = load D[0]
%1:i8 = load B[0]
store_at.i8 B[2 count 4], %0, %1
%2:bit = const 0
store.bit B[3.2], %2
store_at.i8 B[4 count 4], %0, %1
)");
}

TEST(Force, WhatIsReadAfterwardsIsTheForcedValue) {
  Module module = moduleOf(R"(%0:bit = load B[0.0]
store.bit B[1.0], %0
%1:bit = load B[1.0]
%2:bit = not %1
store.bit B[1.1], %2)");
  forceBits(module, std::vector<rung_forced_byte>{{kB, 1, 1, 1}});
  runPasses(module, {.verifyEach = true});
  EXPECT_EQ(bodyOf(module), R"(%0:bit = const 1
store.bit B[1.0], %0
%1:bit = const 0
store.bit B[1.1], %1
)");
}

} // namespace
} // namespace rung::ir

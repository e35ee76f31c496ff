// Operations in the order in which they are needed, whatever order they were made in.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <utility>

#include "ir/core/op_info.h"
#include "ir/text/text.h"
#include "ir/transforms/passes.h"
#include "ir/transforms/rewriter.h"
#include "tests/random/random.h"
#include "tests/random/random_source.h"
#include "tests/unit/ir_transforms/passes_testing.h"

namespace rung::ir {
namespace {

std::string ordered(std::string_view lines, std::string_view transfer = "}") {
  return after([](Module& module) { orderOperations(module); }, lines, transfer);
}

TEST(Order, OperandsComeInTheirOrder) {
  EXPECT_EQ(ordered(R"(%0:bit = load B[1.0]
%1:bit = load B[0.0]
%2:bit = not %0
%3:bit = and %1, %2
store.bit B[2.0], %3)"),
            R"(%0:bit = load B[0.0]
%1:bit = load B[1.0]
%2:bit = not %1
%3:bit = and %0, %2
store.bit B[2.0], %3
)");
}

TEST(Order, LinesOfTheSourceComeInTheirOrder) {
  EXPECT_EQ(ordered(R"(%0:bit = load B[0.1] @12
%1:bit = load B[0.0] @11
%2:bit = and %0, %1 @13
store.bit B[2.0], %2 @13)"),
            R"(%0:bit = load B[0.0] @11
%1:bit = load B[0.1] @12
%2:bit = and %1, %0 @13
store.bit B[2.0], %2 @13
)");
}

TEST(Order, AnOperandOfALaterLineComesFirst) {
  const std::string lines = R"(%0:bit = load B[0.1] @12
%1:bit = not %0 @11
store.bit B[2.0], %1 @11
)";
  EXPECT_EQ(ordered(lines), lines);
}

TEST(Order, TheExitNeedsItsValuesLast) {
  EXPECT_EQ(ordered(R"(%0:bit = load B[1.0]
%1:bit = load B[0.0]
store.bit B[2.0], %1)",
                    "} goto 2 if %0"),
            R"(%0:bit = load B[0.0]
%1:bit = load B[1.0]
store.bit B[2.0], %0
} goto 2 if %1
)");
}

TEST(Order, NothingPassesAnEffect) {
  const std::string lines = R"(%0:bit = load B[0.0]
store.bit B[1.0], %0
%1:bit = load B[1.0]
if %0
%2:bit = load B[1.1]
store.bit B[1.2], %2
endif
%3:bit = load B[1.2]
store.bit B[1.3], %3
)";
  EXPECT_EQ(ordered(lines + "store.bit B[1.4], %1"), lines + "store.bit B[1.4], %1\n");
}

TEST(Order, WhatNobodyNeedsStays) {
  const std::string lines = "%0:i32 = const 1\n%1:i32 = const 2\nnote \"end\"\n";
  EXPECT_EQ(ordered(lines), lines);
}

TEST(Order, MarksGoAlong) {
  Module module = moduleOf("%0:bit = load B[1.0]\n%1:bit = load B[0.0]\n%2:bit = and %1, %0\nstore.bit B[2.0], %2");
  Marks marks;
  marks.add(RoutineId{0}, 0, {.kind = MarkKind::Contact, .value = ValueId{0}, .text = "second"});
  marks.add(RoutineId{0}, 0, {.kind = MarkKind::Coil, .value = ValueId{2}, .text = "coil"});
  orderOperations(module, &marks);
  const Marks& read = marks;
  EXPECT_EQ(read.of(RoutineId{0}, 0)[0].value, ValueId{1});
  EXPECT_EQ(read.of(RoutineId{0}, 0)[1].value, ValueId{2});
}

TEST(Order, GivenNumbersGoAlong) {
  Module module = moduleOf("%0:bit = load B[1.0]\n%1:bit = load B[0.0]\n%2:bit = and %1, %0\nstore.bit B[2.0], %2");
  GivenNumbers given;
  given.add(RoutineId{0}, 0, {.value = ValueId{0}, .space = {}});
  orderOperations(module, nullptr, &given);
  EXPECT_EQ(std::as_const(given).of(RoutineId{0}, 0)[0].value, ValueId{1});
}

// Another order that is as good: of the operations without effects that lie together, any whose operands are there.
void shuffle(Rung& rung, RandomSource& random) {
  std::vector<uint32_t> order;
  const auto moves = [&](uint32_t i) {
    const Op& op = rung.ops[i];
    return op.resultCount == 1 && onlyReads(opInfo(op.code));
  };
  for (uint32_t begin = 0; begin < rung.ops.size();) {
    uint32_t end = begin;
    while (end < rung.ops.size() && moves(end)) ++end;
    std::vector<uint32_t> rest;
    for (uint32_t i = begin; i < end; ++i) rest.push_back(i);
    while (!rest.empty()) {
      std::set<uint32_t> missing; // values of this stretch that are not there yet
      for (const uint32_t i : rest) missing.insert(rung.ops[i].result.index);
      std::vector<uint32_t> ready;
      for (const uint32_t i : rest) {
        const ValueId* args = argsOf(rung, rung.ops[i]);
        if (std::none_of(args, args + rung.ops[i].argCount, [&](ValueId v) { return missing.contains(v.index); }))
          ready.push_back(i);
      }
      order.push_back(random.pick(ready));
      std::erase(rest, order.back());
    }
    if (end < rung.ops.size()) order.push_back(end);
    begin = end + 1;
  }
  RungRewriter writer;
  writer.start(rung);
  for (const uint32_t i : order) writer.copy(rung.ops[i]);
  writer.finish(rung);
}

void removeUnused(Module& module) { // they have no order of their own
  removeDeadOps(module);
  removeDeadOps(module);
}

TEST(Order, IsTheSameWhateverTheOrderWas) {
  uint32_t differed = 0;
  for (uint64_t seed = 0; seed < 300; ++seed) {
    Module module = randomModule(seed, {.ops = 40});
    removeUnused(module);
    Module shuffled = module;
    RandomSource random(seed);
    for (Routine& routine : shuffled.routines)
      for (Rung& rung : routine.rungs) shuffle(rung, random);
    differed += print(module) != print(shuffled) ? 1 : 0;
    orderOperations(module);
    orderOperations(shuffled);
    ASSERT_EQ(print(module), print(shuffled)) << "seed " << seed;
  }
  EXPECT_GT(differed, 200u);
}

} // namespace
} // namespace rung::ir

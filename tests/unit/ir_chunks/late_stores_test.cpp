// Which stores a chunk may do when it is left. That they come to the same is the differential tests' matter.
#include "ir/chunks/late_stores.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "ir/core/builder.h"
#include "ir/core/ops.h"

namespace rung::ir {
namespace {

constexpr SpaceId kWords{0};
constexpr SpaceId kBits{1};
constexpr Place kNegative{kBits, 0, 1};
constexpr Place kCarry{kBits, 0, 2};

using Body = std::function<void(RungBuilder&)>;

// A rung that adds words `n` and n + 1, when a bit is set. Its flags are whether the sum is negative, and a constant.
void addition(RungBuilder& b, uint32_t n) {
  b.when(b.load(Type::Bit, {kBits, 1, n}), [&] {
    const auto wide = [&](uint32_t word) { return b.sextOrTrunc(Type::I64, b.load(Type::I32, {kWords, 4 * word, 0})); };
    const ValueId sum = b.add(wide(n), wide(n + 1));
    b.store(kNegative, b.ltS(sum, b.constant(Type::I64, 0)));
    b.store(kCarry, b.bit(false));
    b.store({kWords, 64 + 4 * n, 0}, b.zextOrTrunc(Type::I32, sum));
  });
}

// `count` of these, and then another rung.
Module additions(uint32_t count, const Body& other) {
  Module m;
  m.spaces.push_back({.name = "W", .unitBytes = 4, .units = 32});
  m.spaces.push_back({.name = "B", .unitBytes = 1, .units = 8});
  m.faults.emplace_back("fault");
  m.services.emplace_back("service");
  m.routines.push_back({.name = "MAIN", .rungs = std::vector<Rung>(count + 1)});
  for (uint32_t i = 0; i < count; ++i) {
    RungBuilder b(m, m.routines[0].rungs[i]);
    addition(b, i);
  }
  RungBuilder b(m, m.routines[0].rungs[count]);
  other(b);
  m.tasks.push_back(
      {.name = "MAIN", .entry = {0}, .periodUs = 1000, .budgetFault = {0}, .begin = {}, .end = {}, .borders = {}});
  m.mainTask = {0};
  return m;
}

struct Counts {
  size_t groups = 0;
  uint32_t remembers = 0; // places
  uint32_t forgets = 0;
  bool operator==(const Counts&) const = default;
};

Counts countsOf(const Module& module) {
  const Cut cut(module, {});
  const LateStores late(module, cut.chunks()[0], exitsOf(cut, cut.chunks()[0]));
  Counts counts{.groups = late.groups().size()};
  for (const Rung& rung : module.routines[0].rungs)
    for (const Op& op : rung.ops) {
      const LateStores::Part store = late.of(op);
      if (!store.isFirst) continue;
      ++(store.role == LateStores::Role::Remembers ? counts.remembers : counts.forgets);
    }
  return counts;
}

Counts countsOf(uint32_t count, const Body& other) { return countsOf(additions(count, other)); }

TEST(LateStores, FlagsThatFollowFromOneNumber) {
  const Module module = additions(5, [](RungBuilder&) {});
  EXPECT_EQ(countsOf(module), (Counts{1, 5, 0}));
  const Cut cut(module, {});
  const LateStores late(module, cut.chunks()[0], exitsOf(cut, cut.chunks()[0]));
  const LateStores::Group& group = late.groups()[0];
  EXPECT_EQ(group.never, INT64_MIN);
  EXPECT_EQ(std::ranges::count(group.ops, OpCode::Store, [](const Op* op) { return op->code; }), 2);
}

// Passes may leave the constant's store before the sum: what is remembered is stored by one that follows from it.
TEST(LateStores, ANumberIsRememberedOnceItIsThere) {
  Module module = additions(5, [](RungBuilder&) {});
  Rung& rung = module.routines[0].rungs[4];
  const auto carry = std::ranges::find_if(
      rung.ops, [](const Op& op) { return op.code == OpCode::Store && op.imm == 2 && op.type == Type::Bit; });
  const auto bit =
      std::ranges::find_if(rung.ops, [](const Op& op) { return op.code == OpCode::Const && op.type == Type::Bit; });
  const auto first = std::ranges::find(rung.ops, OpCode::If, &Op::code) + 1;
  std::rotate(bit, carry, carry + 1); // right before the constant, then both to the front of the region
  std::rotate(first, bit + 1, bit + 2);
  std::rotate(first + 1, bit + 1, bit + 2);
  const Cut cut(module, {});
  const LateStores late(module, cut.chunks()[0], exitsOf(cut, cut.chunks()[0]));
  ASSERT_EQ(late.groups().size(), 1u);
  std::vector<bool> isThere(rung.values.size(), false);
  for (const Op& op : rung.ops) {
    const LateStores::Part part = late.of(op);
    if (part.isFirst) EXPECT_TRUE(isThere[part.from.index]);
    if (op.resultCount == 1) isThere[op.result.index] = true;
  }
}

TEST(LateStores, WaysOutThatAreMoreThanThePlaces) {
  for (const TransferKind kind : {TransferKind::Ret, TransferKind::End}) {
    Module module = additions(8, [](RungBuilder&) {});
    for (size_t i = 0; i < 8; ++i) {
      Rung& rung = module.routines[0].rungs[i];
      rung.transfer.kind = kind;
      rung.transfer.cond = arg(rung, *std::ranges::find(rung.ops, OpCode::If, &Op::code), 0);
    }
    EXPECT_EQ(countsOf(module), Counts{});
  }
}

TEST(LateStores, TooFew) {
  EXPECT_EQ(countsOf(3, [](RungBuilder&) {}), Counts{});
}

TEST(LateStores, WritingAllOfThemAnewForgets) {
  const auto reset = [](RungBuilder& b) {
    b.store(kNegative, b.load(Type::Bit, {kBits, 2, 0}));
    b.store(kCarry, b.bit(true));
  };
  EXPECT_EQ(countsOf(6, reset), (Counts{1, 6, 1}));
}

TEST(LateStores, WritingOneOfThemKeepsTheOther) {
  const auto reset = [](RungBuilder& b) { b.store(kCarry, b.bit(true)); };
  EXPECT_EQ(countsOf(6, reset), (Counts{1, 6, 0}));
}

TEST(LateStores, NotWhereSomethingElseAccessesThem) {
  const Body accesses[] = {
      [](RungBuilder& b) { b.store({kBits, 3, 0}, b.load(Type::Bit, kNegative)); },
      [](RungBuilder& b) { b.store({kBits, 0, 0}, b.constant(Type::I8, 0)); },
      [](RungBuilder& b) {
        const Window window{.space = kBits, .byte = 0, .count = 8};
        b.storeAt(window, b.load(Type::I32, {kWords, 0, 0}), b.constant(Type::I8, 0));
      },
  };
  for (const Body& access : accesses) EXPECT_EQ(countsOf(6, access).groups, 0u);
}

TEST(LateStores, NotWhereMemoryIsSeenWithinTheChunk) {
  EXPECT_EQ(countsOf(6, [](RungBuilder& b) { b.trap(b.load(Type::Bit, {kBits, 2, 0}), FaultId{0}); }), Counts{});
  EXPECT_EQ(countsOf(6, [](RungBuilder& b) { b.serviceRequest(ServiceId{0}, {}); }), Counts{});
}

} // namespace
} // namespace rung::ir

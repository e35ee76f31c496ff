// The rung builder: what it writes, and that it stops at mistakes.
#include <gtest/gtest.h>

#include "ir/core/builder.h"
#include "ir/core/ops.h"

namespace rung::ir {
namespace {

class BuilderTest : public ::testing::Test {
protected:
  BuilderTest() {
    module_.spaces = {{.name = "D", .unitBytes = 4, .units = 16}};
    module_.slots = {{.type = Type::I16, .key = "s"}};
    module_.faults = {"f"};
    module_.services = {"S"};
  }
  const Op& last() const { return rung_.ops.back(); }

  Module module_;
  Rung rung_;
  RungBuilder b_{module_, rung_};
};

TEST_F(BuilderTest, NumbersValuesAndOperandsInOrder) {
  const ValueId a = b_.i32(-1);
  const ValueId b = b_.i32(2);
  const ValueId sum = b_.add(a, b);
  EXPECT_EQ(a.index, 0u);
  EXPECT_EQ(sum.index, 2u);
  EXPECT_EQ(rung_.ops[0].imm, 0xFFFFFFFF); // modulo the width
  EXPECT_EQ(last().firstArg, 0u);
  EXPECT_EQ(last().argCount, 2);
  EXPECT_EQ(last().type, Type::I32);
  EXPECT_EQ(b_.typeOf(b_.ltS(a, b)), Type::Bit);
  EXPECT_EQ(last().firstArg, 2u);
}

TEST_F(BuilderTest, ResizesOnlyWhereWidthsDiffer) {
  const ValueId a = b_.i32(5);
  EXPECT_EQ(b_.zextOrTrunc(Type::I32, a), a);
  b_.zextOrTrunc(Type::I64, a);
  EXPECT_EQ(last().code, OpCode::ZExt);
  b_.sextOrTrunc(Type::I64, a);
  EXPECT_EQ(last().code, OpCode::SExt);
  b_.sextOrTrunc(Type::Bit, a);
  EXPECT_EQ(last().code, OpCode::Trunc);
}

TEST_F(BuilderTest, PlacesAndWindowsAreBitOffsets) {
  b_.load(Type::Bit, {SpaceId{0}, 3, 6});
  EXPECT_EQ(last().imm, 30);
  b_.storeAt({SpaceId{0}, 8, 5}, b_.i32(0), b_.i32(1));
  EXPECT_EQ(last().imm, 64);
  EXPECT_EQ(last().count, 5u);
  EXPECT_EQ(last().type, Type::I32);
  EXPECT_EQ(b_.typeOf(b_.slotLoad(SlotId{0})), Type::I16);
}

TEST_F(BuilderTest, RegionsGiveTheirResults) {
  b_.if_(b_.bit(true));
  const ValueId one = b_.i32(1);
  b_.else_(std::vector{one});
  const ValueId two = b_.i32(2);
  const std::vector<ValueId> results = b_.endIf(std::vector{two});
  ASSERT_EQ(results.size(), 1u);
  EXPECT_EQ(b_.typeOf(results[0]), Type::I32);
  const std::vector<ValueId> in = b_.loop(3, results);
  ASSERT_EQ(in.size(), 2u);
  EXPECT_EQ(last().count, 3u);
  EXPECT_EQ(b_.endLoop(std::vector{in[0]}).size(), 1u);
}

TEST_F(BuilderTest, BranchesGiveValuesArraysAndStructs) {
  struct Pair {
    ValueId left, right;
  };
  const ValueId cond = b_.bit(true);
  const ValueId one = b_.i32(1), two = b_.i32(2);
  EXPECT_EQ(b_.choose(cond, [&] { return one; }, [&] { return two; }).index, 3u);
  const auto array = b_.choose(cond, [&] { return std::array{one, cond}; }, [&] { return std::array{two, cond}; });
  EXPECT_EQ(array[1].index, 5u);
  const Pair pair = b_.choose(cond, [&] { return Pair{one, cond}; }, [&] { return Pair{two, cond}; });
  EXPECT_EQ(pair.left.index, 6u);
  EXPECT_EQ(b_.typeOf(pair.right), Type::Bit);
}

TEST_F(BuilderTest, BranchesWithoutResults) {
  const ValueId cond = b_.bit(true);
  const auto codes = [&] {
    std::vector<OpCode> made;
    for (const Op& op : rung_.ops) made.push_back(op.code);
    rung_.ops.clear();
    return made;
  };
  codes();
  b_.when(cond, [&] { b_.note("a"); });
  EXPECT_EQ(codes(), (std::vector{OpCode::If, OpCode::Note, OpCode::EndIf}));
  b_.when({}, [&] { b_.note("a"); });
  EXPECT_EQ(codes(), std::vector{OpCode::Note});
  b_.when(cond, [&] { b_.now(); }, [&] { b_.note("b"); });
  EXPECT_EQ(codes(), (std::vector{OpCode::If, OpCode::Now, OpCode::Else, OpCode::Note, OpCode::EndIf}));
}

TEST_F(BuilderTest, LinesNotesAndHost) {
  b_.setLine(12);
  b_.note("first");
  b_.note("second");
  EXPECT_EQ(last().ref, 1u);
  EXPECT_EQ(last().line, 12u);
  EXPECT_EQ(rung_.notes[1], "second");
  b_.trap(b_.bit(false), FaultId{0});
  EXPECT_EQ(b_.typeOf(b_.serviceRequest(ServiceId{0}, {})), Type::I32);
  const ValueId ticket{last().result};
  EXPECT_EQ(b_.typeOf(b_.serviceResult(ticket, 2)), Type::I64);
  EXPECT_EQ(last().imm, 2);
  b_.message(RUNG_MESSAGE_LOG, ticket, ticket, ticket, b_.real(1.5));
  EXPECT_EQ(last().ref, uint32_t{RUNG_MESSAGE_LOG});
}

TEST_F(BuilderTest, Transfers) {
  const ValueId c = b_.bit(true);
  b_.gotoRung(4, c);
  EXPECT_EQ(rung_.transfer.kind, TransferKind::Goto);
  EXPECT_EQ(rung_.transfer.target, 4u);
  EXPECT_EQ(rung_.transfer.cond, c);
  b_.call(RoutineId{1});
  EXPECT_EQ(rung_.transfer.callee, RoutineId{1});
  EXPECT_FALSE(rung_.transfer.cond.valid());
  b_.switchTo(b_.i32(0), {1, 2});
  EXPECT_EQ(rung_.transfer.targets.size(), 2u);
}

TEST_F(BuilderTest, StopsAtMistakes) {
  const ValueId bit = b_.bit(true);
  const ValueId word = b_.i32(1);
  const std::vector one{word};
  EXPECT_DEATH(b_.add(bit, bit), "type it does not have");
  EXPECT_DEATH(b_.and_(bit, word), "operand of the wrong type");
  EXPECT_DEATH(b_.op(OpCode::Add, Type::I32, {word}), "wrong number of operands");
  EXPECT_DEATH(b_.slotStore(SlotId{0}, word), "slot of another type");
  EXPECT_DEATH(b_.else_(), "else without if");
  EXPECT_DEATH(b_.endIf(one), "endif without if");
  EXPECT_DEATH(b_.endLoop(), "a loop carries on");
  b_.if_(bit);
  b_.else_(one);
  EXPECT_DEATH(b_.endIf(), "yield the same values");
  EXPECT_DEATH(b_.endIf(std::vector{bit}), "yield the same types");
}

} // namespace
} // namespace rung::ir

// Items of modules, arithmetic, comparisons and edges, as the dialects' lowerings ask for them.
#include <gtest/gtest.h>

#include "frontend/lower/module_items.h"
#include "frontend/lower/operations.h"
#include "ir/core/ops.h"

namespace rung::frontend {
namespace {

using ir::OpCode;

TEST(ModuleItems, OnceHoweverOftenAsked) {
  ir::Module module;
  const nc::ServiceRow a(1, "A x ->"), other(2, "B ->");
  EXPECT_EQ(service(module, a).index, 0u);
  EXPECT_EQ(service(module, other).index, 1u);
  EXPECT_EQ(service(module, a).index, 0u);
  EXPECT_EQ(module.services.size(), 2u);
  ConstantBytes constants(module);
  const ir::SpaceId bytes = constants.spaceOf("abc");
  EXPECT_EQ(constants.spaceOf("abc"), bytes);
  EXPECT_NE(constants.spaceOf("x"), bytes);
  EXPECT_EQ(module.at(bytes).units, 3u);
  EXPECT_EQ(module.inits.size(), 2u);
}

TEST(ModuleItems, TheSecondOfWhatIsAlikeHasANumber) {
  Numbering keys;
  EXPECT_EQ(keys.numbered("a"), "a");
  EXPECT_EQ(keys.numbered("b"), "b");
  EXPECT_EQ(keys.numbered("a"), "a~1");
  EXPECT_EQ(keys.numbered("a"), "a~2");
}

class OperationsTest : public ::testing::Test {
protected:
  ir::OpCode last() const { return rung_.ops.back().code; }
  ir::Module module_;
  ir::Rung rung_;
  ir::RungBuilder b_{module_, rung_};
};

TEST_F(OperationsTest, ArithmeticByTheTypeOfTheValues) {
  const ir::ValueId x = b_.i32(1), r = b_.real(1);
  compute(b_, kSubtract, x, x);
  EXPECT_EQ(last(), OpCode::Sub);
  compute(b_, kDivide, x, x);
  EXPECT_EQ(last(), OpCode::DivS);
  compute(b_, kDivide, r, r);
  EXPECT_EQ(last(), OpCode::FDiv);
  combine(b_, kXor, x, x);
  EXPECT_EQ(last(), OpCode::Xor);
}

TEST_F(OperationsTest, ComparisonsByTheTypeOfTheValues) {
  const ir::ValueId x = b_.i32(1), y = b_.i32(2), r = b_.real(1);
  compare(b_, kLessEqual, x, y);
  EXPECT_EQ(last(), OpCode::LeS);
  compare(b_, kGreater, x, y);
  EXPECT_EQ(last(), OpCode::LtS);
  EXPECT_EQ(ir::arg(rung_, rung_.ops.back(), 0), y);
  compare(b_, kNotEqual, x, y);
  EXPECT_EQ(last(), OpCode::Ne);
  compare(b_, kNotEqual, r, r); // 1 with a NaN
  EXPECT_EQ(last(), OpCode::Not);
  EXPECT_EQ(rung_.ops[rung_.ops.size() - 2].code, OpCode::FEq);
}

TEST_F(OperationsTest, AnEdgeRemembersTheValue) {
  const ir::SlotId slot = addSlot(module_, {.type = ir::Type::Bit, .key = "k"});
  const ir::ValueId now = b_.bit(true);
  pulse(b_, slot, now, kFalling);
  EXPECT_EQ(rung_.ops[1].code, OpCode::SlotLoad);
  EXPECT_EQ(rung_.ops[2].code, OpCode::SlotStore);
  EXPECT_EQ(last(), OpCode::And);
  EXPECT_EQ(ir::arg(rung_, rung_.ops.back(), 0), rung_.ops[1].result); // was, and is not
}

} // namespace
} // namespace rung::frontend

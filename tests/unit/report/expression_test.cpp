// Which conditions decide alone: by hand, and against flipping them one by one.
#include <gtest/gtest.h>

#include <random>

#include "ir/core/builder.h"
#include "ir/core/eval.h"
#include "ir/core/op_info.h"
#include "tools/report/coverage_collector.h"

namespace rung::report {
namespace {

using ir::RungBuilder;
using ir::Type;
using ir::ValueId;

class ExpressionTest : public ::testing::Test {
protected:
  ExpressionTest() { module_.spaces = {{.name = "I", .unitBytes = 1, .units = 64}}; }

  ValueId condition() {
    const auto n = static_cast<uint32_t>(conditions_.size());
    conditions_.push_back(b_.load(Type::Bit, {ir::SpaceId{0}, n / 8, n % 8}));
    return conditions_.back();
  }
  // All values of the rung; loads give `bits` in their order.
  std::vector<uint64_t> run(const std::vector<bool>& bits) const {
    std::vector<uint64_t> values(rung_.values.size());
    size_t loads = 0;
    for (const ir::Op& op : rung_.ops) {
      uint64_t& out = values[op.result.index];
      if (ir::opInfo(op.code).name == "load") {
        out = bits[loads++] ? 1 : 0;
      } else if (ir::opInfo(op.code).name == "const") {
        out = static_cast<uint64_t>(op.imm);
      } else {
        uint64_t args[3] = {};
        for (int i = 0; i < op.argCount; ++i) args[i] = values[ir::arg(rung_, op, i).index];
        out = ir::evalPure(op.code, op.type, ir::typeOf(rung_, ir::arg(rung_, op, 0)), args);
      }
    }
    return values;
  }
  std::vector<uint32_t> deciding(ValueId root, const std::vector<bool>& bits) {
    Expression expression(rung_, root, conditions_);
    std::vector<uint32_t> found;
    expression.findDeciding(run(bits), [&](size_t i) { found.push_back(expression.conditions()[i]); });
    std::sort(found.begin(), found.end());
    return found;
  }
  std::vector<uint32_t> flippedOneByOne(ValueId root, std::vector<bool> bits) const {
    std::vector<uint32_t> found;
    const uint64_t before = run(bits)[root.index];
    for (uint32_t i = 0; i < bits.size(); ++i) {
      bits[i] = !bits[i];
      if (run(bits)[root.index] != before) found.push_back(i);
      bits[i] = !bits[i];
    }
    return found;
  }

  ir::Module module_;
  ir::Rung rung_;
  RungBuilder b_{module_, rung_};
  std::vector<ValueId> conditions_;
};

using Found = std::vector<uint32_t>;

// (A and B) or C, all eight rows by hand.
TEST_F(ExpressionTest, TruthTableOfSeriesAndParallel) {
  const ValueId a = condition(), b = condition(), c = condition();
  const ValueId root = b_.or_(b_.and_(a, b), c);
  EXPECT_EQ(deciding(root, {0, 0, 0}), (Found{2}));
  EXPECT_EQ(deciding(root, {1, 0, 0}), (Found{1, 2}));
  EXPECT_EQ(deciding(root, {0, 1, 0}), (Found{0, 2}));
  EXPECT_EQ(deciding(root, {1, 1, 0}), (Found{0, 1}));
  EXPECT_EQ(deciding(root, {0, 0, 1}), (Found{2}));
  EXPECT_EQ(deciding(root, {1, 0, 1}), (Found{2}));
  EXPECT_EQ(deciding(root, {0, 1, 1}), (Found{2}));
  EXPECT_EQ(deciding(root, {1, 1, 1}), (Found{}));
}

TEST_F(ExpressionTest, NegationExclusiveOrAndSelect) {
  const ValueId a = condition(), b = condition(), c = condition();
  EXPECT_EQ(deciding(b_.not_(a), {0, 0, 0}), (Found{0}));
  EXPECT_EQ(deciding(b_.xor_(a, b), {1, 0, 0}), (Found{0, 1}));
  const ValueId chosen = b_.select(a, b, c);
  EXPECT_EQ(deciding(chosen, {1, 1, 1}), (Found{1}));
  EXPECT_EQ(deciding(chosen, {1, 1, 0}), (Found{0, 1}));
  EXPECT_EQ(deciding(chosen, {0, 1, 0}), (Found{0, 2}));
}

// A value that is no logic of bits is held still; one that is a condition itself hides what it comes from.
TEST_F(ExpressionTest, OtherValuesAreHeldStill) {
  const ValueId a = condition(), b = condition();
  const ValueId greater = b_.ltU(b_.zextOrTrunc(Type::I32, b), b_.i32(1));
  const ValueId root = b_.and_(a, greater);
  EXPECT_EQ(Expression(rung_, root, conditions_).conditions(), (Found{0}));
  EXPECT_EQ(deciding(root, {1, 0}), (Found{0}));
  EXPECT_EQ(deciding(root, {1, 1}), (Found{}));
  const ValueId both = b_.or_(a, b);
  conditions_.push_back(both);
  EXPECT_EQ(Expression(rung_, b_.not_(both), conditions_).conditions(), (Found{2}));
  EXPECT_EQ(Expression(rung_, both, conditions_).conditions(), (Found{2}));
}

TEST_F(ExpressionTest, AConstantDecidesNothing) {
  condition();
  EXPECT_TRUE(Expression(rung_, b_.bit(true), conditions_).conditions().empty());
}

// More conditions than one word has lanes.
TEST_F(ExpressionTest, LongSeries) {
  constexpr size_t kContacts = 200;
  ValueId root = condition();
  while (conditions_.size() < kContacts) root = b_.and_(root, condition());
  std::vector<bool> bits(kContacts, true);
  EXPECT_EQ(deciding(root, bits).size(), kContacts);
  bits[137] = false;
  EXPECT_EQ(deciding(root, bits), (Found{137}));
  bits[3] = false;
  EXPECT_EQ(deciding(root, bits), (Found{}));
}

class RandomExpression : public ExpressionTest, public ::testing::WithParamInterface<uint32_t> {
protected:
  ValueId grow(std::mt19937& random, std::vector<ValueId>& values) {
    const auto pick = [&] { return values[random() % values.size()]; };
    switch (random() % 5) {
    case 0: return b_.and_(pick(), pick());
    case 1: return b_.or_(pick(), pick());
    case 2: return b_.xor_(pick(), pick());
    case 3: return b_.not_(pick());
    default: return b_.select(pick(), pick(), pick());
    }
  }
};
INSTANTIATE_TEST_SUITE_P(Seeds, RandomExpression, ::testing::Range(0u, 40u));

TEST_P(RandomExpression, AgreesWithFlippingOneByOne) {
  std::mt19937 random(GetParam());
  const size_t contacts = 1 + random() % 90;
  std::vector<ValueId> values;
  while (conditions_.size() < contacts) values.push_back(condition());
  while (values.size() < contacts * 2 + 8) values.push_back(grow(random, values));
  for (int round = 0; round < 6; ++round) {
    std::vector<bool> bits;
    while (bits.size() < contacts) bits.push_back(random() % 2 != 0);
    for (size_t root = values.size() - 4; root < values.size(); ++root)
      ASSERT_EQ(deciding(values[root], bits), flippedOneByOne(values[root], bits));
  }
}

} // namespace
} // namespace rung::report

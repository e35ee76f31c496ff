// The table of operations: rows agree with themselves, and the look-ups find them.
#include <gtest/gtest.h>

#include "ir/core/eval.h"
#include "ir/core/module.h"
#include "ir/core/op_info.h"
#include "ir/core/ops.h"

namespace rung::ir {
namespace {

TEST(OpInfo, RowsAreFoundByCodeAndName) {
  ASSERT_EQ(allOps().size(), static_cast<size_t>(kOpCount));
  for (const OpInfo& info : allOps()) {
    EXPECT_EQ(&opInfo(info.code), &info);
    EXPECT_EQ(findOp(info.name), &info);
  }
  EXPECT_EQ(findOp("no such operation"), nullptr);
  EXPECT_EQ(findOp(""), nullptr);
}

TEST(OpInfo, RowsAreWellFormed) {
  for (const OpInfo& info : allOps()) {
    SCOPED_TRACE(info.name);
    bool ended = false;
    for (Constraint constraint : info.operands) {
      EXPECT_FALSE(ended && constraint != Constraint::None) << "an operand behind the last";
      ended = ended || constraint == Constraint::None || constraint == Constraint::Variadic;
      if (constraint == Constraint::Same || constraint == Constraint::Narrower || constraint == Constraint::Wider) {
        EXPECT_NE(info.types, kNoTypes) << "needs a type";
      }
    }
    const bool access = info.attr == Attr::Place || info.attr == Attr::Window || info.attr == Attr::Slot;
    EXPECT_EQ((info.effects & (kReads | kWrites)) != 0, access || hostReads(info)) << "only accesses touch memory";
    EXPECT_EQ(hostReads(info), info.code == OpCode::ServiceRequest) << "the one function that may look at memory";
    EXPECT_EQ(info.result == Constraint::Variadic && (info.effects & kStructure) == 0, false)
        << "only regions give several results";
  }
}

// For every type of a row there are operands.
TEST(OpInfo, EveryTypeCanBeUsed) {
  for (const OpInfo& info : allOps())
    for (int t = 1; t < kTypeCount; ++t) {
      const Type own = static_cast<Type>(t);
      if (!contains(info.types, own)) continue;
      for (int i = 0; i < info.fixed; ++i) {
        bool any = false;
        for (int k = 1; k < kTypeCount; ++k)
          any = any || satisfies(info.operands[static_cast<size_t>(i)], own, static_cast<Type>(k));
        EXPECT_TRUE(any) << info.name << " of " << typeName(own) << ", operand " << i;
      }
    }
}

TEST(OpInfo, Constraints) {
  EXPECT_TRUE(satisfies(Constraint::Narrower, Type::I16, Type::Bit));
  EXPECT_TRUE(satisfies(Constraint::Narrower, Type::I16, Type::I8));
  EXPECT_FALSE(satisfies(Constraint::Narrower, Type::I16, Type::I16));
  EXPECT_FALSE(satisfies(Constraint::Wider, Type::I16, Type::I16));
  EXPECT_FALSE(satisfies(Constraint::Wider, Type::I16, Type::F64));
  EXPECT_TRUE(satisfies(Constraint::Wider, Type::Bit, Type::I8));
  EXPECT_FALSE(satisfies(Constraint::AnyInt, Type::F64, Type::Bit));
  EXPECT_EQ(resultType(Constraint::Same, Type::I8), Type::I8);
  EXPECT_EQ(resultType(Constraint::Bit, Type::I8), Type::Bit);
  EXPECT_EQ(resultType(Constraint::Variadic, Type::None), Type::None);
}

TEST(OpInfo, TypesHaveNamesAndWidths) {
  for (int i = 0; i < kTypeCount; ++i) EXPECT_EQ(typeFromName(typeName(static_cast<Type>(i))), static_cast<Type>(i));
  EXPECT_EQ(typeFromName("f32"), std::nullopt);
  for (uint32_t bytes : {1u, 2u, 4u, 8u}) EXPECT_EQ(byteWidth(intOfBytes(bytes)), bytes);
  EXPECT_EQ(intOfBytes(3), Type::None);
  EXPECT_EQ(valueMask(Type::Bit), 1u);
  EXPECT_EQ(valueMask(Type::I32), 0xFFFFFFFFu);
  EXPECT_EQ(valueMask(Type::F64), ~0ull);
}

TEST(Module, FindsByName) {
  Module module;
  module.spaces = {{.name = "X"}, {.name = "Y"}};
  module.routines = {{.name = "MAIN", .rungs = {}}};
  module.tasks = {{.name = "T0"}, {.name = "T1"}};
  EXPECT_EQ(findSpace(module, "Y"), SpaceId{1});
  EXPECT_FALSE(findSpace(module, "Z").valid());
  EXPECT_EQ(findRoutine(module, "MAIN"), RoutineId{0});
  EXPECT_EQ(findTask(module, "T1"), TaskId{1});
  EXPECT_FALSE(findTask(module, "").valid());
}

} // namespace
} // namespace rung::ir

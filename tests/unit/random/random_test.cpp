// The generators of test modules: what they make is valid, round-trips, is the same each time, and has what it
// promises.
#include <gtest/gtest.h>

#include <set>

#include "ir/core/op_info.h"
#include "ir/core/ops.h"
#include "ir/support/hash.h"
#include "ir/text/text.h"
#include "ir/verify/verify.h"
#include "tests/random/random.h"

namespace rung::ir {
namespace {

bool has(const Module& module, OpCode code) {
  for (const Routine& routine : module.routines)
    for (const Rung& rung : routine.rungs)
      for (const Op& op : rung.ops)
        if (op.code == code) return true;
  return false;
}

void expectValid(const Module& module) {
  const std::vector<VerifyError> errors = verify(module, Mode::Final);
  EXPECT_TRUE(errors.empty()) << module.name << '\n' << render(module, errors);
}

TEST(RandomModule, IsValid) {
  for (uint64_t seed = 0; seed < 500; ++seed) expectValid(randomModule(seed));
}

TEST(RandomModule, ReadsBackFromItsText) {
  for (uint64_t seed = 0; seed < 200; ++seed) {
    const std::string text = print(randomModule(seed));
    const ParseOutcome parsed = parse(text);
    ASSERT_TRUE(parsed.module) << "seed " << seed << ", line " << parsed.error.line << ": " << parsed.error.message;
    EXPECT_EQ(print(*parsed.module), text) << "seed " << seed;
  }
}

// Seeds that are written down somewhere keep their meaning. Another hash here is right only when the generator or the
// table of operations changed.
TEST(RandomModule, AndThoseOfOperationsAreTheSameOnEveryMachine) {
  uint64_t hash = kHashSeed;
  for (uint64_t seed = 0; seed < 20; ++seed) hash = hashBytes(print(randomModule(seed)), hash);
  for (const OpInfo& info : allOps()) hash = hashBytes(print(moduleForOp(info.code)), hash);
  EXPECT_EQ(hash, 10600002825566087842u);
}

TEST(RandomModule, HasEveryOperation) {
  std::set<OpCode> seen;
  for (uint64_t seed = 0; seed < 300; ++seed) {
    const Module module = randomModule(seed);
    for (const OpInfo& info : allOps())
      if (has(module, info.code)) seen.insert(info.code);
  }
  for (const OpInfo& info : allOps()) {
    const bool profile = info.code == OpCode::ProfEnter || info.code == OpCode::ProfLeave; // put in by a pass
    EXPECT_EQ(seen.count(info.code) != 0, !profile) << info.name;
  }
}

TEST(RandomModule, HasEveryTransfer) {
  std::set<TransferKind> seen;
  for (uint64_t seed = 0; seed < 100; ++seed)
    for (const Routine& routine : randomModule(seed).routines)
      for (const Rung& rung : routine.rungs) seen.insert(rung.transfer.kind);
  EXPECT_EQ(seen.size(), 6u);
}

TEST(RandomModule, LeavesOutWhatIsNotWanted) {
  for (uint64_t seed = 0; seed < 60; ++seed) {
    const Module module = randomModule(seed, {.routines = 2,
                                              .rungs = 4,
                                              .ops = 40,
                                              .floats = false,
                                              .regions = false,
                                              .jumps = false,
                                              .host = false,
                                              .traps = false});
    expectValid(module);
    for (OpCode code : {OpCode::FAdd, OpCode::IntToF, OpCode::If, OpCode::Loop, OpCode::Message, OpCode::ServiceRequest,
                        OpCode::Trap})
      EXPECT_FALSE(has(module, code)) << opInfo(code).name;
    for (const Routine& routine : module.routines)
      for (const Rung& rung : routine.rungs) {
        EXPECT_EQ(rung.transfer.kind, TransferKind::Next);
        for (Type type : rung.values) EXPECT_NE(type, Type::F64);
      }
  }
}

TEST(ModuleForOp, DoesTheOperationForEveryType) {
  for (const OpInfo& info : allOps()) {
    const Module module = moduleForOp(info.code);
    expectValid(module);
    std::set<Type> types;
    for (const Rung& rung : module.routines[0].rungs)
      for (const Op& op : rung.ops)
        if (op.code == info.code) types.insert(op.type);
    for (int i = 0; i < kTypeCount; ++i)
      EXPECT_EQ(types.count(static_cast<Type>(i)) != 0, contains(info.types, static_cast<Type>(i)))
          << info.name << " " << i;
    const std::string text = print(module);
    const ParseOutcome parsed = parse(text);
    ASSERT_TRUE(parsed.module) << info.name << ", line " << parsed.error.line << ": " << parsed.error.message;
    EXPECT_EQ(print(*parsed.module), text);
  }
}

} // namespace
} // namespace rung::ir

// What the host finds in memory while a chunk runs: at a service request every store above it has been done and none
// below, on every engine.
#include <gtest/gtest.h>

#include <array>

#include "ir/core/builder.h"
#include "tests/support/differential.h"

namespace rung {
namespace {

using compiler::EngineKind;
using namespace ir;

constexpr SpaceId kWords{0};
constexpr SpaceId kBits{1};
constexpr Place kCell{kWords, 0, 0};
constexpr Place kFlag{kBits, 0, 3};

// Answers with what it finds in the cell and the flag.
class Reader final : public runtime::ScheduleHooks {
public:
  bool respond(runtime::Instance& instance, const core::ServiceRequest& request, core::ServiceReply& reply) override {
    reply.ticket = request.ticket;
    reply.resultCount = 2;
    reply.results[0] = static_cast<int64_t>(instance.memory().read(0, 0, 4));
    reply.results[1] = instance.memory().readBit(1, 0, 3) ? 1 : 0;
    return true;
  }
};

// Stores the results at word `to`.
void ask(RungBuilder& b, uint32_t to) {
  const ValueId ticket = b.serviceRequest(ServiceId{0}, std::array<ValueId, 0>{});
  b.store({kWords, to, 0}, b.zextOrTrunc(Type::I32, b.serviceResult(ticket, 0)));
  b.store({kWords, to + 4, 0}, b.zextOrTrunc(Type::I32, b.serviceResult(ticket, 1)));
}

void setBoth(RungBuilder& b, int64_t word, bool bit) {
  b.store(kCell, b.i32(word));
  b.store(kFlag, b.bit(bit));
}

// Rung 0: stores before and after a request; through a window too. Rungs 1 to 3, in the same chunk: stores, request and
// stores in rungs of their own.
Module askingModule() {
  Module m;
  m.name = "asking";
  m.dialect = "test";
  m.files = {"asking"};
  m.faults = {"dead-loop"};
  m.services = {"READ"};
  m.spaces = {{.name = "W", .unitBytes = 4, .units = 16}, {.name = "B", .unitBytes = 1, .units = 4}};
  m.routines.push_back({.name = "MAIN", .rungs = {}});
  std::vector<Rung>& rungs = m.routines[0].rungs;
  rungs.resize(4);
  {
    RungBuilder b(m, rungs[0]);
    setBoth(b, 11, true);
    ask(b, 8);
    setBoth(b, 12, false);
    const ValueId index = b.load(Type::I32, {kWords, 60, 0}); // 0
    b.storeAt({.space = kWords, .byte = 0, .count = 2}, index, b.i32(13));
    ask(b, 16);
    b.storeAt({.space = kWords, .byte = 0, .count = 2}, index, b.i32(14));
  }
  {
    RungBuilder b(m, rungs[1]);
    setBoth(b, 21, true);
  }
  {
    RungBuilder b(m, rungs[2]);
    ask(b, 24);
  }
  {
    RungBuilder b(m, rungs[3]);
    setBoth(b, 22, false);
  }
  m.tasks.push_back(
      {.name = "MAIN", .entry = RoutineId{0}, .periodUs = 8000, .budget = 1000, .budgetFault = FaultId{0}});
  m.mainTask = TaskId{0};
  m.scan = {{RUNG_STEP_ADVANCE, {}, 8000}, {RUNG_STEP_RUN, TaskId{0}, 1}};
  return m;
}

struct Variant {
  EngineKind kind;
  bool optimise;
  const char* compiler;
  const char* name;
};
constexpr Variant kVariants[] = {
    {EngineKind::Interp, true, "", "Interp"}, {EngineKind::Cpp, true, "clang++-19", "CppClang"},
    {EngineKind::Cpp, true, "g++", "CppGcc"}, {EngineKind::Jit, false, "", "JitFast"},
    {EngineKind::Jit, true, "", "JitOpt"},    {EngineKind::Llvm, true, "", "LlvmSo"},
};

class HostReads : public ::testing::TestWithParam<Variant> {};

TEST_P(HostReads, WhatTheProgramHasStored) {
  const compiler::Compiled compiled = testing::compiledFrom(askingModule());
  ASSERT_EQ(compiled.layout->partition().chunks().size(), 1u);
  compiler::EngineOptions options;
  options.optimise = GetParam().optimise;
  options.cppCompiler = GetParam().compiler;
  auto engine = compiler::makeEngine(GetParam().kind, compiled, options);
  ASSERT_TRUE(engine.ok()) << engine.error();
  Reader reader;
  const auto instance = std::make_unique<runtime::Instance>(*engine.value(), &reader);
  instance->scan();
  ASSERT_FALSE(instance->faulted()) << instance->faultText();
  const auto word = [&](uint32_t byte) { return instance->memory().read(0, byte, 4); };
  EXPECT_EQ(word(8), 11u);
  EXPECT_EQ(word(12), 1u);
  EXPECT_EQ(word(16), 13u);
  EXPECT_EQ(word(20), 0u);
  EXPECT_EQ(word(24), 21u);
  EXPECT_EQ(word(28), 1u);
  EXPECT_EQ(word(0), 22u);
}

INSTANTIATE_TEST_SUITE_P(Engines, HostReads, ::testing::ValuesIn(kVariants),
                         [](const auto& tested) { return std::string(tested.param.name); });

} // namespace
} // namespace rung

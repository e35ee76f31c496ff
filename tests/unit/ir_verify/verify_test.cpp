// The verifier: each rule is broken by itself, in each way that its function tells apart, in a module that is right
// otherwise. What errors look like is a golden in tests/golden/ir.
#include <gtest/gtest.h>

#include <functional>
#include <set>

#include "ir/core/builder.h"
#include "ir/core/op_info.h"
#include "ir/core/ops.h"
#include "ir/verify/verify.h"
#include "tests/random/random.h"

namespace rung::ir {
namespace {

constexpr SpaceId kD{0};
constexpr uint32_t kSpaceBytes = 64;

// A module that keeps all rules and uses every kind of declaration; one rung, to be filled.
Module goodModule() {
  Module m;
  m.name = "m";
  m.files = {"a.lad"};
  m.spaces = {{.name = "D", .unitBytes = 4, .units = kSpaceBytes / 4},
              {.name = "E", .unitBytes = 1, .units = kSpaceBytes, .flags = RUNG_SPACE_HIDDEN}};
  m.slots = {{.type = Type::I16, .init = 0xFFFF, .key = "s0"}, {.type = Type::Bit, .key = "s1"}};
  m.symbols = {{.name = "S", .space = kD, .byte = 1, .bit = 7},
               {.name = "A", .space = kD, .byte = 60, .type = RUNG_TYPE_I16, .count = 2},
               {.name = "C", .type = RUNG_TYPE_I64, .flags = RUNG_SYMBOL_CONST, .value = 3}};
  m.inits = {{kD, 62, {1, 2}}};
  m.retains = {{kD, 0, kSpaceBytes}};
  m.safeSpans = {{SpaceId{1}, kSpaceBytes, 0}};
  m.faults = {"budget"};
  m.services = {"ASK"};
  m.messages = {{1, "one"}};
  Rung rung;
  rung.begin = {FileIndex{0}, 3, 1};
  rung.lastLine = 4;
  m.routines = {{.name = "MAIN", .rungs = {rung}}, {.name = "SUB", .rungs = {rung}}};
  m.tasks = {{.name = "T", .entry = RoutineId{0}, .budgetFault = FaultId{0}}};
  m.tasks[0].begin = {{.from = {kD, 0, 8}, .to = kD, .toByte = 8}};
  m.tasks[0].end = {{.masked = true, .from = {kD, 0, 8}, .to = SpaceId{1}, .mask = SpaceId{1}, .maskByte = 56}};
  m.mainTask = TaskId{0};
  m.scan = {{RUNG_STEP_ADVANCE, {}, 5}, {RUNG_STEP_RUN, TaskId{0}, 1}};
  return m;
}
Rung& rungOf(Module& m) { return m.routines[0].rungs[0]; }

// A module whose first rung is built by `fill`.
Module withRung(const std::function<void(RungBuilder&)>& fill) {
  Module m = goodModule();
  Rung rung = rungOf(m);
  RungBuilder builder(m, rung);
  fill(builder);
  rungOf(m) = rung;
  return m;
}

void expectGood(const Module& m, Mode mode = Mode::Final) {
  const std::vector<VerifyError> errors = verify(m, mode);
  EXPECT_TRUE(errors.empty()) << render(m, errors);
}

// Exactly one error, of this rule, with this text in its message.
void expectBroken(const Module& m, Rule rule, std::string_view part, uint32_t op = RUNG_NONE, Mode mode = Mode::Final) {
  const std::vector<VerifyError> errors = verify(m, mode);
  ASSERT_EQ(errors.size(), 1u) << part << '\n' << render(m, errors);
  EXPECT_EQ(ruleName(errors[0].rule), ruleName(rule)) << errors[0].message;
  EXPECT_NE(errors[0].message.find(part), std::string::npos) << errors[0].message;
  EXPECT_EQ(errors[0].op, op) << errors[0].message;
  EXPECT_NE(render(m, errors).find(errors[0].message), std::string::npos);
}

void expectBroken(const std::function<void(Module&)>& breakIt, Rule rule, std::string_view part,
                  Mode mode = Mode::Final) {
  Module m = goodModule();
  breakIt(m);
  expectBroken(m, rule, part, RUNG_NONE, mode);
}

// The first rung, built, then broken; the error stands at operation `op`.
void expectRungBroken(const std::function<void(RungBuilder&)>& fill, const std::function<void(Rung&)>& breakIt,
                      Rule rule, std::string_view part, uint32_t op) {
  Module m = withRung(fill);
  expectGood(m);
  breakIt(rungOf(m));
  expectBroken(m, rule, part, op);
}

TEST(Verify, GoodModules) {
  expectGood(goodModule());
  Module built = goodModule();
  built.mainTask = {};
  expectGood(built, Mode::Built);
  for (const OpInfo& info : allOps()) expectGood(moduleForOp(info.code));
}

TEST(Verify, RulesHaveNames) {
  std::set<std::string_view> names;
  for (int i = 0; i < kRuleCount; ++i) names.insert(ruleName(static_cast<Rule>(i)));
  EXPECT_EQ(names.size(), static_cast<size_t>(kRuleCount));
  EXPECT_EQ(names.count(""), 0u);
}

// ---- module --------------------------------------------------------------------------------------------------------

TEST(VerifyModule, Names) {
  expectBroken([](Module& m) { m.files.push_back("a.lad"); }, Rule::Names, "two files");
  expectBroken([](Module& m) { m.files.push_back(""); }, Rule::Names, "a file without");
  expectBroken([](Module& m) { m.spaces[1].name = "D"; }, Rule::Names, "two spaces are named 'D'");
  expectBroken([](Module& m) { m.slots[1].key = "s0"; }, Rule::Names, "two slots");
  expectBroken([](Module& m) { m.slots[1].key = ""; }, Rule::Names, "a slot without");
  expectBroken([](Module& m) { m.routines[1].name = "MAIN"; }, Rule::Names, "two routines");
  expectBroken([](Module& m) { m.tasks.push_back(m.tasks[0]); }, Rule::Names, "two tasks");
  expectBroken([](Module& m) { m.faults.push_back("budget"); }, Rule::Names, "two faults");
  expectBroken([](Module& m) { m.services.push_back("ASK"); }, Rule::Names, "two services");
  expectBroken([](Module& m) { m.messages.push_back({1, "other"}); }, Rule::Names, "two messages have number 1");
  expectBroken([](Module& m) { m.symbols[0].name = ""; }, Rule::Names, "a symbol without");
}

TEST(VerifyModule, Spaces) {
  expectBroken([](Module& m) { m.spaces[1].unitBytes = 3, m.spaces[1].units = 32; }, Rule::Spaces, "units of 3 bytes");
  expectBroken([](Module& m) { m.spaces[1].units = (1u << 30) + 1; }, Rule::Spaces, "larger");
  expectBroken([](Module& m) { m.spaces[1].flags = 16; }, Rule::Spaces, "unknown flags");
  expectBroken(
      [](Module& m) {
        for (const char* name : {"BIG", "BIGGER"})
          m.spaces.push_back({.name = name, .unitBytes = 1, .units = 1u << 29});
      },
      Rule::Spaces, "together");
}

TEST(VerifyModule, Slots) {
  expectBroken([](Module& m) { m.slots[0].type = Type::None; }, Rule::Slots, "no type");
  expectBroken([](Module& m) { m.slots[0].init = 0x10000; }, Rule::Slots, "cannot hold");
  expectBroken([](Module& m) { m.slots[1].init = -1; }, Rule::Slots, "cannot hold");
  const auto continuation = [](const Continuation& c) { return [c](Module& m) { m.continuations = {c}; }; };
  expectBroken(continuation({.key = "C", .slot = SlotId{99}, .points = {"0"}}), Rule::Slots, "not in a cell");
  expectBroken(continuation({.key = "C", .space = SpaceId{0}, .byte = 1000000, .points = {"0"}}), Rule::Slots,
               "not in a cell");
  expectBroken(continuation({.key = "C", .space = SpaceId{0}}), Rule::Slots, "no points");
  expectBroken(continuation({.key = "C", .space = SpaceId{0}, .points = {"0", "1", "0"}}), Rule::Slots, "two points");
}

TEST(VerifyModule, Timers) {
  const auto timer = [](const std::function<void(Timer&)>& change) {
    return [change](Module& m) {
      m.timers = {{.name = "T", .time = {.type = Type::I32, .slot = {}, .space = SpaceId{0}}, .unitsUs = {1}}};
      change(m.timers[0]);
    };
  };
  expectBroken(timer([](Timer& t) { t.time = {}; }), Rule::Slots, "no cell for its time");
  expectBroken(timer([](Timer& t) { t.time.type = Type::Bit; }), Rule::Slots, "no cell for its time");
  expectBroken(timer([](Timer& t) { t.time.byte = kSpaceBytes - 3; }), Rule::Slots, "no cell for its time");
  expectBroken(timer([](Timer& t) { t.time.slot = SlotId{99}; }), Rule::Slots, "no cell for its time");
  expectBroken(timer([](Timer& t) { t.preset = {.type = Type::I16, .slot = SlotId{99}, .space = {}}; }), Rule::Slots,
               "no cell for its preset");
  expectBroken(timer([](Timer& t) { t.unit = {.type = Type::I16, .slot = {}, .space = SpaceId{99}}; }), Rule::Slots,
               "no cell for its unit");
  expectBroken(timer([](Timer& t) { t.unitsUs.clear(); }), Rule::Slots, "has no unit");
  expectBroken(timer([](Timer& t) { t.flags = 4; }), Rule::Slots, "unknown flags");
  expectBroken(timer([](Timer& t) { t.running = SlotId{99}; }), Rule::Slots, "whether it runs");
}

TEST(VerifyModule, Symbols) {
  expectBroken([](Module& m) { m.symbols[0].byte = kSpaceBytes; }, Rule::Symbols, "outside its space");
  expectBroken([](Module& m) { m.symbols[0].space = SpaceId{2}; }, Rule::Symbols, "outside its space");
  expectBroken([](Module& m) { m.symbols[0].space = {}; }, Rule::Symbols, "outside its space");
  expectBroken([](Module& m) { m.symbols[0].bit = 8; }, Rule::Symbols, "within a byte");
  expectBroken([](Module& m) { m.symbols[1].bit = 1, m.symbols[1].byte = 0; }, Rule::Symbols, "within a byte");
  expectBroken([](Module& m) { m.symbols[1].count = 3; }, Rule::Symbols, "outside its space");
  expectBroken([](Module& m) { m.symbols[1].count = 0; }, Rule::Symbols, "no elements");
  expectBroken([](Module& m) { m.symbols[0].type = 8, m.symbols[0].bit = 0; }, Rule::Symbols, "unknown type");
  expectBroken([](Module& m) { m.symbols[0].flags = 16; }, Rule::Symbols, "unknown flags");
  for (uint32_t type = RUNG_TYPE_BIT; type <= RUNG_TYPE_TEXT; ++type) {
    Module m = goodModule();
    m.symbols[0] = {.name = "S", .space = kD, .byte = 0, .type = type};
    expectGood(m);
  }
}

TEST(VerifyModule, Spans) {
  expectBroken([](Module& m) { m.inits[0].byte = 63; }, Rule::Spans, "initial value");
  expectBroken([](Module& m) { m.inits[0].space = {}; }, Rule::Spans, "initial value");
  expectBroken([](Module& m) { m.retains[0].byte = 1; }, Rule::Spans, "retained");
  expectBroken([](Module& m) { m.retains[0].size = UINT32_MAX, m.retains[0].byte = 1; }, Rule::Spans, "retained");
  expectBroken([](Module& m) { m.safeSpans[0].size = 1; }, Rule::Spans, "safe");
}

TEST(VerifyModule, Copies) {
  expectBroken([](Module& m) { m.tasks[0].begin[0].from.size = 0; }, Rule::Copies, "copies nothing");
  expectBroken([](Module& m) { m.tasks[0].end[0].from.byte = 57; }, Rule::Copies, "reads outside");
  expectBroken([](Module& m) { m.tasks[0].begin[0].toByte = 57; }, Rule::Copies, "writes outside");
  expectBroken([](Module& m) { m.tasks[0].begin[0].to = {}; }, Rule::Copies, "writes outside");
  expectBroken([](Module& m) { m.tasks[0].begin[0].toByte = 7; }, Rule::Copies, "overlaps itself");
  expectBroken([](Module& m) { m.tasks[0].end[0].maskByte = 57; }, Rule::Copies, "mask outside");
  expectBroken([](Module& m) { m.tasks[0].end[0].masked = false; }, Rule::Copies, "mask that it does not use");
}

TEST(VerifyModule, Tasks) {
  expectBroken([](Module& m) { m.tasks[0].entry = RoutineId{2}; }, Rule::Tasks, "no entry");
  expectBroken([](Module& m) { m.tasks[0].budgetFault = {}; }, Rule::Tasks, "no fault");
  expectBroken([](Module& m) { m.tasks[0].parts = 0; }, Rule::Tasks, "no parts");
  expectBroken([](Module& m) { m.tasks[0].borders = {1}; }, Rule::Tasks, "borders");
  expectBroken(
      [](Module& m) {
        m.tasks[0].parts = 3;
        m.tasks[0].borders = {1, 1};
      },
      Rule::Tasks, "borders");
  expectBroken(
      [](Module& m) {
        m.tasks[0].parts = 2;
        m.tasks[0].borders = {9999};
      },
      Rule::Tasks, "borders");
  expectBroken([](Module& m) { m.tasks[0].budget = 0; }, Rule::Tasks, "no budget");
}

TEST(VerifyModule, Schedule) {
  expectBroken([](Module& m) { m.mainTask = {}; }, Rule::Schedule, "no main task");
  expectBroken([](Module& m) { m.mainTask = TaskId{1}; }, Rule::Schedule, "no main task", Mode::Built);
  expectBroken([](Module& m) { m.fastTask = TaskId{1}; }, Rule::Schedule, "fast task");
  expectBroken([](Module& m) { m.scan[0].op = 5; }, Rule::Schedule, "no step 5");
  expectBroken(
      [](Module& m) {
        m.scan.clear();
        m.tasks[0].periodUs = 0;
      },
      Rule::Schedule, "takes no time");
  expectBroken([](Module& m) { m.slices = {{RUNG_STEP_ADVANCE, {}, 1}}; }, Rule::Schedule, "the time of a scan");
  expectBroken([](Module& m) { m.scan[0].task = TaskId{0}; }, Rule::Schedule, "does not use");
  expectBroken([](Module& m) { m.scan[1].task = {}; }, Rule::Schedule, "without its task");
  expectBroken([](Module& m) { m.fast.push_back({RUNG_STEP_PART, TaskId{7}, 1}); }, Rule::Schedule, "without its task");
}

TEST(VerifyModule, Routines) {
  expectBroken([](Module& m) { m.routines[1].rungs.clear(); }, Rule::Routines, "no rung");
}

// ---- calls ---------------------------------------------------------------------------------------------------------

Module callChain(uint32_t routines) {
  Module m = goodModule();
  m.routines.clear();
  for (uint32_t i = 0; i < routines; ++i) {
    Rung rung;
    if (i + 1 < routines) rung.transfer = {.kind = TransferKind::Call, .callee = RoutineId{i + 1}};
    m.routines.push_back({.name = "R" + std::to_string(i), .rungs = {Rung{}, rung}});
  }
  return m;
}

TEST(VerifyCalls, NoLoops) {
  Module m = callChain(3);
  m.routines[2].rungs[0].transfer = {.kind = TransferKind::Call, .callee = RoutineId{0}};
  expectBroken(m, Rule::Calls, "in a loop", 0);
  m = callChain(1);
  m.routines[0].rungs[0].transfer = {.kind = TransferKind::Call, .callee = RoutineId{0}};
  expectBroken(m, Rule::Calls, "in a loop", 0);
}

TEST(VerifyCalls, NotTooDeep) {
  expectGood(callChain(RUNG_STACK_DEPTH));
  expectBroken(callChain(RUNG_STACK_DEPTH + 1), Rule::Calls, "nested more than 127 deep", 0);
  // Wide is not deep, and a routine that many call is looked at once.
  Module m = callChain(60);
  for (uint32_t i = 0; i < 59; ++i)
    m.routines[i].rungs[0].transfer = {.kind = TransferKind::Call, .callee = RoutineId{i + 1}};
  expectGood(m);
}

TEST(VerifyCalls, LongCyclesDoNotOverflowTheStack) {
  Module m = callChain(100000);
  m.routines.back().rungs[0].transfer = {.kind = TransferKind::Call, .callee = RoutineId{0}};
  EXPECT_FALSE(verify(m, Mode::Final).empty());
}

// ---- rung ----------------------------------------------------------------------------------------------------------

TEST(VerifyRung, Header) {
  expectBroken([](Module& m) { rungOf(m).begin.file = FileIndex{1}; }, Rule::Header, "file");
  expectBroken([](Module& m) { rungOf(m).begin.file = {}; }, Rule::Header, "file");
  expectBroken([](Module& m) { rungOf(m).lastLine = 2; }, Rule::Header, "last line");
  expectBroken([](Module& m) { rungOf(m).weight = 0; }, Rule::Header, "weight");
}

void addition(RungBuilder& b) {
  const ValueId a = b.i32(5);
  b.add(a, a);
  b.note("x");
}

TEST(VerifyRung, Form) {
  const auto broken = [](const std::function<void(Rung&)>& breakIt, std::string_view part, uint32_t op) {
    expectRungBroken(addition, breakIt, Rule::Form, part, op);
  };
  broken([](Rung& r) { r.ops[1].type = Type::Bit; }, "add has no type bit", 1);
  broken([](Rung& r) { r.ops[1].argCount = 1, r.args.pop_back(); }, "1 operands", 1);
  broken([](Rung& r) { r.ops[1].resultCount = 0, r.ops[1].result = {}, r.values.pop_back(); }, "0 results", 1);
  broken([](Rung& r) { r.ops[2].result = ValueId{0}; }, "without results", 2);
  broken([](Rung& r) { r.ops[1].imm = 1; }, "does not use", 1);
  broken([](Rung& r) { r.ops[1].ref = 1; }, "does not use", 1);
  broken([](Rung& r) { r.ops[0].count = 1; }, "does not use", 0);
  broken([](Rung& r) { r.ops[0].imm = 1ll << 32; }, "wider than its type", 0);
  broken([](Rung& r) { r.ops[1].firstArg = 1; }, "operands out of sequence", 1);
  broken([](Rung& r) { r.args.pop_back(); }, "operands out of sequence", 1);
  broken([](Rung& r) { r.ops[1].result = ValueId{0}; }, "results out of sequence", 1);
  broken([](Rung& r) { r.values.pop_back(); }, "results out of sequence", 1);
  broken([](Rung& r) { r.ops[2].ref = 1; }, "notes out of sequence", 2);
  broken([](Rung& r) { r.notes.clear(); }, "notes out of sequence", 2);
  broken([](Rung& r) { r.args.push_back(ValueId{0}); }, "of no operation", RUNG_NONE);
  broken([](Rung& r) { r.values.push_back(Type::Bit); }, "of no operation", RUNG_NONE);
  broken([](Rung& r) { r.notes.push_back("y"); }, "of no operation", RUNG_NONE);
}

TEST(VerifyRung, Regions) {
  const auto ifElse = [](RungBuilder& b) {
    b.if_(b.bit(true));
    b.else_();
    b.endIf();
  };
  const auto loop = [](RungBuilder& b) {
    b.loop(2);
    b.endLoop();
  };
  const auto broken = [](const auto& fill, const std::function<void(Rung&)>& breakIt, std::string_view part,
                         uint32_t op) { expectRungBroken(fill, breakIt, Rule::Regions, part, op); };
  broken(ifElse, [](Rung& r) { r.ops.pop_back(); }, "not closed", 3);
  broken(loop, [](Rung& r) { r.ops.pop_back(); }, "not closed", 1);
  broken(ifElse, [](Rung& r) { r.ops[3].code = OpCode::EndLoop; }, "endloop without loop", 3);
  broken(loop, [](Rung& r) { r.ops[1].code = OpCode::EndIf; }, "endif without if", 1);
  broken(loop, [](Rung& r) { r.ops[1].code = OpCode::Else; }, "else without if", 1);
  broken(ifElse, [](Rung& r) { r.ops.insert(r.ops.begin() + 3, r.ops[2]); }, "else without if", 3);
  broken(ifElse, [](Rung& r) { r.ops.push_back(r.ops[3]); }, "endif without if", 4);
}

TEST(VerifyRung, Scope) {
  expectRungBroken(addition, [](Rung& r) { r.args[1] = ValueId{1}; }, Rule::Scope, "%1 is not defined here", 1);
  expectRungBroken(addition, [](Rung& r) { r.args[1] = ValueId{77}; }, Rule::Scope, "%77 is not defined here", 1);
  expectRungBroken(addition, [](Rung& r) { r.args[1] = {}; }, Rule::Scope, "is not defined here", 1);
  const auto regions = [](RungBuilder& b) {
    const ValueId c = b.bit(true);                             // %0, op 0
    b.if_(c);                                                  // 1
    const ValueId x = b.i32(1);                                // %1, 2
    b.else_(std::vector{x});                                   // 3
    b.not_(b.i32(2));                                          // %2, 4; %3, 5
    const ValueId y = b.endIf(std::vector{b.i32(3)})[0];       // %4, 6; %5, 7
    const std::vector<ValueId> in = b.loop(2, std::vector{y}); // %6, %7; 8
    b.endLoop(std::vector{in[1]});                             // %8, 9
    b.not_(y);                                                 // %9, 10
    b.gotoRung(0, c);
  };
  const auto argOf = [](Rung& r, uint32_t op, uint32_t value) { r.args[r.ops[op].firstArg] = ValueId{value}; };
  for (const uint32_t ended : {1u, 2u, 4u, 6u, 7u})
    expectRungBroken(regions, [&](Rung& r) { argOf(r, 10, ended); }, Rule::Scope, "is not defined here", 10);
  // A value of the branch above the else.
  expectRungBroken(regions, [&](Rung& r) { argOf(r, 5, 1); }, Rule::Scope, "%1 is not defined here", 5);
  expectRungBroken(regions, [&](Rung& r) { argOf(r, 7, 1); }, Rule::Scope, "%1 is not defined here", 7);
  expectRungBroken(regions, [](Rung& r) { r.transfer.cond = ValueId{50}; }, Rule::Scope, "%50 is not defined here", 11);
  expectRungBroken(regions, [](Rung& r) { r.transfer.cond = ValueId{2}; }, Rule::Scope, "%2 is not defined here", 11);
}

TEST(VerifyRung, Types) {
  const auto fill = [](RungBuilder& b) {
    const ValueId word = b.i32(1);
    const ValueId bit = b.bit(true);
    b.select(bit, word, word);
    b.op(OpCode::ZExt, Type::I64, {word});
    b.servicePoll(word);
  };
  expectRungBroken(fill, [](Rung& r) { r.args[0] = ValueId{0}; }, Rule::Types, "operand 0 is i32", 2);
  expectRungBroken(fill, [](Rung& r) { r.args[2] = ValueId{1}; }, Rule::Types, "operand 2 is bit", 2);
  expectRungBroken(fill, [](Rung& r) { r.ops[3].type = r.values[3] = Type::I32; }, Rule::Types, "operand 0 is i32", 3);
  expectRungBroken(fill, [](Rung& r) { r.values[2] = Type::I16; }, Rule::Types, "the result is i16, not i32", 2);
  expectRungBroken(fill, [](Rung& r) { r.values[4] = Type::I64; }, Rule::Types, "the result is i64, not i32", 4);
  const auto region = [](RungBuilder& b) {
    b.if_(b.bit(true));
    const ValueId x = b.i32(1);
    b.else_(std::vector{x});
    b.endIf(std::vector{b.i32(2)});
  };
  expectRungBroken(region, [](Rung& r) { r.values[3] = Type::None; }, Rule::Types, "without a type", 5);
}

TEST(VerifyRung, Yields) {
  const auto fill = [](RungBuilder& b) {
    const ValueId c = b.bit(true); // %0
    const ValueId w = b.i32(1);    // %1
    b.if_(c);
    b.else_(std::vector{w});   // 3
    b.endIf(std::vector{w});   // 4: %2
    b.loop(1, std::vector{w}); // 5: %3, %4
    b.endLoop(std::vector{w}); // 6: %5
  };
  expectRungBroken(
      fill, [](Rung& r) { r.args[r.ops[4].firstArg] = ValueId{0}; }, Rule::Yields, "value 0 is bit, not i32", 4);
  expectRungBroken(fill, [](Rung& r) { r.values[2] = Type::Bit; }, Rule::Yields, "value 0 is bit, not i32", 4);
  expectRungBroken(fill, [](Rung& r) { r.values[3] = Type::I64; }, Rule::Yields, "number of the pass", 5);
  expectRungBroken(fill, [](Rung& r) { r.values[4] = Type::Bit; }, Rule::Yields, "value 0 is bit, not i32", 5);
  expectRungBroken(fill, [](Rung& r) { r.values[5] = Type::Bit; }, Rule::Yields, "value 0 is bit, not i32", 6);
  expectRungBroken(
      fill, [](Rung& r) { r.args[r.ops[6].firstArg] = ValueId{0}; }, Rule::Yields, "value 0 is bit, not i32", 6);
  // Without an else there is nothing to yield.
  Module m = withRung([](RungBuilder& b) {
    const ValueId c = b.bit(true);
    b.if_(c);
    b.else_(std::vector{c});
    b.endIf(std::vector{c});
  });
  Rung& rung = rungOf(m);
  rung.ops.erase(rung.ops.begin() + 2);
  rung.args.pop_back();
  --rung.ops[2].firstArg;
  const std::vector<VerifyError> errors = verify(m, Mode::Final);
  ASSERT_EQ(errors.size(), 2u) << render(m, errors); // operands, and results
  EXPECT_EQ(errors[0].rule, Rule::Yields);
  EXPECT_EQ(errors[0].message, "1 values where 0 are expected");
}

TEST(VerifyRung, Places) {
  const auto load = [](Type type, uint32_t byte) { return [=](RungBuilder& b) { b.load(type, {kD, byte}); }; };
  expectGood(withRung(load(Type::I64, kSpaceBytes - 8)));
  expectGood(withRung(load(Type::Bit, kSpaceBytes - 1)));
  expectBroken(withRung(load(Type::I64, kSpaceBytes - 7)), Rule::Places, "outside its space", 0);
  expectBroken(withRung(load(Type::Bit, kSpaceBytes)), Rule::Places, "outside its space", 0);
  expectRungBroken(load(Type::I8, 0), [](Rung& r) { r.ops[0].imm = 4; }, Rule::Places, "within a byte", 0);
  expectRungBroken(load(Type::I8, 0), [](Rung& r) { r.ops[0].imm = -8; }, Rule::Places, "outside its space", 0);
  expectRungBroken(load(Type::I8, 0), [](Rung& r) { r.ops[0].ref = 2; }, Rule::Places, "does not exist", 0);
}

TEST(VerifyRung, Windows) {
  const auto load = [](Type type, uint32_t byte, uint32_t count) {
    return [=](RungBuilder& b) { b.loadAt(type, {kD, byte, count}, b.i32(0)); };
  };
  expectGood(withRung(load(Type::I32, 4, 15)));
  expectGood(withRung(load(Type::I64, 0, 15)));
  expectGood(withRung(load(Type::I8, 3, 16)));
  expectBroken(withRung(load(Type::I32, 4, 16)), Rule::Windows, "beyond its space", 1);
  expectBroken(withRung(load(Type::I64, 0, 16)), Rule::Windows, "beyond its space", 1);
  expectBroken(withRung(load(Type::I8, 4, 16)), Rule::Windows, "beyond its space", 1);
  expectBroken(withRung(load(Type::I8, 4, UINT32_MAX)), Rule::Windows, "beyond its space", 1);
  expectBroken(withRung(load(Type::I32, 0, 0)), Rule::Windows, "empty", 1);
  expectBroken(withRung([](RungBuilder& b) { b.loadBitAt({kD, 1, 16}, b.i32(0), b.i32(0)); }), Rule::Windows,
               "beyond its space", 2);
  expectRungBroken(load(Type::I8, 0, 1), [](Rung& r) { r.ops[1].imm = 3; }, Rule::Windows, "within a byte", 1);
  expectRungBroken(load(Type::I8, 0, 1), [](Rung& r) { r.ops[1].ref = 9; }, Rule::Windows, "does not exist", 1);
}

TEST(VerifyRung, SlotUse) {
  const auto fill = [](RungBuilder& b) { b.slotLoad(SlotId{0}); };
  expectRungBroken(fill, [](Rung& r) { r.ops[0].ref = 2; }, Rule::SlotUse, "does not exist", 0);
  expectRungBroken(fill, [](Rung& r) { r.ops[0].ref = 1; }, Rule::SlotUse, "the slot is bit", 0);
}

TEST(VerifyRung, Host) {
  const auto message = [](RungBuilder& b) {
    const ValueId n = b.i32(1);
    b.message(RUNG_MESSAGE_LOG, n, n, n, b.constant(Type::I64, 1));
  };
  expectRungBroken(message, [](Rung& r) { r.ops[2].ref = 4; }, Rule::Host, "no such kind", 2);
  expectRungBroken(message, [](Rung& r) { r.args[3] = ValueId{0}; }, Rule::Host, "value of the message is i32", 2);
  const auto request = [](size_t count) {
    return
        [=](RungBuilder& b) { b.serviceRequest(ServiceId{0}, std::vector<ValueId>(count, b.constant(Type::I64, 1))); };
  };
  expectGood(withRung(request(16)));
  expectRungBroken(request(1), [](Rung& r) { r.ops[1].ref = 1; }, Rule::Host, "service does not exist", 1);
  expectRungBroken(
      request(1), [](Rung& r) { r.ops[0].type = r.values[0] = Type::I32; }, Rule::Host, "argument 0 is i32", 1);
  expectRungBroken(
      request(16), [](Rung& r) { ++r.ops[1].argCount, r.args.push_back(ValueId{0}); }, Rule::Host, "too many arguments",
      1);
  const auto result = [](RungBuilder& b) { b.serviceResult(b.i32(1), 15); };
  expectRungBroken(result, [](Rung& r) { r.ops[1].imm = 16; }, Rule::Host, "no such result", 1);
  expectRungBroken(result, [](Rung& r) { r.ops[1].imm = -1; }, Rule::Host, "no such result", 1);
  const auto trap = [](RungBuilder& b) { b.trap(b.bit(false), FaultId{0}); };
  expectRungBroken(trap, [](Rung& r) { r.ops[1].ref = 1; }, Rule::Host, "fault does not exist", 1);
}

TEST(VerifyRung, Loops) {
  const auto nest = [](uint32_t outer, uint32_t inner) {
    return withRung([=](RungBuilder& b) {
      b.loop(outer);
      b.loop(inner);
      b.endLoop();
      b.endLoop();
    });
  };
  expectGood(nest(1024, 1023));
  expectGood(nest(0, UINT32_MAX));
  expectBroken(nest(1024, 1024), Rule::Loops, "more than", 1); // and the 1024 passes of the outer loop
  expectBroken(nest(UINT32_MAX, 0), Rule::Loops, "more than", 0);
  expectBroken(nest(65536, 65536), Rule::Loops, "more than", 1);
}

TEST(VerifyRung, Profile) {
  Module m = moduleForOp(OpCode::ProfEnter);
  expectGood(m);
  const std::vector<VerifyError> errors = verify(m, Mode::Built);
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_EQ(errors[0].message, "the module is instrumented already");
  Module unmarked = m;
  unmarked.instrumented = false;
  EXPECT_EQ(verify(unmarked, Mode::Final).size(), 2u); // both operations
  EXPECT_EQ(verify(unmarked, Mode::Built).size(), 2u);
  Module missing = goodModule();
  missing.instrumented = true;
  EXPECT_EQ(verify(missing, Mode::Final)[0].message, "the rung is not measured");
  std::swap(m.routines[0].rungs[0].ops.front(), m.routines[0].rungs[0].ops.back());
  m.routines[0].rungs[0].ops.front().firstArg = 0;
  m.routines[0].rungs[0].ops.back().firstArg = static_cast<uint32_t>(m.routines[0].rungs[0].args.size());
  expectBroken(m, Rule::Profile, "not measured");
}

TEST(VerifyRung, ProfileOnlyAtTheEnds) {
  Module m = moduleForOp(OpCode::ProfEnter);
  Rung& rung = m.routines[0].rungs[0];
  rung.ops.insert(rung.ops.begin() + 1, rung.ops[0]);
  expectBroken(m, Rule::Profile, "out of place", 1);
}

TEST(VerifyRung, Transfer) {
  const auto fill = [](RungBuilder& b) {
    b.bit(true);
    b.i32(1);
  };
  const auto broken = [&](const Transfer& transfer, std::string_view part) {
    expectRungBroken(fill, [&](Rung& r) { r.transfer = transfer; }, Rule::Transfer, part, 2);
  };
  const ValueId bit{0};
  const ValueId word{1};
  broken({.kind = TransferKind::Goto, .target = 1}, "the target does not exist");
  broken({.kind = TransferKind::Next, .target = 1}, "the target does not exist");
  broken({.kind = TransferKind::Call, .callee = RoutineId{2}}, "the callee does not exist");
  broken({.kind = TransferKind::Call}, "the callee does not exist");
  broken({.kind = TransferKind::Ret, .callee = RoutineId{1}}, "the callee does not exist");
  broken({.kind = TransferKind::Switch, .value = word}, "without targets");
  broken({.kind = TransferKind::End, .targets = {0}}, "targets without a switch");
  broken({.kind = TransferKind::Switch, .value = word, .targets = {0, 1}}, "target 1 does not exist");
  broken({.kind = TransferKind::Switch, .value = bit, .targets = {0}}, "is an i32");
  broken({.kind = TransferKind::Switch, .targets = {0}}, "is an i32");
  broken({.kind = TransferKind::Ret, .value = word}, "is an i32");
  broken({.kind = TransferKind::Goto, .cond = word}, "the condition is not a bit");
  broken({.kind = TransferKind::Next, .cond = bit}, "not used");
  broken({.kind = TransferKind::Switch, .cond = bit, .value = word, .targets = {0}}, "not used");
  for (TransferKind kind : {TransferKind::Goto, TransferKind::Ret, TransferKind::End}) {
    Module m = withRung(fill);
    rungOf(m).transfer = {.kind = kind, .cond = bit};
    expectGood(m);
  }
}

TEST(VerifyRung, OnlyTheFirstErrorsAreRendered) {
  Module m = goodModule();
  rungOf(m).weight = 0;
  m.routines[0].rungs.resize(100, rungOf(m));
  const std::vector<VerifyError> errors = verify(m, Mode::Final);
  EXPECT_EQ(errors.size(), 100u);
  const std::string text = render(m, errors);
  EXPECT_NE(text.find("rung 19:"), std::string::npos);
  EXPECT_EQ(text.find("rung 20:"), std::string::npos);
  EXPECT_NE(text.find("and 80 more errors"), std::string::npos);
}

// Each rung with an error is reported, and a rung only once.
TEST(VerifyRung, EveryBrokenRungIsReported) {
  Module m = goodModule();
  rungOf(m).weight = 0;
  m.routines[1].rungs[0].weight = 0;
  m.routines[1].rungs[0].transfer.target = 9;
  const std::vector<VerifyError> errors = verify(m, Mode::Final);
  ASSERT_EQ(errors.size(), 2u);
  EXPECT_EQ(errors[1].routine, RoutineId{1});
  EXPECT_EQ(errors[1].rung, 0u);
}

} // namespace
} // namespace rung::ir

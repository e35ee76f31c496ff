// Counting under the interpreter: rungs, contacts, coils, what decided; regions, faults, rungs lowered twice.
#include <gtest/gtest.h>

#include "ir/core/op_info.h"
#include "tests/unit/ir_interp/machine.h"
#include "tools/report/coverage_collector.h"

namespace rung::report {
namespace {

using ir::Mark;
using ir::MarkKind;

std::string moduleText(std::string_view routines) {
  return "module \"t\" dialect \"t\"\nfile \"a.lad\"\nspace I unit 1 units 1\nspace O unit 1 units 1\n"
         "fault \"budget\"\nfault \"stop\"\n" +
         std::string(routines) +
         "task T entry MAIN period 1000 budget 1000 fault \"budget\" parts 1 {\n}\nschedule main T fast -\n"
         "step scan advance - 1000\nstep scan run T 1\n";
}

std::string rungText(std::string_view ops, std::string_view transfer = "}") {
  return "rung 0 \"title\" loc(\"a.lad\":3:1-4) key(0) weight 1 {\n" + std::string(ops) + "\n" + std::string(transfer) +
         "\n";
}

class Bench {
public:
  // Rungs of MAIN, numbered from 1, with the marks of each.
  Bench(const std::vector<std::string>& rungs, const std::vector<std::vector<Mark>>& marks) {
    std::string text = "routine MAIN {\n";
    for (size_t i = 0; i < rungs.size(); ++i) {
      std::string rung = rungs[i];
      text += rung.replace(rung.find("rung 0"), 6, "rung " + std::to_string(i));
    }
    ir::Module module = ir::moduleFromText(moduleText(text + "}\n"));
    ir::Marks all;
    for (uint32_t i = 0; i < rungs.size(); ++i) {
      module.routines[0].rungs[i].number = i + 1;
      for (const Mark& mark : marks[i]) all.add(ir::RoutineId{0}, i, mark);
    }
    machine_ = std::make_unique<ir::Machine>(std::move(module));
    auto collector = std::make_unique<CoverageCollector>(machine_->module(), all);
    collector_ = collector.get();
    machine_->observe(std::move(collector));
  }
  // A scan with these bits of I.
  void scan(uint8_t inputs) {
    (*machine_)->memory().writeByte(0, 0, inputs);
    (*machine_)->scan();
  }
  const Rung& rung(size_t i) {
    last_ = collector_->program();
    return last_.rungs[i];
  }

private:
  std::unique_ptr<ir::Machine> machine_;
  CoverageCollector* collector_ = nullptr; // the engine has it
  Program last_;
};

Mark contact(uint32_t value, std::string text) {
  return {MarkKind::Contact, ir::ValueId{value}, 4, 1, std::move(text)};
}
Mark coil(uint32_t value, std::string text) { return {MarkKind::Coil, ir::ValueId{value}, 4, 9, std::move(text)}; }

// START and not STOP, with PUMP beside START.
const char* const kLatch = R"(
  %0:bit = load I[0.0]
  %1:bit = load I[0.1]
  %2:bit = or %0, %1
  %3:bit = load I[0.2]
  %4:bit = not %3
  %5:bit = and %2, %4
  store.bit O[0.0], %5)";
const std::vector<Mark> kLatchMarks = {contact(0, "[START]"), contact(1, "[PUMP]"), contact(4, "[/STOP]"),
                                       coil(5, "(PUMP)")};

TEST(CoverageCollector, NothingRanNothingSeen) {
  Bench bench({rungText(kLatch)}, {kLatchMarks});
  const Rung& rung = bench.rung(0);
  EXPECT_EQ(rung.runs, 0u);
  EXPECT_EQ(rung.number, 1u);
  EXPECT_EQ(rung.title, "title");
  EXPECT_EQ(rung.file, "a.lad");
  EXPECT_EQ(rung.line, 3u);
  EXPECT_FALSE(rung.conditions[0].open || rung.conditions[0].closed);
  EXPECT_FALSE(rung.outputs[0].on || rung.outputs[0].off);
}

// The truth table of (START or PUMP) and /STOP by hand, a scan at a time.
TEST(CoverageCollector, FollowsTheTruthTable) {
  Bench bench({rungText(kLatch)}, {kLatchMarks});
  bench.scan(0b000); // off: START alone would switch it on, PUMP too
  {
    const Rung& rung = bench.rung(0);
    ASSERT_EQ(rung.decisions.size(), 1u);
    EXPECT_EQ(rung.decisions[0].outputs, std::vector<uint32_t>{0});
    ASSERT_EQ(rung.decisions[0].by.size(), 3u);
    EXPECT_EQ(rung.decisions[0].by[0].alone, kOpenOff);
    EXPECT_EQ(rung.decisions[0].by[1].alone, kOpenOff);
    EXPECT_EQ(rung.decisions[0].by[2].alone, 0);
    EXPECT_TRUE(rung.conditions[2].closed);
    EXPECT_FALSE(rung.conditions[2].open);
    EXPECT_TRUE(rung.outputs[0].off);
    EXPECT_FALSE(rung.outputs[0].on);
  }
  bench.scan(0b001); // on: by START and by /STOP
  EXPECT_TRUE(bench.rung(0).decisions[0].by[0].bothWays());
  EXPECT_EQ(bench.rung(0).decisions[0].by[2].alone, kClosedOn);
  bench.scan(0b011); // on: by /STOP only
  EXPECT_FALSE(bench.rung(0).decisions[0].by[1].bothWays());
  bench.scan(0b101); // off: by /STOP
  EXPECT_TRUE(bench.rung(0).decisions[0].by[2].bothWays());
  bench.scan(0b010); // on: by PUMP
  const Rung& rung = bench.rung(0);
  EXPECT_TRUE(rung.decisions[0].by[1].bothWays());
  EXPECT_EQ(rung.runs, 5u);
  for (const Condition& condition : rung.conditions) EXPECT_TRUE(condition.open && condition.closed);
  EXPECT_TRUE(rung.outputs[0].on && rung.outputs[0].off);
}

// Of an exclusive or, seeing a contact decide twice is not enough: contact and outcome must both have changed.
TEST(CoverageCollector, ExclusiveOrNeedsBothToChange) {
  const char* const ops = R"(
  %0:bit = load I[0.0]
  %1:bit = load I[0.1]
  %2:bit = xor %0, %1
  store.bit O[0.0], %2)";
  Bench bench({rungText(ops)}, {{contact(0, "A"), contact(1, "B"), coil(2, "Y")}});
  bench.scan(0b00);
  bench.scan(0b11); // A decided open and closed, each time the coil was off
  EXPECT_EQ(bench.rung(0).decisions[0].by[0].alone, kOpenOff | kClosedOff);
  EXPECT_FALSE(bench.rung(0).decisions[0].by[0].bothWays());
  bench.scan(0b10);
  EXPECT_TRUE(bench.rung(0).decisions[0].by[0].bothWays());
}

// Coils with one power are one decision, others are others.
TEST(CoverageCollector, CoilsInParallelAreOneDecision) {
  Bench bench({rungText(kLatch)}, {{contact(0, "[START]"), contact(1, "[PUMP]"), coil(2, "(LAMP)"),
                                    contact(4, "[/STOP]"), coil(5, "(PUMP)"), coil(5, "(S RAN)")}});
  bench.scan(0);
  const Rung& rung = bench.rung(0);
  ASSERT_EQ(rung.decisions.size(), 2u);
  EXPECT_EQ(rung.decisions[0].outputs, (std::vector<uint32_t>{0}));
  EXPECT_EQ(rung.decisions[0].by.size(), 2u);
  EXPECT_EQ(rung.decisions[1].outputs, (std::vector<uint32_t>{1, 2}));
  EXPECT_EQ(rung.decisions[1].by.size(), 3u);
}

// What lies in a region is seen only when it was entered.
TEST(CoverageCollector, RegionsThatAreNotEntered) {
  const char* const ops = R"(
  %0:bit = load I[0.0]
  if %0
    %1:bit = load I[0.1]
    store.bit O[0.1], %1
  else
    %2:bit = load I[0.2]
    store.bit O[0.2], %2
  endif)";
  Bench bench({rungText(ops)}, {{contact(1, "A"), coil(1, "(A1)"), contact(2, "B"), coil(2, "(B1)")}});
  bench.scan(0b010); // else: A is closed, but nobody asked
  EXPECT_FALSE(bench.rung(0).conditions[0].closed || bench.rung(0).conditions[0].open);
  EXPECT_FALSE(bench.rung(0).outputs[0].off);
  EXPECT_EQ(bench.rung(0).decisions[0].by[0].alone, 0);
  EXPECT_TRUE(bench.rung(0).conditions[1].open);
  EXPECT_TRUE(bench.rung(0).outputs[1].off);
  bench.scan(0b011);
  EXPECT_TRUE(bench.rung(0).conditions[0].closed);
  EXPECT_FALSE(bench.rung(0).conditions[1].closed);
}

TEST(CoverageCollector, RungsThatAJumpLeavesOut) {
  const std::string jump = rungText("  %0:bit = load I[0.0]", "} goto 2 if %0");
  Bench bench({jump, rungText(kLatch), rungText("")},
              {{contact(0, "[A]"), {MarkKind::Input, ir::ValueId{0}, 4, 9, "{JMP 1}"}}, kLatchMarks, {}});
  bench.scan(1);
  EXPECT_EQ(bench.rung(0).runs, 1u);
  EXPECT_EQ(bench.rung(1).runs, 0u);
  EXPECT_EQ(bench.rung(2).runs, 1u);
  EXPECT_FALSE(bench.rung(0).outputs[0].coil);
  bench.scan(0);
  EXPECT_EQ(bench.rung(1).runs, 1u);
}

// A rung that stops the program has run; what its contacts were is not known.
TEST(CoverageCollector, ARungWithAFault) {
  const char* const ops = R"(
  %0:bit = load I[0.0]
  trap "stop", %0
  %1:bit = load I[0.1]
  store.bit O[0.0], %1)";
  Bench bench({rungText(ops)}, {{contact(1, "[A]"), coil(1, "(B)")}});
  bench.scan(1);
  EXPECT_EQ(bench.rung(0).runs, 1u);
  EXPECT_FALSE(bench.rung(0).conditions[0].open || bench.rung(0).conditions[0].closed);
}

// ---- rungs of the module and rungs of the source --------------------------------------------------------------------

class Parts : public ::testing::Test {
protected:
  // A rung with one contact and one coil.
  static ir::Rung rung(uint32_t number, uint64_t key) {
    ir::Rung made;
    made.number = number;
    made.key = key;
    made.values = {ir::Type::Bit};
    made.ops = {{.code = ir::findOp("load")->code, .type = ir::Type::Bit, .resultCount = 1, .result = ir::ValueId{0}}};
    return made;
  }
  void add(uint32_t routine, ir::Rung code, const std::string& name) {
    std::vector<ir::Rung>& rungs = module_.routines[routine].rungs;
    const auto index = static_cast<uint32_t>(rungs.size());
    if (!name.empty()) {
      marks_.add({routine}, index, contact(0, "[" + name + "]"));
      marks_.add({routine}, index, coil(0, "(" + name + ")"));
    }
    rungs.push_back(std::move(code));
  }

  Parts() { module_.routines = {{"A", {}}, {"B", {}}}; }

  ir::Module module_;
  ir::Marks marks_;
  const std::vector<uint64_t> off_{0};
  const std::vector<uint64_t> on_{1};
};

TEST_F(Parts, OneRungInTwoRoutines) {
  add(0, rung(7, 1), "X");
  add(1, rung(7, 1), "X");
  CoverageCollector collector(module_, marks_);
  collector.rungRan(0, off_);
  collector.rungRan(1, on_);
  const Program program = collector.program();
  ASSERT_EQ(program.rungs.size(), 1u);
  ASSERT_EQ(program.rungs[0].conditions.size(), 1u);
  EXPECT_EQ(program.rungs[0].runs, 2u);
  EXPECT_TRUE(program.rungs[0].conditions[0].open && program.rungs[0].conditions[0].closed);
}

// A macro in one line is several rungs of one number, also when it is lowered for two routines.
TEST_F(Parts, SeveralRungsOfOneNumber) {
  for (uint32_t routine = 0; routine < 2; ++routine) {
    add(routine, rung(7, 1), "X");
    add(routine, rung(7, 1), "Y");
    add(routine, rung(7, 2), "");
  }
  CoverageCollector collector(module_, marks_);
  for (uint32_t i = 0; i < 6; ++i) collector.rungRan(i, i == 4 ? on_ : off_);
  const Program program = collector.program();
  ASSERT_EQ(program.rungs.size(), 1u);
  const Rung& made = program.rungs[0];
  EXPECT_EQ(made.runs, 2u);
  ASSERT_EQ(made.conditions.size(), 2u);
  EXPECT_FALSE(made.conditions[0].closed);
  EXPECT_TRUE(made.conditions[1].closed && made.conditions[1].open);
  ASSERT_EQ(made.decisions.size(), 2u);
  EXPECT_EQ(made.decisions[1].outputs, std::vector<uint32_t>{1});
  EXPECT_EQ(made.decisions[1].by[0].condition, 1u);
  EXPECT_TRUE(made.decisions[1].by[0].bothWays());
}

TEST_F(Parts, RungsOfTheCompilerDoNotCount) {
  add(0, rung(0, 1), "");
  add(0, rung(2, 2), "X");
  add(0, rung(1, 3), "Y");
  CoverageCollector collector(module_, marks_);
  for (uint32_t i = 0; i < 3; ++i) collector.rungRan(i, on_);
  const Program program = collector.program();
  ASSERT_EQ(program.rungs.size(), 2u);
  EXPECT_EQ(program.rungs[0].number, 1u); // by number
  EXPECT_EQ(program.rungs[0].conditions[0].text, "[Y]");
}

TEST_F(Parts, ObserversHandOverWhenTheyGo) {
  add(0, rung(1, 1), "X");
  Collection collection;
  for (int i = 0; i < 3; ++i) {
    const auto observer = collection.observe(module_, marks_);
    observer->rungRan(0, i == 0 ? off_ : on_);
  }
  const CoverageReport report = collection.report();
  ASSERT_EQ(report.programs.size(), 1u);
  EXPECT_EQ(report.programs[0].rungs[0].runs, 3u);
  EXPECT_TRUE(report.programs[0].rungs[0].outputs[0].on && report.programs[0].rungs[0].outputs[0].off);
}

} // namespace
} // namespace rung::report

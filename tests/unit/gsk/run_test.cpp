// What programs do, where a scenario cannot show it: tasks, latches, the schedule.
#include "frontend/dialects/gsk/rows/instructions.h"
#include "tests/unit/gsk/machine.h"

namespace rung::frontend::gsk::test {
namespace {

Machine listMachine(const std::string& text, const frontend::CompileOptions& options = {}) {
  return Machine(compileList(text, options));
}

TEST(GskRun, ManualExampleOfOrder) { // l.419-422
  Machine m = listMachine("FUNC 0\nLD R0.0\nANI R0.2\nOUT R0.1\nLD R0.0\nOUT R0.2\nFUNC 1\n");
  m.set("R0.0", 1);
  m.scan();
  EXPECT_EQ(m.get("R0.1"), 1u);
  m.scan();
  EXPECT_EQ(m.get("R0.1"), 0u);
}

TEST(GskRun, EveryFunctionRuns) {
  std::string text = "FUNC 0\n";
  for (const Row& row : allRows()) {
    if (row.info.number < 0 || row.lower == nullptr || row.control != frontend::network::Control::Plain) continue;
    // By itself first, so that a bad example is told by its name and keeps none of the others from running.
    const std::string example = std::string(row.info.example) + "\n";
    const auto alone = compileList("FUNC 0\n" + example + "FUNC 1\n");
    EXPECT_EQ(alone->codes(), Codes{}) << row.info.mnemonic << '\n' << alone->text();
    if (alone->module != nullptr) text += example;
  }
  Machine m = listMachine(text + "FUNC 1\n");
  m.scan(2);
  m.set("X9.0", 1);
  m.scan();
  EXPECT_EQ(m.get("R9"), 1u) << "DIFU";
  m.set("X9.0", 0);
  m.scan();
  EXPECT_EQ(m.get("R9"), 2u) << "DIFD";
  EXPECT_FALSE(m.instance().faulted()) << m.instance().faultText();
}

// ---- the module ----------------------------------------------------------------------------------------------------

std::unique_ptr<Compiled> compiled(const std::string& text, const frontend::CompileOptions& options = {}) {
  auto result = compileList(text, options);
  if (result->module == nullptr) ADD_FAILURE() << result->text();
  return result;
}

TEST(GskModule, RungsTellWhereTheyComeFrom) {
  const auto program = compiled(R"(FUNC 0

; ------------------------
; start and stop
; of the pump
LD   X10.0      ; key
OR   Y10.0
OUT  Y10.0
LD   X10.1
; between the commands
RST  Y10.0
FUNC 1
)");
  const ir::Routine& level2 = program->module->routines[1];
  ASSERT_EQ(level2.rungs.size(), 3u);
  EXPECT_EQ(level2.rungs[0].title, "start and stop");
  EXPECT_EQ(level2.rungs[0].begin.line, 6u);
  EXPECT_EQ(level2.rungs[0].lastLine, 8u);
  EXPECT_EQ(level2.rungs[0].sourceText, "LD   X10.0      ; key\nOR   Y10.0\nOUT  Y10.0");
  EXPECT_EQ(level2.rungs[0].weight, 3u);
  EXPECT_EQ(level2.rungs[1].title, "");
  EXPECT_EQ(level2.rungs[0].ops[1].line, 7u);
}

TEST(GskModule, KeysSurviveEditsElsewhere) {
  const std::string network = "LD X010.0\nFUNC DIFU\nPRM 001\nOUT R0.0\n";
  const auto before = compiled("FUNC 0\n" + network + "FUNC 1\n");
  const auto after = compiled("FUNC 0\nLD X1.1\nOUT Y1.1\n; a comment\nLD X10.0\nFUNC 26\nPRM 1\nOUT R000.0\n" +
                              std::string("FUNC 1\n"));
  EXPECT_EQ(before->module->routines[1].rungs[0].key, after->module->routines[1].rungs[1].key);
  EXPECT_EQ(before->module->slots[0].key, after->module->slots[0].key);
  const auto twice = compiled("FUNC 0\n" + network + network + "FUNC 1\n");
  EXPECT_NE(twice->module->routines[1].rungs[0].key, twice->module->routines[1].rungs[1].key);
}

TEST(GskModule, ScheduleOfSlots) {
  const auto program = compiled("FUNC 0\nFUNC 1\n", {.config = {{"period_us", "24000"}}});
  const ir::Module& module = *program->module;
  EXPECT_EQ(module.scan.size(), 11u) << "three steps a slot, and two ends of slots between them";
  EXPECT_EQ(module.fast.size(), 2u);
  EXPECT_EQ(module.tasks[module.mainTask.index].parts, 3u);
  EXPECT_EQ(module.tasks[module.mainTask.index].periodUs, 24000u);
}

TEST(GskModule, OnlyWhatIsNeededIsCopied) {
  const auto plain = compiled("LD X0.0\nOUT Y0.0\nFUNC 0\nLD X10.0\nAND X100.0\nAND F0.0\nOUT Y0.1\nFUNC 1\n");
  EXPECT_EQ(plain->module->tasks[0].begin.size(), 0u) << "Level 1 does not touch R1000";
  EXPECT_EQ(plain->module->tasks[1].begin.size(), 3u) << "two places of X, one of F";
  const auto flags = compiled("LD R1000.0\nOUT Y0.0\nFUNC 0\nFUNC 1\n");
  EXPECT_EQ(flags->module->tasks[0].begin.size(), 2u);
  EXPECT_EQ(flags->module->tasks[0].end.size(), 2u);
}

TEST(GskModule, SubprogramsAreLoweredOnceALevelAndShareTheirSlots) {
  const auto program = compiled("FUNC CALLU\nPRM P1\nFUNC 0\nFUNC CALLU\nPRM P1\nFUNC CALLU\nPRM P2\nFUNC 1\n"
                                "FUNC SP\nPRM P1\nLD X0.0\nFUNC DIFU\nPRM 1\nOUT R0.0\nFUNC SPE\n"
                                "FUNC SP\nPRM P2\nFUNC SPE\nFUNC SP\nPRM P3\nFUNC SPE\n");
  std::vector<std::string> names;
  for (const ir::Routine& routine : program->module->routines) names.push_back(routine.name);
  EXPECT_EQ(names, (std::vector<std::string>{"LEVEL1", "P1@1", "LEVEL2", "P1@2", "P2"}));
  EXPECT_EQ(program->module->slots.size(), 1u);
}

TEST(GskModule, SymbolsAreThoseOfTheProgram) {
  const auto program = compiled("symbol ZEBRA Y10.0 ; last\nsymbol ALPHA X10\nFUNC 0\nFUNC 1\n");
  ASSERT_EQ(program->module->symbols.size(), 2u);
  EXPECT_EQ(program->module->symbols[0].name, "ALPHA");
  EXPECT_EQ(program->module->symbols[0].flags, uint32_t{RUNG_SYMBOL_READONLY});
  EXPECT_EQ(program->module->symbols[1].comment, "last");
}

// ---- time ----------------------------------------------------------------------------------------------------------

TEST(GskRun, ATimerInASubprogramOfBothLevelsDoesNotCountTwice) {
  Machine m = listMachine("FUNC CALLU\nPRM P1\nFUNC 0\nFUNC CALLU\nPRM P1\nFUNC CALLU\nPRM P1\nFUNC 1\n"
                          "FUNC SP\nPRM P1\nLD X0.0\nFUNC TMRB\nPRM 1\nPRM 80\nOUT Y0.0\nFUNC SPE\n");
  m.set("X0.0", 1);
  m.scan(10);
  EXPECT_EQ(m.get("Y0.0"), 0u) << "72 ms";
  m.scan();
  EXPECT_EQ(m.get("Y0.0"), 1u);
}

TEST(GskRun, ALoopInLevel1IsStopped) {
  Machine m = listMachine("LD X0.1\nOUT Y0.1\nFUNC LBL\nPRM L1\nLD X0.0\nFUNC JMPB\nPRM L1\nFUNC 0\nFUNC 1\n");
  m.scan();
  m.set("X0.1", 1);
  m.set("X0.0", 1);
  m.scan();
  EXPECT_TRUE(m.instance().faulted());
  EXPECT_NE(m.instance().faultText().find("dead-loop"), std::string::npos);
  EXPECT_EQ(m.get("Y0.1"), 1u) << "outputs stay as they are (P6)";
}

TEST(GskRun, EmptyProgramRuns) {
  Machine m = listMachine("FUNC 0\nFUNC 1\n");
  m.scan(3);
  EXPECT_EQ(m.instance().nowUs(), 24000);
  Machine ladder(compileLadder("dialect gsk\nmodule LEVEL2\n"));
  ladder.scan();
}

TEST(GskRun, FileOfALadderAndAListTogether) {
  Machine m(compileFiles({{"main.pmc", "symbol GO X0.0\nFUNC 0\nFUNC CALLU\nPRM P1\nFUNC 1\n"},
                          {"sub.lad", "dialect gsk\nmodule SUB P1\nrung\n|--[GO]--(Y0.0)\n"}}));
  m.set("GO", 1);
  m.scan();
  EXPECT_EQ(m.get("Y0.0"), 1u);
}

} // namespace
} // namespace rung::frontend::gsk::test

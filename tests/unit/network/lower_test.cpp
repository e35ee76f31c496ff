// Lowering of programs in the language that is made up here: a task for each level, and when it runs.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <string>

#include "frontend/network/check/analyse.h"
#include "frontend/network/lower/lower_module.h"
#include "frontend/network/read/reading.h"
#include "ir/support/diag_render.h"
#include "ir/text/text.h"
#include "tests/unit/network/little_language.h"

namespace rung::frontend::network::test {
namespace {

const Execution kExecution{
    .slotUs = 1000, .budget = 100, .overrunFault = "too-long", .results = {Area{2}, 12}, .resultBytes = 2};

std::unique_ptr<ir::Module> lowered(const std::string& text, const Language& language, uint32_t parts) {
  SourceManager sources;
  Diagnostics diagnostics;
  Context context{.language = language, .sources = sources, .diagnostics = diagnostics};
  Program program(language);
  const FileId file = sources.addBuffer("test.lst", text);
  Reading reading(context, program);
  reading.add(file);
  const bool understood = reading.read();
  analyse(context, program, !understood);
  EXPECT_EQ(renderText(diagnostics, sources), "");
  ModuleLowering lowering(program, context, {&file, 1}, kExecution, nullptr, false);
  lowering.lowerUnits();
  lowering.addTasks(parts);
  return lowering.take();
}

std::string stepsOf(const ir::Module& module, const std::vector<ir::Step>& steps) {
  std::string text;
  for (const ir::Step& step : steps) {
    text += text.empty() ? "" : " ";
    switch (step.op) {
    case RUNG_STEP_ADVANCE: text += fmt::format("+{}", step.arg); break;
    case RUNG_STEP_SLOT: text += "|"; break;
    case RUNG_STEP_RUN: text += module.tasks[step.task.index].name; break;
    case RUNG_STEP_PART: text += fmt::format("part-of-{}", module.tasks[step.task.index].name); break;
    default: text += "?";
    }
  }
  return text;
}

// "I.1:1 to @I2.1": what is copied.
std::string copiesOf(const ir::Module& module, const std::vector<ir::Copy>& copies) {
  std::string text;
  for (const ir::Copy& copy : copies)
    text += fmt::format("{}{}.{}:{} to {}.{}", text.empty() ? "" : ", ", module.at(copy.from.space).name,
                        copy.from.byte, copy.from.size, module.at(copy.to).name, copy.toByte);
  return text;
}

const std::string kThree = "GET I0.0\nPUT Q0.0\nGET M12.0\nPUT M0.0\nDO FASTEND\n"
                           "GET I0.1\nPUT Q0.1\nGET I0.2\nDO VISIT\nARG U1\nDO SLOWEND\n"
                           "GET I1.2\nDO VISIT\nARG U1\nDO IDLEEND\n"
                           "DO PART\nARG U1\nGET I3.3\nDO COPY\nARG M13\nARG M1\nDO PARTEND\n";

TEST(NetworkLower, EachLevelRunsInItsTurn) {
  const ThreeLevels three;
  const auto whole = lowered(kThree, three.language(), 1);
  EXPECT_EQ(stepsOf(*whole, whole->scan), "+1000 FAST SLOW IDLE");
  EXPECT_EQ(stepsOf(*whole, whole->fast), "+1000 FAST");
  const auto parts = lowered(kThree, three.language(), 2);
  EXPECT_EQ(stepsOf(*parts, parts->scan), "+1000 FAST part-of-SLOW | +1000 FAST part-of-SLOW IDLE");
  EXPECT_EQ(parts->fastTask.index, kFast);
  EXPECT_EQ(parts->mainTask.index, kSlow);
  ASSERT_EQ(parts->tasks.size(), 3u);
  EXPECT_EQ(parts->tasks[0].periodUs, 1000u);
  EXPECT_EQ(parts->tasks[1].periodUs, 2000u);
  EXPECT_EQ(parts->tasks[2].periodUs, 2000u);
}

TEST(NetworkLower, LevelsHaveTheirInputsAndResults) {
  const ThreeLevels three;
  const auto module = lowered(kThree, three.language(), 1);
  EXPECT_EQ(copiesOf(*module, module->tasks[0].begin), "M.12:2 to @M2.0, @M1.0:2 to M.12") << "no latch";
  EXPECT_EQ(copiesOf(*module, module->tasks[0].end), "M.12:2 to @M1.0, @M2.0:2 to M.12");
  EXPECT_EQ(copiesOf(*module, module->tasks[1].begin), "I.0:4 to @I2.0") << "the main program's are in their place";
  EXPECT_EQ(copiesOf(*module, module->tasks[2].begin), "M.12:2 to @M2.0, @M3.0:2 to M.12, I.1:3 to @I3.1");
}

TEST(NetworkLower, AUnitOfTwoLevelsIsLoweredForEach) {
  const ThreeLevels three;
  const std::string text = ir::print(*lowered(kThree, three.language(), 1));
  for (const char* routine : {"routine FAST ", "routine SLOW ", "routine IDLE ", "routine U1@2 ", "routine U1@3 "})
    EXPECT_NE(text.find(routine), std::string::npos) << routine;
  EXPECT_EQ(text.find("routine U1@1"), std::string::npos);
}

} // namespace
} // namespace rung::frontend::network::test

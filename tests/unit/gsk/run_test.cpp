// What programs do, where a scenario cannot show it: tasks, latches, the schedule.
#include "frontend/dialects/gsk/instructions.h"
#include "tests/unit/gsk/machine.h"

namespace rung::gsk::test {
namespace {

Machine listMachine(const std::string& text, const frontend::CompileOptions& options = {}) { return Machine(compileList(text, options)); }

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
    if (row.info.number < 0 || row.lower == nullptr || row.control != Control::Plain) continue;
    std::string lines(row.info.example);
    for (size_t at; (at = lines.find(" / ")) != std::string::npos;) lines.replace(at, 3, "\n");
    text += lines + "\n";
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

} // namespace
} // namespace rung::gsk::test

// The prompt of `rungc replay`: each command, and what it says about wrong words.
#include <filesystem>
#include <fstream>
#include <iterator>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "ir/support/temporary_folder.h"
#include "tests/unit/replay/recorded_scenario.h"
#include "tools/replay/console.h"

namespace rung::replay {
namespace {

using scenario::Outcome;
using ::testing::HasSubstr;
using ::testing::StartsWith;

class ConsoleTest : public testing::Test {
protected:
  ConsoleTest() {
    recorded_ = recordedScenario("examples/gsk-panel/panel.scn");
    past_ = std::move(Past::open(recorded_.recording, {.engine = compiler::EngineKind::Interp})).value();
    EXPECT_EQ(past_->goTo(past_->contents().parts), "");
    console_ = std::make_unique<Console>(*past_, [this](const std::string& line) { said_ += line + "\n"; });
  }
  std::string say(std::string_view line, Outcome expected = Outcome::Done) {
    said_.clear();
    EXPECT_EQ(console_->execute(line), expected) << line << ": " << said_;
    return said_;
  }
  std::string fails(std::string_view line) {
    const uint64_t here = past_->part();
    const std::string text = say(line, Outcome::Failed);
    EXPECT_EQ(past_->part(), here) << line << " has moved";
    return text;
  }

  RecordedScenario recorded_;
  std::unique_ptr<Past> past_;
  std::unique_ptr<Console> console_;
  std::string said_;
};

struct Wrong {
  const char* line;
  const char* problem;
};

TEST_F(ConsoleTest, WrongWordsAreNamedAndTheMomentStays) {
  ASSERT_EQ(past_->goTo(20), "");
  const Wrong kCases[] = {
      {"jump", "'jump' is not a command; help lists them"},
      {"scan", "expected a number (the command is: scan N)"},
      {"scan x", "expected a number (the command is: scan N)"},
      {"scan -1", "expected a number (the command is: scan N)"},
      {"scan 1 2", "expected a number (the command is: scan N)"},
      {"scan 99999999999999999999", "expected a number (the command is: scan N)"},
      {"scan 999999", "the recording has scans 0 to "},
      {"time", "expected a time such as 1.5s or 250ms (the command is: time 1.5s)"},
      {"time soon", "expected a time such as 1.5s or 250ms (the command is: time 1.5s)"},
      {"time -1s", "expected a time such as 1.5s or 250ms (the command is: time 1.5s)"},
      {"time 1e30s", "expected a time such as 1.5s or 250ms (the command is: time 1.5s)"},
      {"time nan", "expected a time such as 1.5s or 250ms (the command is: time 1.5s)"},
      {"next 2 apples", "expected scan, task or rung, found 'apples'"},
      {"next 2 3", "expected scan, task or rung, found '3'"},
      {"next 2 scan 3", "expected a number and scan, task or rung, found '3'"},
      {"next 999999999", "the recording has scans 0 to "},
      {"next 18446744073709551615", "the recording has scans 0 to "},
      {"back 21", "the recording begins here"},
      {"back rung 1", "expected a number and scan, task or rung, found '1'"},
      {"show", "expected names (the command is: show NAME…)"},
      {"show NOWHERE", "'NOWHERE'"},
      {"rung 999", "there is no rung '999'; the program has "},
      {"rung one", "expected a number (the command is: rung [N])"},
      {"rung 1 2", "expected a number (the command is: rung [N])"},
      {"find", "expected a condition such as X8.4 or D100 > 500 (the command is: find CONDITION)"},
      {"find NOWHERE", "'NOWHERE'"},
      {"find STL =", "expected a name or a number at the end"},
      {"find (STL", "a bracket is not closed"},
      {"why", "expected a name (the command is: why NAME [@ SCAN])"},
      {"why NOWHERE", "'NOWHERE'"},
      {"why STL @ 999999", "the recording has scans 0 to "},
      {"why STL @ soon", "'STL @ soon'"},
      {"writes", "expected a name (the command is: writes NAME)"},
      {"writes NOWHERE", "'NOWHERE'"},
      {"writes STL STL", "expected a name (the command is: writes NAME)"},
      {"marks all", "expected no more words (the command is: marks)"},
      {"messages all", "expected no more words (the command is: messages)"},
      {"faults all", "expected no more words (the command is: faults)"},
      {"compare all", "expected no more words (the command is: compare)"},
      {"help scan", "expected no more words (the command is: help)"},
      {"quit now", "expected no more words (the command is: quit)"},
      {"export", "expected a file (the command is: export FILE.vcd|.csv|.scn [FROM TO] [NAME…])"},
      {"export a.txt", "'a.txt' cannot be a trace: its name must end in .vcd or .csv"},
      {"export a.vcd 5 5", "the first scan, 5, is not before the last one, 5"},
      {"export a.vcd 0 999999", "the recording has scans 0 to "},
      {"export a.csv NOWHERE", "'NOWHERE'"},
      {"export a.scn STL", "a scenario has what others wrote, and no list of names"},
      {"export /nowhere/a.scn 0 9", "cannot write '/nowhere/a.scn'"},
      {"export /nowhere/a.csv 0 9 STL", "cannot write '/nowhere/a.csv'"},
  };
  for (const Wrong& wrong : kCases) EXPECT_THAT(fails(wrong.line), HasSubstr(wrong.problem)) << wrong.line;
  EXPECT_EQ(say(""), "");
  EXPECT_EQ(say("# a comment"), "");
}

TEST_F(ConsoleTest, MovesByScansTasksAndRungs) {
  EXPECT_EQ(say("scan 10"), "");
  EXPECT_THAT(console_->prompt(), StartsWith("scan 10, "));
  say("next 5");
  EXPECT_EQ(past_->part(), 15u);
  say("back");
  EXPECT_EQ(past_->part(), 14u);
  say("back rung");
  EXPECT_THAT(console_->prompt(), HasSubstr(" rungs> "));
  say("next rung");
  EXPECT_THAT(console_->prompt(), StartsWith("scan 14, "));
  EXPECT_THAT(console_->prompt(), Not(HasSubstr("rungs")));
  say("next task");
  EXPECT_EQ(past_->part(), 15u);
  say("time 0.1s");
  EXPECT_GE(past_->instance().nowUs(), 100'000);
  ASSERT_EQ(past_->goTo(past_->part() - 1), "");
  EXPECT_LT(past_->instance().nowUs(), 100'000);
}

TEST_F(ConsoleTest, LooksWithoutMoving) {
  say("scan 30");
  for (const char* line :
       {"show STL", "rung", "rung 1", "why STL", "writes STL", "marks", "messages", "faults", "compare", "help"}) {
    EXPECT_NE(say(line), "") << line;
    EXPECT_EQ(past_->part(), 30u) << line;
  }
  EXPECT_EQ(say("faults"), "no fault\n");
  EXPECT_THAT(say("compare"), HasSubstr(" scans do what was recorded\n"));
}

TEST_F(ConsoleTest, FindsFromHereOn) {
  say("scan 0");
  say("find rises STL");
  const uint64_t first = past_->part();
  EXPECT_GT(first, 0u);
  EXPECT_THAT(say("show STL"), StartsWith("STL = 1"));
  say("back");
  EXPECT_THAT(say("show STL"), StartsWith("STL = 0"));
  say("find"); // the same condition
  EXPECT_EQ(past_->part(), first);
  say(fmt::format("scan {}", past_->contents().parts));
  EXPECT_THAT(fails("find"), HasSubstr("it does not begin to hold after this scan; `scan 0` goes to the beginning"));
}

std::string contentsOf(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST_F(ConsoleTest, ExportsValuesOfScans) {
  const TemporaryFolder folder;
  say("scan 5");
  EXPECT_THAT(say("export " + (folder / "a.csv").string() + " 10 12 STL"), StartsWith("wrote "));
  EXPECT_EQ(past_->part(), 5u);
  const std::string text = contentsOf(folder / "a.csv");
  EXPECT_THAT(text, StartsWith("time_s,scan,STL\n"));
  EXPECT_EQ(std::ranges::count(text, '\n'), 4) << text; // the head, the state after scan 10, and two scans
}

// What is missing is said of all that goes through a recording.
TEST_F(ConsoleTest, GapsAreNamed) {
  recorded_.recording.segments.push_back(recorded_.recording.segments[0]);
  recorded_.recording.segments[0].damage = "a block is damaged";
  past_ = std::move(Past::open(recorded_.recording, {.engine = compiler::EngineKind::Interp})).value();
  Console console(*past_, [this](const std::string& line) { said_ += line + "\n"; });
  const uint64_t half = past_->contents().parts / 2;
  const std::string gap = fmt::format("after scan {}: a block is damaged\n", half);
  said_.clear();
  EXPECT_EQ(console.execute("compare"), Outcome::Failed);
  EXPECT_THAT(said_, HasSubstr("; the recording has more\n" + gap));
  const TemporaryFolder folder;
  said_.clear();
  EXPECT_EQ(console.execute("export " + (folder / "a.csv").string() + " STL"), Outcome::Failed);
  EXPECT_THAT(said_, HasSubstr(gap));
  said_.clear();
  EXPECT_EQ(console.execute("export " + (folder / "a.scn").string()), Outcome::Failed);
  EXPECT_THAT(said_, HasSubstr("so a scenario ends there"));
}

TEST_F(ConsoleTest, CompletesCommandsAndNames) {
  EXPECT_THAT(console_->completions("sc"), testing::ElementsAre("scan"));
  EXPECT_THAT(console_->completions("show LIGH"), testing::Contains("LIGHT"));
  EXPECT_THAT(console_->completions("scan "), testing::IsEmpty());
}

} // namespace
} // namespace rung::replay

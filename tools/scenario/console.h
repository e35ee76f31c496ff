// What a person types at a running program: every statement of a scenario, and commands that only look. Each line is
// executed at once; what was done can be saved as a scenario.
#pragma once
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tools/scenario/completion.h"
#include "tools/scenario/explain.h"
#include "tools/scenario/recording.h"
#include "tools/scenario/session.h"
#include "tools/scenario/watch.h"

namespace rung::scenario {

enum class Outcome : uint8_t { Done, Failed, Interrupted, Quit };

class Console {
public:
  // All outlive the console.
  Console(Session& session, Watch& watch, Recording& recording, const Explainer& explainer, Print print);

  // One line as it was typed; empty lines and comments do nothing. A fault is reported.
  Outcome execute(std::string_view line);
  // A statement that is not typed: of --set and --scenario.
  Outcome execute(const Statement& statement);

  // The session's place: "scan 3, 0.030 s> ".
  std::string prompt() const;
  // What the last word of the line, as far as it is typed, can become.
  std::vector<std::string> completions(std::string_view line);

private:
  struct Command {
    StatementForm form;
    Names names = Names::None; // of its words
    Outcome (Console::*run)(std::span<const std::string> words) = nullptr;
  };
  static std::span<const Command> commands();
  static std::vector<std::string> words();

  Outcome executeLine(std::string_view line);
  Outcome fail(const std::string& message);
  Outcome unreadable(const std::string& word, bool alone, const std::string& problem);
  Outcome include(const std::string& file);
  // Interrupted when the statement did less than it says.
  Outcome record(const Statement& s, uint64_t scansBefore, int64_t usBefore);
  void recordProgram(const Statement& s);
  void reportFault();

  Outcome forces(std::span<const std::string> words);
  Outcome toggle(std::span<const std::string> words);
  Outcome watch(std::span<const std::string> words);
  Outcome unwatch(std::span<const std::string> words);
  Outcome messages(std::span<const std::string> words);
  Outcome why(std::span<const std::string> words);
  Outcome save(std::span<const std::string> words);
  Outcome help(std::span<const std::string> words);
  Outcome quit(std::span<const std::string> words);

  Session& session_;
  Watch& watch_;
  Recording& recording_;
  const Explainer& explainer_;
  Print print_;
  Completion completion_;
  bool faultReported_ = false;
};

// "the program stopped with a fault: …; try `rungc explain dead-loop`".
std::string faultLine(const runtime::Instance& instance);

} // namespace rung::scenario

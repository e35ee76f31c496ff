// Prints what watched names become, which messages come and go, each with the time, and the lines of print statements.
#pragma once
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "compiler/project.h"
#include "ir/support/result.h"
#include "tools/scenario/explain.h"
#include "tools/scenario/names.h"
#include "tools/scenario/session.h"
#include "tools/scenario/statements.h"

namespace rung::scenario {

using Print = std::function<void(const std::string& line)>; // a line without its end, or several

class Watch final : public Observer {
public:
  explicit Watch(Print print) : print_(std::move(print)) {}

  // "" or why the name cannot be watched. Its first value is printed at the next look.
  std::string add(const std::string& name, const Session& session);
  // False: it is not watched.
  bool remove(const std::string& name);
  std::vector<std::string> names() const;

  void scanned(const Session& session) override { look(session); }
  void replaced(const Session& session, const NextProgram& next) override;
  void printed(const std::string& line) override { print_(line); }
  // Prints what has changed since the last look.
  void look(const Session& session);

private:
  struct Watched {
    NamedValue value;
    std::string last;
  };
  void printMessages(const Session& session);

  Print print_;
  std::vector<Watched> watched_;
  std::vector<nc::ShownMessage> shown_;
  bool otherTexts_ = false; // perhaps: another program has taken over
};

// What was done to a running program, written as a scenario that does it again.

// How the program was made and started. Paths can be opened from the working directory.
struct Start {
  std::vector<std::string> programs;
  std::vector<std::pair<std::string, std::string>> config; // those of the project first
  std::vector<std::string> connects;                       // statements of a scenario
  int64_t periodUs = 0;                                    // that a scenario chose; 0: the program's own
  std::optional<compiler::Project> project;                // that the files belong to
  std::string notAScenario;                                // not empty: why no scenario can start it so
};

class Recording {
public:
  explicit Recording(Start start) : start_(std::move(start)) {}

  const Start& start() const { return start_; }
  // A statement that did what it says, as a scenario writes it.
  void add(std::string statement);
  // A statement about another program, whose files these are; paths can be opened from the working directory.
  // `notAScenario`: not empty, why no scenario can do that.
  void addProgram(std::string word, std::vector<std::string> files, const std::string& notAScenario);

  // The scenario, as the file of this path: what was added, then what the watched names hold now and the fault that has
  // stopped the program. Fails when no scenario can do the same.
  Result<std::string> scenario(const std::string& path, const Session& session,
                               const std::vector<std::string>& watched) const;

private:
  // The project that a scenario in this folder runs this program by, without naming it; null: it has to name it.
  const compiler::Project* ownProject(const std::string& folder) const;
  void writeStart(const std::string& path, const std::string& dialect, std::string& text) const;

  struct Done {
    std::string statement; // with `files`: its word alone
    std::vector<std::string> files = {};
  };
  Start start_;
  std::vector<Done> statements_;
};

// What the last word of a line at the prompt can become.

class Completion {
public:
  // `statements`: the words of all statements and commands. The session outlives this and has started.
  Completion(const Session& session, std::vector<std::string> statements)
      : session_(session), statements_(std::move(statements)) {}

  // Of word `index` of a line, which begins with a word whose others are these. Sorted; case does not matter.
  std::vector<std::string> of(Words words, size_t index, std::string_view word);

private:
  const std::vector<std::string>& values();

  const Session& session_;
  std::vector<std::string> statements_;
  std::vector<std::string> values_; // looked up when they are asked for first
  uint32_t generation_ = 0;         // of the instance, then
};

// The first part that all of them share.
std::string commonStart(const std::vector<std::string>& words);

// What a person types at a running program: every statement of a scenario, and commands that only look. Each line is
// executed at once; what was done can be saved as a scenario.

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
    Words words = Words::Other;
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

// Prints changes of watched names and messages, each with the time, and the lines of print statements.
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
#include "tools/scenario/names.h"
#include "tools/scenario/session.h"
#include "tools/scenario/statements.h"

namespace rung::scenario {

using Print = std::function<void(const std::string& line)>; // prints one or several lines, without the last line break

class Watch final : public Observer {
public:
  explicit Watch(Print print) : print_(std::move(print)) {}

  // Adds a name; "" or why it cannot be watched. Its first value is printed at the next look().
  std::string add(const std::string& name, const Session& session);
  // False: the name is not watched.
  bool remove(const std::string& name);
  std::vector<std::string> names() const;

  void scanned(const Session& session) override { look(session); }
  void replaced(const Session& session, const NextProgram& next) override;
  void printed(const std::string& line) override { print_(line); }
  // Prints the changes since the last look().
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
  bool otherTexts_ = false; // another program may have taken over, with other texts
};

// Records what was done to a running program as a scenario that does it again.

// How the program was compiled and started. Paths are relative to the working directory.
struct Start {
  std::vector<std::string> programs;
  std::vector<std::pair<std::string, std::string>> config; // those of the project first
  std::vector<std::string> connects;                       // connect statements
  int64_t periodUs = 0;                                    // period that a scenario chose; 0: the program's own
  std::optional<compiler::Project> project;                // the project that the files belong to
  std::string notAScenario;                                // not empty: why no scenario can start the program this way
};

class Recording {
public:
  explicit Recording(Start start) : start_(std::move(start)) {}

  const Start& start() const { return start_; }
  // Adds a statement that was executed, as a scenario writes it.
  void add(std::string statement);
  // Adds a statement that names another program, which consists of these files; paths are relative to the working
  // directory. `notAScenario`: if not empty, why no scenario can do that.
  void addProgram(std::string word, std::vector<std::string> files, const std::string& notAScenario);

  // The text of the scenario, for a file of this path: the recorded statements, then the current values of the watched
  // names and the fault that has stopped the program. Fails if no scenario can do the same.
  Result<std::string> scenario(const std::string& path, const Session& session,
                               const std::vector<std::string>& watched) const;

private:
  // The project through which a scenario in this folder finds the program without naming it; null: it has to name the
  // program.
  const compiler::Project* ownProject(const std::string& folder) const;
  void writeStart(const std::string& path, const std::string& dialect, std::string& text) const;

  struct Done {
    std::string statement; // if there are `files`: only the first word
    std::vector<std::string> files = {};
  };
  Start start_;
  std::vector<Done> statements_;
};

// Completes the last word of a line at the prompt.

class Completion {
public:
  // `statements`: the first words of all statements and commands. The session must have started and outlive this.
  Completion(const Session& session, std::vector<std::string> statements)
      : session_(session), statements_(std::move(statements)) {}

  // Completions of word `index` of a line; `words` says what the words after the first name. Sorted; case is ignored.
  std::vector<std::string> of(Words words, size_t index, std::string_view word);

private:
  const std::vector<std::string>& values();

  const Session& session_;
  std::vector<std::string> statements_;
  std::vector<std::string> values_; // looked up on first use
  uint32_t generation_ = 0;         // the instance's generation when values_ was filled
};

// The longest common prefix.
std::string commonStart(const std::vector<std::string>& words);

// The commands at the prompt of a running program: every statement of a scenario, and commands that only look. Each
// line is executed at once; what was done can be saved as a scenario.

enum class Outcome : uint8_t { Done, Failed, Interrupted, Quit };

// What executes the lines of a prompt (prompt.h).
class Interpreter {
public:
  virtual ~Interpreter() = default;
  // Executes one line as typed; empty lines and comments do nothing.
  virtual Outcome execute(std::string_view line) = 0;
  // Such as "scan 3, 0.030 s> ".
  virtual std::string prompt() const = 0;
  // Completions of the last word of the line, up to the cursor.
  virtual std::vector<std::string> completions(std::string_view line) = 0;
  virtual std::string_view greeting() const = 0;
};

// The words of a line as typed; the last one is empty after a blank.
std::vector<std::string> typedWords(std::string_view line);

class Console final : public Interpreter {
public:
  // All references must outlive the console.
  // `why`: the chain from the value of a name back to what it came from, or what is wrong. `whyUnexpected`: lines about
  // the value that an expectation has found, each preceded by a line break.
  using Why = std::function<Result<std::string>(const std::string& name)>;
  using WhyUnexpected = std::function<std::string(const Statement& expectation)>;
  Console(Session& session, Watch& watch, Recording& recording, Why why, WhyUnexpected whyUnexpected, Print print);

  // Reports a fault, too.
  Outcome execute(std::string_view line) override;
  // Executes a statement that was not typed: from --set or --scenario.
  Outcome execute(const Statement& statement);

  std::string prompt() const override; // with the session's scan and time
  std::vector<std::string> completions(std::string_view line) override;
  std::string_view greeting() const override {
    return "Statements as in a scenario; Tab completes, help lists them, quit ends.";
  }

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
  // Records the statement. Interrupted if it did less than it says.
  void reportEndOf(const Forces::Values& forced);
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
  Why why_;
  WhyUnexpected whyUnexpected_;
  Print print_;
  Completion completion_;
  bool faultReported_ = false;
};

// "the program stopped with a fault: …; try `rungc explain dead-loop`".
std::string faultLine(const runtime::Instance& instance);

} // namespace rung::scenario

// What was done to a running program, written as a scenario that does it again.
#pragma once
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "compiler/project.h"
#include "ir/support/result.h"
#include "tools/scenario/session.h"

namespace rung::scenario {

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

} // namespace rung::scenario

// Compiles the program of a scenario with its configuration and checks its expect_error and expect_warning statements.
#pragma once
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "compiler/compile.h"
#include "compiler/engines.h"
#include "tools/scenario/scenario.h"

namespace rung::scenario {

struct CompileStep {
  std::optional<compiler::Compiled> program; // nothing when there is nothing to run: errors, expected or not
  std::vector<Problem> problems;
  std::vector<std::string> files; // of the sources, with those that they include
  std::string environment;        // a file that cannot be read
};

// See CompileRequest.
struct CompileSettings {
  bool strict = false;
  bool instrument = false;
  bool marks = false;
};

// `programs`: instead of the files that the scenario names, when not empty.
CompileStep compileProgram(const Scenario& scenario, const std::vector<std::string>& programs,
                           const CompileSettings& settings);
// The program of a replace or shadow statement, with the configuration of the scenario's own, which is of this dialect.
CompileStep compileNext(const Scenario& scenario, const Statement& s, const frontend::Dialect& dialect,
                        const CompileSettings& settings);

// The files of a program, replace or shadow statement, which lie beside the file that names them.
std::vector<std::string> programPaths(const Statement& s);

// "" or that the file is of another dialect than the program that runs.
std::string dialectProblem(const SourceManager& sources, FileId file, std::string_view running);

// Whether the compiler itself reads this configuration key; the rest is for the simulated NC.
bool readsKey(const frontend::Dialect& dialect, std::string_view key);

// Engines of programs that several scenarios run: each is built once, and the programs used last stay. Compiling costs
// far more than running a scenario.

// A program and the engines that were made of it; several threads may ask for them.
class StoredProgram {
public:
  explicit StoredProgram(compiler::Compiled compiled) : compiled_(std::move(compiled)) {}

  const compiler::Compiled& compiled() const { return compiled_; }
  // Makes the engine when it is asked for first.
  Result<runtime::Engine*> engine(compiler::EngineKind kind, const compiler::EngineOptions& options);

private:
  compiler::Compiled compiled_;
  std::mutex mutex_; // of what follows: the others wait while one makes the engine that they need, too
  std::map<compiler::EngineKind, std::unique_ptr<runtime::Engine>> engines_;
};

// All programs in it are run with the same EngineOptions.
class EngineStore {
public:
  // The stored program with the same code (Compiled::codeHash), or this one, stored.
  std::shared_ptr<StoredProgram> enter(compiler::Compiled compiled);

  static constexpr size_t kPrograms = 4;

private:
  std::mutex mutex_;
  std::list<std::shared_ptr<StoredProgram>> programs_; // used last first
};

} // namespace rung::scenario

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
  std::optional<compiler::Compiled> program; // nothing if it has errors, expected or not
  std::vector<Problem> problems;
  std::vector<std::string> files; // the sources and all files that they include
  std::string environment;        // why a file cannot be read
};

// The same fields as in CompileRequest.
struct CompileSettings {
  bool strict = false;
  bool instrument = false;
  bool marks = false;
  bool optimise = true;
};

// `programs`: if not empty, they replace the files that the scenario names.
CompileStep compileProgram(const Scenario& scenario, const std::vector<std::string>& programs,
                           const CompileSettings& settings);
// Compiles the program of a replace or shadow statement, which has this dialect, with the scenario's configuration.
CompileStep compileNext(const Scenario& scenario, const Statement& s, const frontend::Dialect& dialect,
                        const CompileSettings& settings);

// Paths of the files of a program, replace or shadow statement; relative ones start at the folder of the file that
// names them.
std::vector<std::string> programPaths(const Statement& s);

// "" or a message that the file is of another dialect than the running program.
std::string dialectProblem(const SourceManager& sources, FileId file, std::string_view running);

// Whether the compiler reads this configuration key; all other keys are for the simulated NC.
bool readsKey(const frontend::Dialect& dialect, std::string_view key);

// Engines of programs that several scenarios run: each is built once, and the most recently used programs are kept.
// Compiling costs far more than running a scenario.

// A program and the engines that were built from it. Any thread may use it.
class StoredProgram {
public:
  explicit StoredProgram(compiler::Compiled compiled) : compiled_(std::move(compiled)) {}

  const compiler::Compiled& compiled() const { return compiled_; }
  // Builds the engine on the first call.
  Result<runtime::Engine*> engine(compiler::EngineKind kind, const compiler::EngineOptions& options);

private:
  compiler::Compiled compiled_;
  std::mutex mutex_; // protects the members below; while one thread builds an engine, others that need it wait
  std::map<compiler::EngineKind, std::unique_ptr<runtime::Engine>> engines_;
};

// Programs with their engines. All of them must be run with the same EngineOptions.
class EngineStore {
public:
  // The stored program with the same code (Compiled::codeHash), or the given one, which is then stored.
  std::shared_ptr<StoredProgram> enter(compiler::Compiled compiled);

  static constexpr size_t kPrograms = 4;

private:
  std::mutex mutex_;
  std::list<std::shared_ptr<StoredProgram>> programs_; // most recently used first
};

} // namespace rung::scenario

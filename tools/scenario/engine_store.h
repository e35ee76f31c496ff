// Engines of programs that several scenarios run: each is built once, and the programs used last stay. Compiling costs
// far more than running a scenario.
#pragma once
#include <list>
#include <map>
#include <memory>
#include <mutex>

#include "compiler/engines.h"

namespace rung::scenario {

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

// Engines of programs that several scenarios run: each is built once, and the programs used last stay. Compiling costs
// far more than running a scenario.
#pragma once
#include <list>
#include <map>
#include <memory>

#include "tools/driver/engines.h"

namespace rung::scenario {

// A program and the engines that were made of it.
class StoredProgram {
public:
  explicit StoredProgram(driver::Compiled compiled) : compiled_(std::move(compiled)) {}

  const driver::Compiled& compiled() const { return compiled_; }
  // Makes the engine when it is asked for first.
  Result<host::Engine*> engine(driver::EngineKind kind, const driver::EngineOptions& options);

private:
  driver::Compiled compiled_;
  std::map<driver::EngineKind, std::unique_ptr<host::Engine>> engines_;
};

// All programs in it are run with the same EngineOptions.
class EngineStore {
public:
  // The stored program with the same code (Compiled::codeHash), or this one, stored. It stays valid until kPrograms
  // others have been asked for.
  StoredProgram& enter(driver::Compiled compiled);

  static constexpr size_t kPrograms = 4;

private:
  std::list<StoredProgram> programs_; // used last first
};

} // namespace rung::scenario

// Engines of programs that several scenarios run (see engine_store.h).
#include "tools/scenario/engine_store.h"

#include <algorithm>

namespace rung::scenario {

Result<host::Engine*> StoredProgram::engine(driver::EngineKind kind, const driver::EngineOptions& options) {
  auto found = engines_.find(kind);
  if (found == engines_.end()) {
    Result<std::unique_ptr<host::Engine>> made = driver::makeEngine(kind, compiled_, options);
    if (!made.ok()) return made.failure();
    found = engines_.emplace(kind, std::move(made).value()).first;
  }
  return found->second.get();
}

StoredProgram& EngineStore::enter(driver::Compiled compiled) {
  const auto found = std::find_if(programs_.begin(), programs_.end(), [&](const StoredProgram& stored) {
    return stored.compiled().codeHash == compiled.codeHash;
  });
  if (found != programs_.end()) {
    programs_.splice(programs_.begin(), programs_, found);
  } else {
    programs_.emplace_front(std::move(compiled));
    if (programs_.size() > kPrograms) programs_.pop_back();
  }
  return programs_.front();
}

} // namespace rung::scenario

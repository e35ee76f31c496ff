// Engines of programs that several scenarios run (see engine_store.h).
#include "tools/scenario/engine_store.h"

#include <algorithm>

namespace rung::scenario {

Result<runtime::Engine*> StoredProgram::engine(compiler::EngineKind kind, const compiler::EngineOptions& options) {
  const std::lock_guard lock(mutex_);
  auto found = engines_.find(kind);
  if (found == engines_.end()) {
    Result<std::unique_ptr<runtime::Engine>> made = compiler::makeEngine(kind, compiled_, options);
    if (!made.ok()) return made.failure();
    found = engines_.emplace(kind, std::move(made).value()).first;
  }
  return found->second.get();
}

std::shared_ptr<StoredProgram> EngineStore::enter(compiler::Compiled compiled) {
  const std::lock_guard lock(mutex_);
  const auto found =
      std::find_if(programs_.begin(), programs_.end(), [&](const std::shared_ptr<StoredProgram>& stored) {
        return stored->compiled().codeHash == compiled.codeHash;
      });
  if (found != programs_.end()) {
    programs_.splice(programs_.begin(), programs_, found);
  } else {
    programs_.push_front(std::make_shared<StoredProgram>(std::move(compiled)));
    if (programs_.size() > kPrograms) programs_.pop_back();
  }
  return programs_.front();
}

} // namespace rung::scenario

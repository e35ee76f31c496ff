// The past of a session that runs, for the question why a value is what it is: the session is recorded, in memory
// unless a recorder writes files already, and played up to now for each question.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "compiler/code_maker.h"
#include "tools/replay/record_run.h"

namespace rung::replay {

class SessionPast final : public scenario::Observer {
public:
  // To be made when the session has started, and added to it as an observer; the session outlives it. `program`: the
  // one that the session began with. `recorder`: of files, an observer itself; null: it records in memory.
  SessionPast(scenario::Session& session, compiler::GetCompiled program, SessionRecorder* recorder);

  void executing(const scenario::Session& session, const scenario::Statement& statement) override;
  void scanned(const scenario::Session& session) override;
  void replaced(const scenario::Session& session, const scenario::NextProgram& next) override;

  // While the session repeats scans and statements that have been, from a snapshot on, nothing of it is recorded.
  void setRepeats(bool repeats) { recorder_->setPaused(repeats); }

  // The chain, as `rungc replay` prints it, for a name of the program or of the NC; the error says what is wrong.
  // `back`: so many scans before the newest one, where the session is while it repeats.
  Result<std::string> why(const std::string& name, uint64_t back = 0);

private:
  Result<Recording> recording();

  scenario::Session& session_;
  std::vector<compiler::GetCompiled> programs_; // all that have run
  std::unique_ptr<SessionRecorder> own_;
  SessionRecorder* recorder_;
};

} // namespace rung::replay

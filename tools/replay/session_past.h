// The past of a session that runs, for the question why a value is what it is: the session is recorded, in memory
// unless a recorder writes files already, and played up to now for each question.
#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "compiler/code_maker.h"
#include "tools/replay/record_run.h"
#include "tools/replay/why.h"

namespace rung::replay {

class SessionPast final : public scenario::Observer {
public:
  // To be made when the session has started, and added to it as an observer; the session outlives it. `program`: the
  // one that the session began with. `recorder`: of files, an observer itself; null: it records in memory.
  SessionPast(scenario::Session& session, compiler::GetCompiled program, SessionRecorder* recorder);

  void executing(const scenario::Session& session, const scenario::Statement& statement) override;
  void started(scenario::Session& session) override;
  void restored(const scenario::Session& session) override;
  void scanned(const scenario::Session& session) override;
  void replaced(const scenario::Session& session, const scenario::NextProgram& next) override;

  // While the session repeats scans and statements that have been, from a snapshot on, nothing of it is recorded.
  void setRepeats(bool repeats) { recorder_->setPaused(repeats); }

  // That have run so far, as the chain counts them: not those of a program that has stopped with a fault.
  uint64_t scans();
  // The chain, as `rungc replay` prints it, for a name of the program or of the NC; the error says what is wrong.
  // `back`: so many scans before the newest one, where the session is while it repeats.
  Result<std::string> why(const std::string& name, uint64_t back = 0);
  // The first steps of the chain for the value that an expectation has found, each line preceded by a line break.
  // `rest`: the command that shows all of it. "": nothing is recorded of that value.
  std::string whyUnexpected(const scenario::Statement& expectation, const std::string& rest);

private:
  // Why the name has its value, or a text in place of that.
  struct Answer {
    std::optional<Explanation> explanation;
    std::string text;
  };
  Result<Answer> answer(const std::string& name, bool wantReal, uint64_t back);
  Result<Recording> recording();

  scenario::Session& session_;
  std::vector<compiler::GetCompiled> programs_; // all that have run
  std::unique_ptr<SessionRecorder> own_;
  SessionRecorder* recorder_;
};

// Runs the scenario. If it fails because a name has another value than it expects, the problem says why it has that
// one: the scenario is run a second time, recorded.
scenario::RunResult runAndExplain(const scenario::Scenario& scenario, const scenario::RunOptions& options);

} // namespace rung::replay

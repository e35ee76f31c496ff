// Records a program in a simulated control: scenarios and runs at the prompt.
#pragma once
#include <memory>
#include <string>

#include "rtlib/record/recorder.h"
#include "tools/replay/recording.h"
#include "tools/scenario/runner.h"
#include "tools/scenario/session.h"

namespace rung::replay {

// Records a session from its start on; to be added to it as an observer then. The session outlives it, or `take`.
class SessionRecorder final : public scenario::Observer {
public:
  explicit SessionRecorder(scenario::Session& session);
  ~SessionRecorder() override;
  SessionRecorder(const SessionRecorder&) = delete;
  SessionRecorder& operator=(const SessionRecorder&) = delete;

  void executing(const scenario::Session& session, const scenario::Statement& statement) override;
  void scanned(const scenario::Session&) override { drain(); }
  void replaced(const scenario::Session& session, const scenario::NextProgram& next) override;

  // What has been recorded; its programs are still missing.
  Recording take();

private:
  class Counter;
  void drain();

  runtime::Instance* instance_;
  std::unique_ptr<Counter> counter_;
  Recording recording_;
};

struct RecordedScenario {
  Recording recording; // to the end, or to the statement that failed
  scenario::RunResult result;
};

// Runs the scenario and records it. Fails if it cannot be run.
Result<RecordedScenario> recordScenario(const scenario::Scenario& scenario, scenario::RunOptions options);

} // namespace rung::replay

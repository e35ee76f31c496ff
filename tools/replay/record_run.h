// Records a program in a simulated control: scenarios and runs at the prompt.
#pragma once
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "rtlib/record/recorder.h"
#include "rtlib/record/recording_writer.h"
#include "tools/replay/recording.h"
#include "tools/scenario/runner.h"
#include "tools/scenario/session.h"

namespace rung::replay {

// The statement of a mark that SessionRecorder has made; nothing for other marks.
std::optional<scenario::Statement> statementOf(std::string_view mark);

// Records a session from its start on; to be added to it as an observer then. The session outlives it, or `take`. The
// statements are its marks.
class SessionRecorder final : public scenario::Observer {
public:
  // In memory, of which it uses so much: the oldest parts go then.
  explicit SessionRecorder(scenario::Session& session, size_t mostBytes = size_t{256} << 20);
  // Into a folder, which is made. `program` is that of the session, with its module as built. Throws
  // std::runtime_error if the folder cannot be used.
  SessionRecorder(scenario::Session& session, const std::string& folder, const compiler::Compiled& program);
  ~SessionRecorder() override;
  SessionRecorder(const SessionRecorder&) = delete;
  SessionRecorder& operator=(const SessionRecorder&) = delete;

  void executing(const scenario::Session& session, const scenario::Statement& statement) override;
  void started(scenario::Session& session) override;
  void restored(const scenario::Session& session) override;
  void scanned(const scenario::Session& session) override;
  void replaced(const scenario::Session& session, const scenario::NextProgram& next) override;

  // Says how the program was compiled, as statements of a scenario.
  void noteConfiguration(const compiler::Compiled& program);

  // Paused: what happens is not recorded. When it continues, the session must be in the same state as then.
  void setPaused(bool paused);

  // What has been recorded so far; it is of these programs.
  Result<Recording> soFar(std::vector<std::shared_ptr<const compiler::Compiled>> programs);
  // Ends it. What has been recorded in memory; its programs are still missing.
  Recording take();

private:
  void drain();
  void flush();
  void take(std::span<const uint8_t> record);
  void add(const compiler::Compiled& program);
  void markAgain();

  runtime::Instance* instance_;
  std::unique_ptr<runtime::Recorder> recorder_;
  std::unique_ptr<runtime::RecordingWriter> writer_; // null: in memory
  std::string folder_;                               // of files
  std::unique_ptr<runtime::RecordedBytes> bytes_;    // of the former program
  std::string mark_;                                 // of the last statement
  uint64_t scans_ = 0;
  bool paused_ = false;
  size_t mostBytes_;
  size_t usedBytes_ = 0;
  Recording recording_;
};

struct RecordedScenario {
  Recording recording; // to the end, or to the statement that failed
  scenario::RunResult result;
};

// Runs the scenario and records it. Fails if it cannot be run.
Result<RecordedScenario> recordScenario(const scenario::Scenario& scenario, scenario::RunOptions options);

// Makes the one scenario that runs with these options record into the folder.
void recordInto(const std::string& folder, scenario::RunOptions& options);

} // namespace rung::replay

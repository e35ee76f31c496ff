// Records sessions (see record_run.h).
#include "tools/replay/record_run.h"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

#include "tools/scenario/compile_step.h"
#include "tools/scenario/statements.h"

namespace rung::replay {
namespace {

using runtime::BlockBytes;

// The simulated control writes in hooks and between parts; of a byte that the program only writes, too.
runtime::RecordedBytes recordedBytes(const rung_program& program) {
  const BlockBytes written = runtime::writtenBytes(program);
  BlockBytes compared = runtime::readBytes(program);
  for (size_t i = 0; i < written.size(); ++i) compared[i] = compared[i] || written[i];
  return {.before = runtime::WatchedBytes(program), .within = {program, compared}, .outputs = {program, written}};
}

constexpr size_t kRing = size_t{1} << 24;

} // namespace

// Passes everything on to a recorder, and counts parts.
class SessionRecorder::Counter final : public runtime::OutsideWatch {
public:
  explicit Counter(const runtime::Instance& instance)
      : recorder(instance, recordedBytes(instance.program()), {.ringBytes = kRing}) {}

  void begins(const runtime::Instance& instance, runtime::PartKind kind, uint32_t number) noexcept override {
    parts += depth_++ == 0 ? 1 : 0;
    recorder.begins(instance, kind, number);
  }
  void ended(const runtime::Instance& instance) noexcept override {
    --depth_;
    recorder.ended(instance);
  }
  void withinBegins(const runtime::Instance& instance) noexcept override { recorder.withinBegins(instance); }
  void withinEnded(const runtime::Instance& instance) noexcept override { recorder.withinEnded(instance); }
  void requested(const runtime::Instance& instance, const core::ServiceRequest& request,
                 const core::ServiceReply* reply) noexcept override {
    recorder.requested(instance, request, reply);
  }
  void written(const runtime::Instance& instance, uint32_t offset, uint32_t bytes) noexcept override {
    recorder.written(instance, offset, bytes);
  }
  void surroundingsChanged(const runtime::Instance& instance) noexcept override {
    recorder.surroundingsChanged(instance);
  }
  void changedWhole(const runtime::Instance& instance) noexcept override { recorder.changedWhole(instance); }

  runtime::Recorder recorder;
  uint64_t parts = 0;

private:
  uint32_t depth_ = 0;
};

SessionRecorder::SessionRecorder(scenario::Session& session)
    : instance_(&session.instance()), counter_(std::make_unique<Counter>(*instance_)) {
  recording_.segments.emplace_back();
  instance_->setOutsideWatch(counter_.get());
}

SessionRecorder::~SessionRecorder() {
  if (instance_ != nullptr) instance_->setOutsideWatch(nullptr);
}

void SessionRecorder::drain() {
  counter_->recorder.flush();
  core::ByteRing& ring = counter_->recorder.ring();
  std::vector<uint8_t>& events = recording_.segments.back().events;
  for (auto record = ring.front(); !record.empty(); record = ring.front()) {
    events.insert(events.end(), record.begin(), record.end());
    ring.pop();
  }
}

void SessionRecorder::executing(const scenario::Session&, const scenario::Statement& statement) {
  std::string text = statement.file.empty() ? statement.text
                                            : fmt::format("{}:{}: {}", statement.file, statement.line, statement.text);
  recording_.notes.push_back({counter_->parts, std::move(text)});
}

// The recorder's bytes are those of the former program.
void SessionRecorder::replaced(const scenario::Session& session, const scenario::NextProgram&) {
  drain();
  const uint64_t parts = counter_->parts;
  counter_ = std::make_unique<Counter>(session.instance());
  counter_->parts = parts;
  recording_.segments.emplace_back();
  instance_->setOutsideWatch(counter_.get());
}

Recording SessionRecorder::take() {
  drain();
  instance_->setOutsideWatch(nullptr);
  instance_ = nullptr;
  return std::move(recording_);
}

Result<RecordedScenario> recordScenario(const scenario::Scenario& scenario, scenario::RunOptions options) {
  RecordedScenario recorded;
  const scenario::CompileSettings settings{.strict = options.strict, .marks = true};
  std::vector<std::unique_ptr<compiler::Compiled>> programs;
  scenario::CompileStep step = scenario::compileProgram(scenario, options.programs, settings);
  if (!step.program) return failure(step.environment.empty() ? "its program does not compile" : step.environment);
  const frontend::Dialect& dialect = *step.program->dialect;
  programs.push_back(std::make_unique<compiler::Compiled>(std::move(*step.program)));
  for (const scenario::Statement& s : scenario.statements) {
    const bool takesOver = scenario::StatementInfo::of(s).program == scenario::OtherProgram::TakesOver;
    if (!takesOver || s.words.empty()) continue;
    scenario::CompileStep next = scenario::compileNext(scenario, s, dialect, settings);
    if (next.program) programs.push_back(std::make_unique<compiler::Compiled>(std::move(*next.program)));
  }
  std::unique_ptr<SessionRecorder> recorder;
  const auto started = std::exchange(options.started, {});
  options.started = [&](scenario::Session& session, const compiler::Compiled& program) {
    recorder = std::make_unique<SessionRecorder>(session);
    session.addObserver(*recorder);
    return started ? started(session, program) : std::string();
  };
  options.ended = [&](scenario::Session&) {
    recorded.recording = recorder->take();
    recorded.recording.programs = std::move(programs);
  };
  recorded.result = scenario::run(scenario, options);
  if (recorded.recording.programs.empty()) return failure("it cannot be run");
  return recorded;
}

} // namespace rung::replay

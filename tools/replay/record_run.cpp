// Records sessions (see record_run.h).
#include "tools/replay/record_run.h"

#include <algorithm>
#include <fmt/format.h>
#include <stdexcept>
#include <utility>

#include "compiler/embedded_ir.h"
#include "tools/replay/growing_recording.h"
#include "tools/scenario/compile_step.h"
#include "tools/scenario/statements.h"
#include "tools/scenario/words.h"

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

constexpr std::string_view kPeriodKey = "period_us"; // of CompileOptions::config

constexpr size_t kRing = size_t{1} << 24;
constexpr uint64_t kScansBetween = 512; // blocks of files

} // namespace

SessionRecorder::SessionRecorder(scenario::Session& session, size_t mostBytes)
    : instance_(&session.instance()),
      recorder_(std::make_unique<runtime::Recorder>(*instance_, recordedBytes(instance_->program()),
                                                    runtime::RecorderOptions{.ringBytes = kRing})),
      mostBytes_(mostBytes) {
  recording_.segments.emplace_back();
  instance_->setOutsideWatch(recorder_.get());
}

SessionRecorder::SessionRecorder(scenario::Session& session, const std::string& folder,
                                 const compiler::Compiled& program)
    : SessionRecorder(session) {
  const runtime::RecordingOptions options{.folder = folder, .limitBytes = UINT64_MAX};
  folder_ = folder;
  writer_ = std::make_unique<runtime::RecordingWriter>(recorder_->stream(), runtime::RecordingMode::Bytes, options);
  add(program);
  noteConfiguration(program);
}

SessionRecorder::~SessionRecorder() {
  if (instance_ != nullptr) (void)take();
}

void SessionRecorder::add(const compiler::Compiled& program) {
  if (writer_ == nullptr) return;
  const std::string text = compiler::irText(program);
  writer_->addProgram(program.codeHash, {reinterpret_cast<const uint8_t*>(text.data()), text.size()});
}

void SessionRecorder::noteConfiguration(const compiler::Compiled& program) {
  for (const auto& [key, value] : program.options.config) {
    if (key == kPeriodKey)
      recorder_->mark(fmt::format("period {}us", value));
    else if (scenario::readsKey(*program.dialect, key))
      recorder_->mark(fmt::format("config {} {}", key, scenario::asWord(value)));
  }
}

// The writer does without a thread of its own: the clock of a session runs far ahead of it.
void SessionRecorder::drain() {
  if (!writer_ || ++scans_ % kScansBetween == 0) flush();
}

void SessionRecorder::flush() {
  recorder_->flush();
  if (writer_) return writer_->look();
  core::ByteRing& ring = recorder_->ring();
  for (auto record = ring.front(); !record.empty(); record = ring.front()) {
    take(record);
    ring.pop();
  }
}

void SessionRecorder::setPaused(bool paused) {
  if (paused == std::exchange(paused_, paused)) return;
  instance_->setOutsideWatch(paused ? nullptr : recorder_.get());
}

void SessionRecorder::scanned(const scenario::Session&) {
  if (!paused_) drain();
}

// A record with a state begins with its program: what is before it can go.
void SessionRecorder::take(std::span<const uint8_t> record) {
  constexpr size_t kPieces = 16; // of which the oldest goes
  std::vector<Segment>& segments = recording_.segments;
  const bool isState = static_cast<runtime::Event>(record.front()) == runtime::Event::Program;
  if (isState && segments.back().events.size() > mostBytes_ / kPieces) segments.emplace_back();
  std::vector<uint8_t>& events = segments.back().events;
  events.insert(events.end(), record.begin(), record.end());
  usedBytes_ += record.size();
  while (usedBytes_ > mostBytes_ && segments.size() > 1) {
    usedBytes_ -= segments.front().events.size();
    Recording gone;
    gone.segments.push_back(std::move(segments.front()));
    segments.erase(segments.begin());
    recording_.partsBefore += Contents(gone).parts;
  }
}

void SessionRecorder::executing(const scenario::Session&, const scenario::Statement& statement) {
  if (paused_) return;
  mark_ = statement.file.empty() ? statement.text
                                 : fmt::format("{}:{}: {}", statement.file, statement.line, statement.text);
  recorder_->mark(mark_);
}

// A statement that has made the recording begin anew is before the state with which it does: what had not been written
// by then is dropped.
void SessionRecorder::markAgain() {
  if (!paused_ && !mark_.empty()) recorder_->mark(mark_);
}

void SessionRecorder::started(scenario::Session&) { markAgain(); }

void SessionRecorder::restored(const scenario::Session&) { markAgain(); }

void SessionRecorder::replaced(const scenario::Session& session, const scenario::NextProgram& next) {
  bytes_ = std::make_unique<runtime::RecordedBytes>(recordedBytes(session.instance().program()));
  recorder_->programChanged(bytes_);
  markAgain();
  if (writer_ && next.compiled)
    if (const Result<const compiler::Compiled*> program = next.compiled(); program.ok()) add(*program.value());
}

std::optional<scenario::Statement> statementOf(std::string_view mark) {
  for (;;) { // the place of the statement comes before it, and the name of a file may contain anything
    if (Result<scenario::Statement> statement = scenario::parseStatement(mark); statement.ok())
      return std::move(statement).value();
    const size_t colon = mark.find(": ");
    if (colon == std::string_view::npos) return std::nullopt;
    mark.remove_prefix(colon + 2);
  }
}

Result<Recording> SessionRecorder::soFar(std::vector<std::shared_ptr<const compiler::Compiled>> programs) {
  flush();
  if (writer_) return readRecording(folder_, std::move(programs));
  Recording recording = recording_;
  recording.programs = std::move(programs);
  return recording;
}

Recording SessionRecorder::take() {
  flush();
  writer_.reset();
  instance_->setOutsideWatch(nullptr);
  instance_ = nullptr;
  return std::move(recording_);
}

void recordInto(const std::string& folder, scenario::RunOptions& options) {
  auto recorder = std::make_shared<std::unique_ptr<SessionRecorder>>();
  const auto started = std::exchange(options.started, {});
  const auto ended = std::exchange(options.ended, {});
  options.marks = true;
  options.started = [=](scenario::Session& session, const compiler::Compiled& program) -> std::string {
    try {
      *recorder = std::make_unique<SessionRecorder>(session, folder, program);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    session.addObserver(**recorder);
    return started ? started(session, program) : std::string();
  };
  options.ended = [=](scenario::Session& session) {
    if (*recorder) (void)(*recorder)->take();
    if (ended) ended(session);
  };
}

Result<RecordedScenario> recordScenario(const scenario::Scenario& scenario, scenario::RunOptions options) {
  RecordedScenario recorded;
  const scenario::CompileSettings settings{.strict = options.strict, .marks = true};
  std::vector<std::shared_ptr<const compiler::Compiled>> programs;
  scenario::CompileStep step = scenario::compileProgram(scenario, options.programs, settings);
  if (!step.program) return failure(step.environment.empty() ? "its program does not compile" : step.environment);
  const frontend::Dialect& dialect = *step.program->dialect;
  programs.push_back(std::make_shared<compiler::Compiled>(std::move(*step.program)));
  for (const scenario::Statement& s : scenario.statements) {
    const bool takesOver = scenario::StatementInfo::of(s).program == scenario::OtherProgram::TakesOver;
    if (!takesOver || s.words.empty()) continue;
    scenario::CompileStep next = scenario::compileNext(scenario, s, dialect, settings);
    if (next.program) programs.push_back(std::make_shared<compiler::Compiled>(std::move(*next.program)));
  }
  std::unique_ptr<SessionRecorder> recorder;
  const auto started = std::exchange(options.started, {});
  options.started = [&](scenario::Session& session, const compiler::Compiled& program) {
    recorder = std::make_unique<SessionRecorder>(session);
    recorder->noteConfiguration(program);
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

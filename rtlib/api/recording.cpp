// See recording.h.
#include "rtlib/api/recording.h"

#include <algorithm>
#include <bit>
#include <chrono>

#include "rtlib/api/error.h"
#include "rtlib/api/instance.h"
#include "rtlib/api/running.h"
#include "rtlib/load/program_info.h"

namespace rung::api {

namespace {

constexpr const char* kLeftOut = "the program that runs was prepared before the recording began, and is not recorded: "
                                 "prepare it again";

// All that the program reads or writes; what it writes is compared at each state.
runtime::RecordedBytes recordedBytes(const rung_program& program) {
  const runtime::BlockBytes written = runtime::writtenBytes(program);
  runtime::BlockBytes within = runtime::readBytes(program);
  for (size_t i = 0; i < written.size(); ++i) within[i] = within[i] || written[i];
  return {
      .before = runtime::WatchedBytes(program), .within = {program, within}, .outputs = runtime::WatchedBytes(program)};
}

// Eight whole states at least.
size_t ringFor(const rung_instance& instance) {
  constexpr size_t kLeast = size_t{1} << 20, kStates = 8, kOther = 65'536;
  const size_t state = std::max<size_t>(stateSize(instance), instance.running.block().size()) + kOther;
  return std::bit_ceil(std::max(kLeast, kStates * state));
}

} // namespace

InstanceRecording::InstanceRecording(rung_instance& instance, const runtime::RecordingOptions& files,
                                     const runtime::RecorderOptions& options, const runtime::OpenFile& open)
    : instance_(instance) {
  runtime::RecorderOptions how = options;
  how.ringBytes = ringFor(instance);
  runtime::PartStream* stream = nullptr;
  if (instance.controlAlone) {
    instance.recorder = std::make_unique<HostRecorder>(instance, how);
    stream = &instance.recorder->stream();
  } else {
    bytes_ = std::make_unique<runtime::Recorder>(instance.running, recordedBytes(instance.running.program()), how);
    stream = &bytes_->stream();
  }
  try {
    writer_ = std::make_unique<runtime::RecordingWriter>(
        *stream, instance.controlAlone ? runtime::RecordingMode::Control : runtime::RecordingMode::Bytes, files, open);
  } catch (...) {
    instance.recorder.reset();
    throw;
  }
  if (bytes_ != nullptr) instance.running.setOutsideWatch(bytes_.get());
}

InstanceRecording::~InstanceRecording() {
  instance_.running.setOutsideWatch(nullptr);
  if (bytes_ != nullptr) bytes_->flush();
  if (instance_.recorder) instance_.recorder->stream().flush();
  writer_.reset();
  instance_.recorder.reset();
}

void InstanceRecording::addProgram(const Image& image) {
  if (image.loaded == nullptr) return;
  std::vector<uint8_t> bytes;
  constexpr size_t kStep = size_t{1} << 20;
  for (;;) {
    const size_t before = bytes.size();
    bytes.resize(before + kStep);
    const std::optional<size_t> read =
        image.loaded->readFile(before, {reinterpret_cast<char*>(bytes.data()) + before, kStep});
    bytes.resize(before + read.value_or(0));
    if (read.value_or(0) == 0) break;
  }
  writer_->addProgram(image.program.code_hash, bytes);
}

InstanceRecording::Next InstanceRecording::prepare(const Generation& generation) const {
  if (instance_.recorder) return {.inputs = inputBits(instance_, generation)};
  return {.bytes = std::make_unique<runtime::RecordedBytes>(recordedBytes(generation.program()))};
}

void InstanceRecording::programChanged(Next& next) noexcept {
  leavesOut_.store(instance_.recorder ? next.inputs == nullptr : next.bytes == nullptr, std::memory_order_relaxed);
  if (instance_.recorder)
    instance_.recorder->programChanged(next.inputs);
  else
    bytes_->programChanged(next.bytes);
}

} // namespace rung::api

using namespace rung;
using namespace rung::api;

namespace {

// Any thread; the recording begins and ends while no other one calls this.
InstanceRecording* recordingOf(const rung_instance* instance, int32_t& status) noexcept {
  rung_instance* handle = instanceOf(instance);
  status = handle == nullptr ? failHandle("an instance") : int32_t{RUNG_OK};
  if (handle == nullptr || handle->recording) return handle == nullptr ? nullptr : handle->recording.get();
  status = fail(RUNG_WRONG_STATE, "the instance is not recorded: see rung_instance_record");
  return nullptr;
}

} // namespace

int32_t rung_instance_record(rung_instance* instance, const rung_recording_options* options) {
  const Call call(instance);
  if (!call.ok()) return call.status();
  if (options == nullptr) {
    call->recording.reset();
    return RUNG_OK;
  }
  rung_recording_options given{};
  if (!takeStruct(options, given)) return failSize("rung_recording_options");
  if (given.folder == nullptr || *given.folder == 0)
    return fail(RUNG_BAD_ARGUMENT, "a recording needs the name of a folder");
  if (call->recording) return fail(RUNG_WRONG_STATE, "the instance is recorded already");
  if (call->now().blockPlan.hasInputs())
    return fail(RUNG_WRONG_STATE, "an instance with bound blocks or structs that the program reads cannot be recorded");
  return contained([&] {
    runtime::RecordingOptions files{.folder = given.folder};
    if (given.limit_bytes != 0) files.limitBytes = given.limit_bytes;
    if (given.kept_bytes != 0) files.keptBytes = given.kept_bytes;
    constexpr uint64_t kSegments = 8; // at least, so that not too much is deleted at once
    files.segmentBytes = std::min(files.segmentBytes, files.limitBytes / kSegments);
    runtime::RecorderOptions how;
    if (given.state_ms != 0) how.stateEveryUs = int64_t{given.state_ms} * 1000;
    call->recording = std::make_unique<InstanceRecording>(*call, files, how);
    call->recording->addProgram(*call->now().image);
    call->recording->writer().start();
    return int32_t{RUNG_OK};
  });
}

int32_t rung_instance_mark(rung_instance* instance, const char* text) {
  int32_t status = RUNG_OK;
  InstanceRecording* recording = recordingOf(instance, status);
  if (recording == nullptr) return status;
  if (text == nullptr) return fail(RUNG_BAD_ARGUMENT, "the text of a mark is null");
  return contained([&] {
    recording->writer().mark(text);
    return int32_t{RUNG_OK};
  });
}

int32_t rung_instance_keep_recording(rung_instance* instance) {
  int32_t status = RUNG_OK;
  if (InstanceRecording* recording = recordingOf(instance, status)) recording->writer().keep();
  return status;
}

int32_t rung_instance_follow_recording(rung_instance* instance) {
  int32_t status = RUNG_OK;
  if (InstanceRecording* recording = recordingOf(instance, status)) recording->writer().follow();
  return status;
}

int32_t rung_instance_recording(const rung_instance* instance, rung_recording_info* info) {
  int32_t status = RUNG_OK;
  InstanceRecording* recording = recordingOf(instance, status);
  if (recording == nullptr) return status;
  return contained([&] {
    const runtime::RecordingState state = recording->writer().state();
    rung_recording_info out{
        .since_us = state.sinceUs, .bytes = state.bytes, .written = state.written, .losses = state.losses};
    putText(out.folder, state.folder);
    putText(out.file, state.file);
    putText(out.problem, state.problem.empty() && recording->leavesOut() ? kLeftOut : state.problem.c_str());
    return giveStruct(info, out);
  });
}

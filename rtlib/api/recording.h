// The recording of an instance: who records, and who writes it.
#pragma once
#include <atomic>
#include <cstdint>
#include <memory>

#include "rtlib/api/host_recorder.h"
#include "rtlib/record/recorder.h"
#include "rtlib/record/recording_writer.h"

namespace rung::api {

struct Image;

class InstanceRecording {
public:
  // Throws std::runtime_error (see RecordingWriter).
  InstanceRecording(rung_instance& instance, const runtime::RecordingOptions& files,
                    const runtime::RecorderOptions& options, const runtime::OpenFile& open = &runtime::openAppended);
  ~InstanceRecording();
  InstanceRecording(const InstanceRecording&) = delete;
  InstanceRecording& operator=(const InstanceRecording&) = delete;

  runtime::RecordingWriter& writer() noexcept { return *writer_; }
  // A program that may run: its file is added, if it has one.
  void addProgram(const Image& image);
  // Of a replacement, for the program that it holds.
  struct Next {
    std::unique_ptr<runtime::InputBits> inputs;
    std::unique_ptr<runtime::RecordedBytes> bytes;
  };
  Next prepare(const Generation& generation) const;
  // The program of a replacement that was prepared before the recording began is not recorded: `leavesOut`.
  void programChanged(Next& next) noexcept;
  bool leavesOut() const noexcept { return leavesOut_.load(std::memory_order_relaxed); } // any thread

private:
  rung_instance& instance_;
  std::unique_ptr<runtime::Recorder> bytes_; // where not only the control is around the program
  std::unique_ptr<runtime::RecordingWriter> writer_;
  std::atomic<bool> leavesOut_{false};
};

} // namespace rung::api

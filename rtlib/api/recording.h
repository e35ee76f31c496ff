// The recording of an instance: who records, and who writes it.
#pragma once
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
  void programChanged(Next& next) noexcept;

private:
  rung_instance& instance_;
  std::unique_ptr<runtime::Recorder> bytes_; // where not only the control is around the program
  std::unique_ptr<runtime::RecordingWriter> writer_;
};

} // namespace rung::api

// The retained memory of a running program on disk, as the tools use it: taken at the start, saved while the program
// runs, and at its end. Files: FILE.a and FILE.b (see retain.h), by the dialect's addresses (see retain_map.h).
#pragma once
#include <memory>

#include "rtlib/host/retain.h"

namespace rung::host {

class RetainedMemory {
public:
  RetainedMemory(const rung_program& program, const std::string& file,
                 std::chrono::milliseconds period = std::chrono::milliseconds(200));

  // Before the program's warm start; false: nothing could be taken, and it starts cold. `report` is a message for the
  // user, "" when there was no file. The first image is written at once, so that a place that cannot be written shows:
  // then `error` says why.
  bool load(Instance& instance, std::string& report, std::string& error);

  // Scan thread, after every scan: copies at most once a period, never waits and allocates nothing.
  // False: the last image is still being written.
  bool offer(const Instance& instance) noexcept { return saver_->offer(instance); }
  // What was offered last is on disk, or could not be written: then `failed` has grown.
  bool written() const noexcept { return saver_->idle(); }
  uint64_t failed() const noexcept { return saver_->failed(); }

  // After the last scan: the image of now is on disk when it returns; "" or what has gone wrong since the start.
  std::string finish(const Instance& instance);

private:
  RetainMap map_;
  RetainStore store_; // until load has handed it to the saver
  std::string file_;
  std::chrono::milliseconds period_;
  std::unique_ptr<RetainSaver> saver_;
};

} // namespace rung::host

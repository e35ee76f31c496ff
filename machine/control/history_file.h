// A history on disk: a file to which lines are added as entries come, by a thread of its own, as a disk may take its
// time. After a crash at any moment all but the last lines are there.
#pragma once
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <string>
#include <thread>

#include "machine/control/history.h"

namespace rung::control {

// For the thread of the history.
class HistoryFile {
public:
  static constexpr size_t kMostBytes = 1 << 20; // a longer file is replaced by one with the entries that are left
  static constexpr int64_t kRetryS = 10;        // after a write that has failed

  // The history outlives it. What is in the file is read before anything else is in the history.
  HistoryFile(History& history, std::string path);
  ~HistoryFile(); // all of the history is on disk, where that can be
  HistoryFile(const HistoryFile&) = delete;
  HistoryFile& operator=(const HistoryFile&) = delete;

  // From time to time: has written what has changed. What people should know of it, or "": it fails, for another reason
  // than before, or works again.
  std::string tick(int64_t nowS);

private:
  void read();
  void give(std::string text, bool replaces);
  bool busy() const;
  void wait();
  void work();
  std::string write();
  std::string append();

  History& history_;
  const std::string path_;
  std::string problem_; // as it was reported
  bool anew_ = false;   // the file is to be replaced
  int64_t triedS_ = 0;
  mutable std::mutex mutex_; // for the rest; while it is busy, that is the thread's
  std::condition_variable changed_;
  bool busy_ = false;
  bool ending_ = false;
  std::string text_;
  bool replaces_ = false;
  std::string failed_; // why the last one was not written; "": it was
  uint64_t size_ = 0;  // of the file
  std::thread thread_;
};

} // namespace rung::control

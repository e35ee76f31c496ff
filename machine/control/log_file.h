// The log on disk: FILE, and FILE.1 with what was in it before. A thread appends lines as entries change, because a
// disk may be slow. A crash at any moment loses only the last lines.
#pragma once
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "machine/control/log_entries.h"
#include "rtlib/load/file.h"

namespace rung::control {

// The name of the older file.
std::string olderLog(const std::string& path);

// The log of files, whether their host runs or not, sorted by number.
struct LogInFiles {
  std::vector<LogEntry> entries;
  // Which lines are not entries, a sentence for each file that has some. A last line without its end is none of them.
  std::vector<std::string> wrong;
  std::string problem; // why a file cannot be read; "": they could be, or do not exist
  bool found = false;  // at least one of the two exists
};
LogInFiles readLog(const std::string& path);

// Service thread, like the entries; an internal thread writes.
class LogFile {
public:
  static constexpr int64_t kRetryS = 10; // after a failed write

  // The entries outlive this object. The constructor reads the newest entries of the files, before there are any
  // others. `mostBytes`: of both files together.
  LogFile(LogEntries& entries, std::string path, uint64_t mostBytes);
  ~LogFile(); // writes all changes, if possible
  LogFile(const LogFile&) = delete;
  LogFile& operator=(const LogFile&) = delete;

  const std::string& path() const { return path_; }
  // Why the log is not written; "": it is.
  const std::string& problem() const { return problem_; }
  // Called in each turn: writes the changes. Returns a report for users, or "": writing fails, for another reason than
  // before, or works again; entries are lost.
  std::string tick(int64_t nowS);
  bool busy() const; // changes are being written

private:
  void read();
  std::string reportOf(bool isNew, int64_t nowS);
  void give(LogEntries::Lines lines);
  void wait();
  void work();
  std::string write();
  std::string turnOver();
  std::string append(std::string_view text);

  LogEntries& entries_;
  const std::string path_;
  const uint64_t most_; // bytes of one file
  std::string problem_; // as it was reported
  int64_t triedS_ = 0;
  size_t wrongLines_ = 0;    // found by `read`, not yet reported
  int64_t lostS_ = 0;        // when losses were last reported
  mutable std::mutex mutex_; // protects the members below; while busy_, they belong to the writing thread
  std::condition_variable changed_;
  bool busy_ = false;
  bool ending_ = false;
  std::string text_;   // to be written; kept after a failure
  std::string others_; // lines with which a new file begins
  std::string failed_; // why the last write failed; "": it succeeded
  uint64_t size_ = 0;  // of the file, without
  uint64_t torn_ = 0;  // the bytes of a line that was not completed
  uint64_t begun_ = 0; // the bytes with which the file began, repeated from the former one
  std::thread thread_;
};

} // namespace rung::control

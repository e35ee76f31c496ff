// The log of a host: everything that happens to its program, in one place. Each entry is written as a line with its
// time to the host's standard error, stays in memory for requests, and is appended to a file if the host keeps one.
// What is repeated is written a few times, and then only counted.
#pragma once
#include <cstdint>
#include <functional>
#include <list>
#include <memory>
#include <string>
#include <vector>

#include "machine/control/log_entries.h"
#include "machine/control/log_file.h"
#include "rtlib/run/clock.h"

namespace rung::control {

// "2026-11-25 10:52:27", in local time.
std::string dateText(int64_t seconds);

// Service thread.
class Log {
public:
  using Write = std::function<void(const std::string& line)>;
  // The clock outlives the log.
  Log(runtime::Clock& clock, Write write) : clock_(clock), write_(std::move(write)) {}
  ~Log(); // writes the counts, and the changes to the file
  Log(const Log&) = delete;
  Log& operator=(const Log&) = delete;

  // Also keeps the log in this file and an older one, `mostBytes` together. To be called before the first entry.
  void keep(const std::string& path, uint64_t mostBytes);
  // Keeps it in FILE.log, for retained memory in FILE.a and FILE.b.
  void keepBeside(const std::string& retained, uint64_t mostBytes);
  // The file; null: none.
  const LogFile* file() const { return file_.get(); }
  const LogEntries& entries() const { return entries_; }

  // Adds an entry. Returns false if its text came so often within kPauseS that it is only counted.
  bool add(LogEntry entry);
  // Adds an entry of the host itself.
  bool line(const std::string& text) { return add({.kind = LogKind::Host, .text = text}); }
  // Adds an entry with a line of its own even if it is repeated: for actions of users.
  void always(LogEntry entry);
  void always(const std::string& text) { always({.kind = LogKind::Host, .text = text}); }

  // Messages of the program. Returns false as `add`.
  bool come(const LogEntry::Key& key, const std::string& text);
  // Returns the text; "": it was not on.
  std::string go(const LogEntry::Key& key) { return entries_.go(key, clock_.dateS()); }
  std::vector<std::string> goAll() { return entries_.goAll(clock_.dateS()); }
  // Marks the messages that are on as seen; returns their texts.
  std::vector<std::string> acknowledge() { return entries_.acknowledge(clock_.dateS()); }
  // The host ends.
  void end() { entries_.end(clock_.dateS()); }

  // Called in each turn: writes how often a line was counted, when it stops repeating, or after kPauseS, and changes to
  // the file. Returns a report about the file, or "".
  std::string tick();

  static constexpr uint32_t kMost = 5;   // how often a line is written
  static constexpr int64_t kPauseS = 10; // within this many seconds

private:
  struct Known {
    std::string text;
    int64_t firstS = 0;
    int64_t lastS = 0;
    uint32_t times = 0;   // repetitions since firstS
    uint32_t counted = 0; // of these, only counted
  };
  bool writeRepeated(const std::string& text);
  void write(int64_t seconds, const std::string& text);
  void settle(int64_t now);
  void writeCount(const Known& known);

  static constexpr size_t kKnown = 64; // number of texts remembered: the most recent ones

  runtime::Clock& clock_;
  Write write_;
  std::list<Known> known_; // most recent first
  LogEntries entries_;
  std::unique_ptr<LogFile> file_; // null: the log is only in memory
};

} // namespace rung::control

// The entries of a host's log: messages of the program, which come and go, and everything else that happens to it.
#pragma once
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include <nlohmann/json_fwd.hpp>
#include <sys/types.h>

namespace rung::control {

enum class LogKind : uint8_t {
  Message, // of the program: comes and goes
  Note,    // a message of the program that the operator does not see
  Fault,
  Restart, // of the program after a fault
  Report,  // of the host, for the operator
  Host,    // of the host, not for the operator: its start and end, connections
  // Changes by people.
  Acknowledge,
  Start,
  Stop,
  Reset,
  Set,
  Event,
  Force,
  Unforce,
  Compile,
  Shadow,
  Reload,
  Rollback,
  Profile,
  Mark, // also that a recording is kept
};
inline constexpr std::string_view kLogKinds[] = {
    "message", "note",  "fault",   "restart", "report", "host",   "acknowledge", "start",   "stop", "reset", "set",
    "event",   "force", "unforce", "compile", "shadow", "reload", "rollback",    "profile", "mark"}; // by LogKind

// Times are in seconds since 1970.
struct LogEntry {
  using Key = std::tuple<uint32_t, int32_t, int32_t>; // a message: number, channel, index
  struct Person {
    std::string name; // of the user
    uid_t user = 0;
    pid_t process = 0;
  };
  struct Place {       // of a fault
    uint32_t rung = 0; // as drawn, from 1; 0: none
    std::string file;  // "": unknown
    uint32_t line = 0; // 0: unknown
  };

  LogKind kind = LogKind::Host;
  std::string text;
  std::optional<Key> key = {};     // of a message
  std::optional<Person> by = {};   // of a change
  std::optional<Place> place = {}; // of a fault
  uint64_t number = 0;             // from 1; continues across starts of the host
  int64_t cameS = 0;
  std::optional<int64_t> wentS = {};
  std::optional<int64_t> seenS = {}; // when the message was acknowledged
  uint32_t times = 1;                // how often it happened: what flickers is one entry
  bool cut = false;                  // the host ended while the message was on; without wentS, the time is unknown
  // State in the memory of a host.
  uint64_t version = 0; // number of the last change
  bool changed = true;  // since its last line in the file
  uint32_t lines = 0;
  int64_t lineS = 0; // time of the last line
};

// "anna (user 1000, process 4711): set D8:2 from 0 to 5"; without a person the text alone.
std::string textOf(const LogEntry& entry);
// The members of an entry in files and answers (docs/control-protocol.md).
nlohmann::json jsonOf(const LogEntry& entry);
// Reads the lines of a log, of which a later one of an entry replaces the earlier one. Returns the numbers, from 1, of
// the lines that are not valid.
std::vector<size_t> readLogLines(std::string_view text, std::map<uint64_t, LogEntry>& entries);

// Service thread.
class LogEntries {
public:
  // Entries in memory besides those of messages that are on; the oldest ones that are on disk are dropped.
  static constexpr size_t kMost = 1000;
  static constexpr size_t kMostShown = 1000;
  static constexpr size_t kMostText = 2000;  // bytes; longer texts are cut
  static constexpr int64_t kPauseS = 10;     // between two lines of an entry that keeps changing
  static constexpr uint32_t kMostLines = 50; // per second

  using Key = LogEntry::Key;

  // A message appears. `again`: it appears so often that it gets no new entry.
  void come(const Key& key, const std::string& text, int64_t nowS, bool again);
  // A message disappears. Returns its text; "": it was not on.
  std::string go(const Key& key, int64_t nowS);
  // The program is switched on again, so no message is on. Returns the texts of those that were on.
  std::vector<std::string> goAll(int64_t nowS);
  // Adds an entry other than a message of the program.
  void happen(LogEntry entry, int64_t nowS, bool again = false);
  // Marks all messages that are on and not yet acknowledged; returns their texts.
  std::vector<std::string> acknowledge(int64_t nowS);
  // The host ends: messages that are on are marked as cut.
  void end(int64_t nowS);

  const std::deque<LogEntry>& entries() const { return entries_; }
  // Messages that are on, sorted by key.
  std::vector<LogEntry> shown() const;
  bool isOn(const LogEntry& entry) const;
  // Whether the entry was made since this start of the host.
  bool isNew(const LogEntry& entry) const { return entry.number >= first_; }
  // Number of the last change of any entry.
  uint64_t version() const { return version_; }
  // Entries that were dropped before they were written, since the last call.
  uint64_t takeLost();

  // ---- as lines of text; a later line of an entry replaces the earlier one

  struct Lines {
    std::string changed; // of entries that have changed since their last line
    std::string others;  // of the other messages that are on, so that a new file has all of them
  };
  // Lines of the changes that are due: entries that change all the time are written rarely.
  Lines takeLines(int64_t nowS);
  // Lines of all changes.
  Lines takeAll();
  // Reads the lines of a host that has ended; to be called first. Returns the number of lines that are not valid.
  size_t read(std::string_view text);

private:
  LogEntry* find(uint64_t number);
  LogEntry* lastOf(const LogEntry& like);
  LogEntry& add(LogEntry entry);
  void change(LogEntry& entry);
  void drop();
  static bool mayBeWritten(const LogEntry& entry, int64_t nowS);
  void take(LogEntry& entry, bool isDue, Lines& lines);

  std::deque<LogEntry> entries_;  // sorted by number
  std::map<Key, uint64_t> shown_; // numbers of the entries of messages that are on
  uint64_t last_ = 0;             // largest number
  uint64_t first_ = 1;
  uint64_t version_ = 0;
  uint64_t lost_ = 0;
  bool changed_ = false; // an entry has changed
  int64_t secondS_ = 0;  // the second in which lines were last taken
  uint32_t lines_ = 0;   // lines taken in that second
};

} // namespace rung::control

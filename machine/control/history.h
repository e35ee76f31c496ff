// The history of a host's reports: when each message of the program appeared and disappeared, and other events.
#pragma once
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <tuple>
#include <vector>

namespace rung::control {

// Service thread. Times are in seconds since 1970.
class History {
public:
  static constexpr size_t kMost = 1000; // entries; the oldest ones are dropped
  static constexpr size_t kMostShown = 1000;
  static constexpr int64_t kPauseS = 10;     // between two lines of an entry that keeps changing
  static constexpr uint32_t kMostLines = 50; // per second

  using Key = std::tuple<uint32_t, int32_t, int32_t>; // a message: number, channel, index
  struct Entry {
    uint64_t number = 0;    // continues across starts of the host
    std::optional<Key> key; // a message, which appears and disappears; nothing: an event
    std::string text;
    int64_t cameS = 0;
    std::optional<int64_t> wentS;
    uint32_t times = 1; // number of appearances: a flickering message is one entry
    bool cut = false;   // the host ended while the message was on; without wentS, the time is unknown
    // State of the lines written for this entry.
    bool changed = true; // since the last line
    uint32_t lines = 0;
    int64_t lineS = 0; // time of the last line
  };

  // A message appears. `again`: it appears so often that it gets no new entry.
  void come(const Key& key, const std::string& text, int64_t nowS, bool again);
  // A message disappears. Returns its text; "": it was not on.
  std::string go(const Key& key, int64_t nowS);
  // The program is switched on again, so no message is on. Returns the texts of those that were on.
  std::vector<std::string> goAll(int64_t nowS);
  void happen(const std::string& text, int64_t nowS);
  // The host ends: messages that are on are marked as cut.
  void end(int64_t nowS);

  const std::deque<Entry>& entries() const { return entries_; }
  // Messages that are on, sorted by key, including those whose entries were dropped.
  std::vector<Entry> shown() const;
  bool isOn(const Entry& entry) const;
  // Whether the entry was made since this start of the host.
  bool isNew(const Entry& entry) const { return entry.number >= first_; }

  // ---- as lines of text; a later line of an entry replaces the earlier one

  // Returns lines for the changes that are due: entries that change all the time are written rarely.
  std::string takeLines(int64_t nowS);
  // Returns lines for all entries.
  std::string takeAll();
  // Reads the lines of a host that has ended; to be called first. Returns false if some of the lines are not valid.
  bool read(const std::string& text);

private:
  Entry* find(uint64_t number);
  Entry* lastOf(const Key& key, const std::string& text);
  Entry& add(Entry entry);
  void change(Entry& entry);
  bool mayBeWritten(const Entry& entry, int64_t nowS) const;

  std::deque<Entry> entries_; // sorted by number
  std::map<Key, Entry> shown_;
  uint64_t last_ = 0; // largest number
  uint64_t first_ = 1;
  bool changed_ = false; // an entry has changed
  int64_t secondS_ = 0;  // the second in which lines were last taken
  uint32_t lines_ = 0;   // lines taken in that second
};

// The history on disk: a thread appends lines to a file as entries change, because a disk may be slow. After a crash at
// any moment, only the last lines may be missing.

// Service thread, like History; an internal thread writes.
class HistoryFile {
public:
  static constexpr size_t kMostBytes = 1 << 20; // a longer file is replaced by one with the current entries
  static constexpr int64_t kRetryS = 10;        // after a failed write

  // The history outlives this object. The constructor reads the file, before the history has any entries.
  HistoryFile(History& history, std::string path);
  ~HistoryFile(); // writes all of the history, if possible
  HistoryFile(const HistoryFile&) = delete;
  HistoryFile& operator=(const HistoryFile&) = delete;

  // Called in each turn: writes the changes. Returns a report for users, or "": writing fails, for another reason than
  // before, or works again.
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
  bool anew_ = false;   // the file must be replaced
  int64_t triedS_ = 0;
  mutable std::mutex mutex_; // protects the members below; while busy_, they belong to the writing thread
  std::condition_variable changed_;
  bool busy_ = false;
  bool ending_ = false;
  std::string text_;
  bool replaces_ = false;
  std::string failed_; // why the last write failed; "": it succeeded
  uint64_t size_ = 0;  // of the file
  std::thread thread_;
};

} // namespace rung::control

// What a host has reported: when each message of the program came and when it went, and what else has happened.
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

// For one thread. Times are in seconds since 1970.
class History {
public:
  static constexpr size_t kMost = 1000; // entries; the oldest ones go
  static constexpr size_t kMostShown = 1000;
  static constexpr int64_t kPauseS = 10;     // between two lines of an entry that changes again and again
  static constexpr uint32_t kMostLines = 50; // in a second

  using Key = std::tuple<uint32_t, int32_t, int32_t>; // of a message: number, channel, index
  struct Entry {
    uint64_t number = 0;    // they count on, over starts of the host
    std::optional<Key> key; // of a message, which comes and goes; nothing: an event of one moment
    std::string text;
    int64_t cameS = 0;
    std::optional<int64_t> wentS;
    uint32_t times = 1; // that it came: a message that flickers is one entry
    bool cut = false;   // the host has ended while it was on; without wentS it is not known when
    // The lines of it that have been written.
    bool changed = true; // since then
    uint32_t lines = 0;
    int64_t lineS = 0; // of the last one
  };

  // `again`: a message comes so often that it gets no new entry.
  void come(const Key& key, const std::string& text, int64_t nowS, bool again);
  // Its text; "" where it was not on.
  std::string go(const Key& key, int64_t nowS);
  // The program is switched on anew: none is on. The texts of those that were.
  std::vector<std::string> goAll(int64_t nowS);
  void happen(const std::string& text, int64_t nowS);
  // The host ends.
  void end(int64_t nowS);

  const std::deque<Entry>& entries() const { return entries_; }
  // Messages that are on, by their keys, also where their entries have gone.
  std::vector<Entry> shown() const;
  bool isOn(const Entry& entry) const;
  // The host was started since: it is not of an earlier one.
  bool isNew(const Entry& entry) const { return entry.number >= first_; }

  // ---- as lines of text, of which a later one of the same entry replaces the former one

  // What has changed, as far as it may be written now: little of what changes all the time.
  std::string takeLines(int64_t nowS);
  // All of it.
  std::string takeAll();
  // The lines of a host that has ended; before anything else. False: some are not lines of this kind.
  bool read(const std::string& text);

private:
  Entry* find(uint64_t number);
  Entry* lastOf(const Key& key, const std::string& text);
  Entry& add(Entry entry);
  void change(Entry& entry);
  bool mayBeWritten(const Entry& entry, int64_t nowS) const;

  std::deque<Entry> entries_; // by number
  std::map<Key, Entry> shown_;
  uint64_t last_ = 0; // number
  uint64_t first_ = 1;
  bool changed_ = false; // one of the entries
  int64_t secondS_ = 0;  // in which lines were taken
  uint32_t lines_ = 0;   // in that second
};

// A history on disk: a file to which lines are added as entries come, by a thread of its own, as a disk may take its
// time. After a crash at any moment all but the last lines are there.

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

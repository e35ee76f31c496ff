// See log_file.h.
#include "machine/control/log_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <cstdio>
#include <exception>
#include <map>
#include <utility>

#include "rtlib/run/realtime.h"

namespace rung::control {

using runtime::File;

namespace {

constexpr uint64_t kMostRead = uint64_t{512} << 20; // of a file that is shown: any log has less
constexpr uint64_t kTail = 1 << 20;                 // of a file that is continued: more than the entries in memory

std::string cannot(const char* what, const std::string& path, int code) {
  return std::string("cannot ") + what + " " + path + ": " + runtime::fileProblem(code);
}

uint64_t sizeOf(const File& file) {
  struct stat status{};
  return fstat(file.fd(), &status) == 0 ? static_cast<uint64_t>(status.st_size) : 0;
}

struct Tail {
  std::string text; // whole lines, and at the end perhaps one without its end
  std::string problem;
  bool found = false;
};

// Reads the last `most` bytes of a file.
Tail readTail(const std::string& path, uint64_t most) {
  const File file = runtime::openDiskFile(path, O_RDONLY);
  if (!file.ok() && errno == ENOENT) return {};
  if (!file.ok()) return {.text = {}, .problem = cannot("read", path, errno), .found = true};
  const uint64_t size = sizeOf(file);
  const uint64_t first = size > most ? size - most : 0;
  Tail tail{.text = std::string(size - first, '\0'), .problem = {}, .found = true};
  size_t read = 0;
  while (read < tail.text.size()) {
    const ssize_t got =
        pread(file.fd(), tail.text.data() + read, tail.text.size() - read, static_cast<off_t>(first + read));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) tail.problem = cannot("read", path, errno);
    if (got <= 0) break;
    read += static_cast<size_t>(got);
  }
  tail.text.resize(read);
  if (first != 0) tail.text.erase(0, std::min(tail.text.find('\n'), tail.text.size() - 1) + 1);
  return tail;
}

// Removes a last line without its end.
void dropTorn(std::string& text) { text.resize(text.rfind('\n') + 1); }

std::string wrongText(const std::string& path, const std::vector<size_t>& wrong) {
  const std::string first = "line " + std::to_string(wrong.front());
  if (wrong.size() == 1) return path + ": " + first + " is not an entry of a log, and is left out";
  return path + ": " + std::to_string(wrong.size()) +
         " lines are not entries of a log, and are left out; the first is " + first;
}

} // namespace

std::string olderLog(const std::string& path) { return path + ".1"; }

LogInFiles readLog(const std::string& path) {
  LogInFiles log;
  std::map<uint64_t, LogEntry> newest;
  for (const std::string& name : {olderLog(path), path}) {
    Tail tail = readTail(name, kMostRead);
    log.found = log.found || tail.found;
    if (!tail.problem.empty()) log.problem = tail.problem;
    dropTorn(tail.text);
    if (const std::vector<size_t> wrong = readLogLines(tail.text, newest); !wrong.empty())
      log.wrong.push_back(wrongText(name, wrong));
  }
  for (auto& [number, entry] : newest) log.entries.push_back(std::move(entry));
  return log;
}

LogFile::LogFile(LogEntries& entries, std::string path, uint64_t mostBytes)
    : entries_(entries), path_(std::move(path)), most_(mostBytes / 2) {
  read();
  thread_ = std::thread([this] { work(); });
}

LogFile::~LogFile() {
  wait();
  give(entries_.takeAll());
  wait();
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

// A last line without its end is the result of a crash; the first write removes it.
void LogFile::read() {
  Tail older = readTail(olderLog(path_), kTail);
  Tail newer = readTail(path_, kTail);
  failed_ = newer.problem.empty() ? older.problem : newer.problem;
  const size_t all = newer.text.size();
  dropTorn(older.text);
  dropTorn(newer.text);
  torn_ = all - newer.text.size();
  const File file = runtime::openDiskFile(path_, O_RDONLY);
  size_ = file.ok() ? sizeOf(file) - torn_ : 0;
  wrongLines_ = entries_.read(older.text + newer.text);
}

// Lines that could not be written wait, and entries after them wait in memory.
std::string LogFile::tick(int64_t nowS) {
  if (busy()) return {};
  const bool fails = !failed_.empty();
  const bool isNew = problem_ != failed_;
  problem_ = failed_;
  if (!fails || nowS - triedS_ >= kRetryS || nowS < triedS_) {
    LogEntries::Lines lines = fails ? LogEntries::Lines{} : entries_.takeLines(nowS);
    if (!lines.changed.empty() || fails) give(std::move(lines));
    triedS_ = nowS;
  }
  return reportOf(isNew, nowS);
}

std::string LogFile::reportOf(bool isNew, int64_t nowS) {
  if (isNew && !problem_.empty()) return "the log is not kept on disk: " + problem_;
  if (const size_t wrong = std::exchange(wrongLines_, 0); wrong != 0)
    return path_ + " has lines that do not belong to a log: " + std::to_string(wrong);
  const bool mayReport = nowS - lostS_ >= kRetryS || nowS < lostS_;
  const uint64_t lost = problem_.empty() && (isNew || mayReport) ? entries_.takeLost() : 0;
  if (lost != 0) lostS_ = nowS;
  const std::string losses = lost == 0 ? "" : "entries that are not on disk: " + std::to_string(lost);
  if (!isNew) return losses.empty() ? "" : "the log has lost " + losses;
  return "the log is kept on disk again" + (losses.empty() ? "" : "; lost " + losses);
}

bool LogFile::busy() const {
  const std::lock_guard lock(mutex_);
  return busy_;
}

void LogFile::wait() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return !busy_; });
}

// A text that could not be written is tried again with the lines that belong to it.
void LogFile::give(LogEntries::Lines lines) {
  {
    const std::lock_guard lock(mutex_);
    assert(!busy_);
    text_ += lines.changed;
    if (!lines.changed.empty()) others_ = std::move(lines.others);
    busy_ = true;
  }
  changed_.notify_all();
}

void LogFile::work() {
  runtime::becomeHelper();
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return busy_ || ending_; });
    if (!busy_) return;
    lock.unlock();
    failed_ = write();
    lock.lock();
    busy_ = false;
    changed_.notify_all();
  }
}

// A file that has nothing but its beginning does not turn over again, however small it may be.
std::string LogFile::write() try {
  std::string problem = size_ + text_.size() > most_ && size_ > begun_ ? turnOver() : "";
  if (problem.empty()) problem = append(text_);
  if (problem.empty()) text_.clear();
  return problem;
} catch (const std::exception& thrown) { // out of memory
  return thrown.what();
}

// The file becomes the older one, and a new one begins with the messages that are on, the newest ones if not all have
// room.
std::string LogFile::turnOver() {
  if (std::rename(path_.c_str(), olderLog(path_).c_str()) != 0 && errno != ENOENT)
    return cannot("replace", olderLog(path_), errno);
  size_ = torn_ = 0;
  const uint64_t room = most_ / 2;
  if (others_.size() > room) others_.erase(0, others_.find('\n', others_.size() - room) + 1);
  begun_ = others_.size();
  text_.insert(0, std::exchange(others_, {}));
  return {};
}

// Removes a line that was not completed. If the file has been changed from outside, the text is added at its end.
std::string LogFile::append(std::string_view text) {
  File file = runtime::openDiskFile(path_, O_WRONLY | O_CREAT);
  if (!file.ok()) return cannot("write", path_, errno);
  if (const uint64_t real = sizeOf(file); real != size_ + torn_) {
    size_ = real;
    torn_ = 0;
  }
  const auto end = static_cast<off_t>(size_);
  const bool good = (torn_ == 0 || ftruncate(file.fd(), end) == 0) && lseek(file.fd(), end, SEEK_SET) == end &&
                    runtime::writeAll(file.fd(), text) && fdatasync(file.fd()) == 0;
  const int code = errno;
  torn_ = good ? 0 : sizeOf(file) - size_;
  if (!good) return cannot("write", path_, code);
  if (!file.close()) return cannot("write", path_, errno);
  size_ += text.size();
  return {};
}

} // namespace rung::control

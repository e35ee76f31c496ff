// What is written when, and the thread that writes (see history_file.h).
#include "machine/control/history_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cassert>
#include <cerrno>
#include <exception>
#include <utility>

#include "rtlib/load/disk_file.h"
#include "rtlib/run/realtime.h"

namespace rung::control {

HistoryFile::HistoryFile(History& history, std::string path) : history_(history), path_(std::move(path)) {
  read();
  thread_ = std::thread([this] { work(); });
}

HistoryFile::~HistoryFile() {
  wait();
  give(history_.takeAll(), true);
  wait();
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

// A part of a line at its end is one of a crash; the first write leaves it out.
void HistoryFile::read() {
  std::string text, problem;
  if (!runtime::systemDisk().read(path_, 2 * kMostBytes, text, problem)) return;
  anew_ = true;
  size_ = text.size();
  const bool good = history_.read(text);
  if (problem.empty() && !good && text.ends_with('\n')) problem = "it has lines that do not belong to a history";
  if (!problem.empty()) failed_ = "cannot read " + path_ + ": " + problem;
}

std::string HistoryFile::tick(int64_t nowS) {
  if (busy()) return {};
  const bool fails = !failed_.empty();
  anew_ = anew_ || fails || size_ > kMostBytes;
  const bool isNew = problem_ != failed_;
  problem_ = failed_;
  if (!anew_ || !fails || nowS - triedS_ >= kRetryS || nowS < triedS_) {
    std::string text = anew_ ? history_.takeAll() : history_.takeLines(nowS);
    if (!text.empty()) give(std::move(text), std::exchange(anew_, false));
    triedS_ = nowS;
  }
  if (!isNew) return {};
  return problem_.empty() ? "the history of messages is kept again"
                          : "the history of messages is not kept: " + problem_;
}

bool HistoryFile::busy() const {
  const std::lock_guard lock(mutex_);
  return busy_;
}

void HistoryFile::wait() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return !busy_; });
}

void HistoryFile::give(std::string text, bool replaces) {
  {
    const std::lock_guard lock(mutex_);
    assert(!busy_);
    text_ = std::move(text);
    replaces_ = replaces;
    busy_ = true;
  }
  changed_.notify_all();
}

void HistoryFile::work() {
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

// A new file is one that replaces nothing: it is in its folder, too, when it is written.
std::string HistoryFile::write() try {
  if (!replaces_ && size_ != 0) return append();
  std::string error;
  const auto* bytes = reinterpret_cast<const uint8_t*>(text_.data());
  if (runtime::systemDisk().replace(path_, {bytes, text_.size()}, error)) size_ = text_.size();
  return error;
} catch (const std::exception& thrown) { // no memory
  return thrown.what();
}

std::string HistoryFile::append() {
  runtime::File file = runtime::openDiskFile(path_, O_WRONLY | O_APPEND);
  const bool good = file.ok() && runtime::writeAll(file.fd(), text_) && fdatasync(file.fd()) == 0 && file.close();
  if (!good) return "cannot write " + path_ + ": " + runtime::fileProblem(errno);
  size_ += text_.size();
  return {};
}

} // namespace rung::control

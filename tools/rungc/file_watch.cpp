// Waits until a file changes (see file_watch.h), by inotify.
#include "tools/rungc/file_watch.h"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fmt/format.h>
#include <poll.h>
#include <sys/inotify.h>
#include <sys/signalfd.h>
#include <unistd.h>
#include <utility>

namespace rung::rungc {
namespace {

namespace fs = std::filesystem;

constexpr int kSettleMs = 100; // an editor writes several times
constexpr uint32_t kChanges = IN_CLOSE_WRITE | IN_MOVED_TO | IN_DELETE | IN_MOVED_FROM;

std::string folderOf(const std::string& file) {
  const std::string folder = fs::path(file).parent_path().string();
  return folder.empty() ? "." : folder;
}

std::string normal(const fs::path& path) { return path.lexically_normal().string(); }

// A signal that stays pending would end the program once it is unblocked.
void takeSignal(int signals) {
  signalfd_siginfo taken{};
  while (read(signals, &taken, sizeof taken) < 0 && errno == EINTR) {
  }
}

sigset_t endSignals() {
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGINT);
  sigaddset(&set, SIGTERM);
  return set;
}

} // namespace

Result<FileWatch> FileWatch::open(const std::vector<std::string>& files, const std::vector<std::string>& folders,
                                  std::string ending, fs::file_time_type since) {
  const sigset_t signals = endSignals();
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  FileWatch watch(inotify_init1(IN_CLOEXEC | IN_NONBLOCK), signalfd(-1, &signals, SFD_CLOEXEC), std::move(ending));
  if (watch.notify_ < 0 || watch.signals_ < 0)
    return failure(fmt::format("cannot watch files: {}", std::strerror(errno)));
  for (const std::string& folder : folders)
    if (Result<void> added = watch.add(folder, true); !added.ok()) return added.failure();
  for (const std::string& file : files) {
    watch.files_.insert(normal(file));
    std::error_code none;
    if (!fs::is_directory(folderOf(file), none)) continue; // a wrong file name in a scenario
    if (Result<void> added = watch.add(folderOf(file), false); !added.ok()) return added.failure();
  }
  watch.changedBefore_ = watch.changedSince(since);
  return watch;
}

FileWatch::FileWatch(FileWatch&& other) noexcept
    : notify_(std::exchange(other.notify_, -1)), signals_(std::exchange(other.signals_, -1)),
      ending_(std::move(other.ending_)), folders_(std::move(other.folders_)), files_(std::move(other.files_)),
      changedBefore_(std::move(other.changedBefore_)) {}

FileWatch::~FileWatch() {
  if (notify_ >= 0) close(notify_);
  if (signals_ < 0) return;
  close(signals_);
  const sigset_t signals = endSignals();
  pthread_sigmask(SIG_UNBLOCK, &signals, nullptr);
}

Result<void> FileWatch::add(const std::string& folder, bool all) {
  const int watch = inotify_add_watch(notify_, folder.c_str(), kChanges);
  if (watch < 0) return failure(fmt::format("cannot watch '{}': {}", folder, std::strerror(errno)));
  // The same folder gets the same watch.
  const auto known = std::ranges::find(folders_, watch, &Folder::watch);
  if (known == folders_.end())
    folders_.push_back({watch, folder, all});
  else
    known->all = known->all || all;
  return {};
}

std::string FileWatch::changedSince(fs::file_time_type since) const {
  for (const std::string& file : files_) {
    std::error_code none;
    if (const fs::file_time_type written = fs::last_write_time(file, none); !none && written > since) return file;
  }
  return {};
}

// Reads the pending events; returns the last changed file that counts, or "".
std::string FileWatch::takeChange() {
  alignas(inotify_event) char buffer[16 * 1024];
  std::string changed;
  for (ssize_t size = 0; (size = read(notify_, buffer, sizeof buffer)) > 0;) {
    for (ssize_t at = 0; at < size;) {
      const auto* event = reinterpret_cast<const inotify_event*>(buffer + at);
      at += static_cast<ssize_t>(sizeof(inotify_event) + event->len);
      const auto folder = std::ranges::find(folders_, event->wd, &Folder::watch);
      if (folder == folders_.end() || event->len == 0) continue;
      const std::string path = normal(fs::path(folder->path) / event->name);
      if (files_.contains(path) || (folder->all && path.ends_with(ending_))) changed = path;
    }
  }
  return changed;
}

std::optional<std::string> FileWatch::wait() {
  std::string changed = std::exchange(changedBefore_, {});
  while (true) {
    pollfd polled[] = {{notify_, POLLIN, 0}, {signals_, POLLIN, 0}};
    const int ready = poll(polled, 2, changed.empty() ? -1 : kSettleMs);
    if (ready < 0 && errno != EINTR) return std::nullopt;
    if ((polled[1].revents & POLLIN) != 0) {
      takeSignal(signals_);
      return std::nullopt;
    }
    if (ready == 0) return changed;
    if (std::string now = takeChange(); !now.empty()) changed = std::move(now);
  }
}

} // namespace rung::rungc

// Work with a progress line (see working.h).
#include "tools/scenario/working.h"

#include <chrono>
#include <cstdio>
#include <fmt/format.h>
#include <unistd.h>
#include <utility>

#include "tools/scenario/progress.h"

namespace rung::scenario {

Working::Working(std::string what) : what_(std::move(what)) {
  if (isatty(STDERR_FILENO) != 0) thread_ = std::thread([this] { show(); });
}

Working::~Working() {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
  }
  ends_.notify_one();
  thread_.join();
}

void Working::say(std::string what) {
  const std::lock_guard lock(mutex_);
  what_ = std::move(what);
}

void Working::show() {
  constexpr auto kPause = std::chrono::milliseconds(500);
  Progress progress(stderr);
  std::unique_lock lock(mutex_);
  while (!ends_.wait_for(lock, kPause, [this] { return ended_; }))
    progress.show(fmt::format("{}, {:.0f} s", what_, progress.seconds()));
}

} // namespace rung::scenario

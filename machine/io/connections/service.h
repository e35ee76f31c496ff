// What serves one connection, on a thread of its own.
#pragma once
#include <atomic>
#include <mutex>
#include <string>
#include <utility>

namespace rung::io {

class Service {
public:
  virtual ~Service() = default;
  // On its thread, until `ending`; then the newest outputs go to the other side a last time, where it is there.
  virtual void run(const std::atomic<bool>& ending) noexcept = 0;

  // What has last gone wrong, for people; "" while nothing has. Any thread but the scan's.
  std::string problem() const {
    const std::lock_guard lock(mutex_);
    return problem_;
  }

protected:
  void setProblem(std::string text) {
    const std::lock_guard lock(mutex_);
    problem_ = std::move(text);
  }

private:
  mutable std::mutex mutex_;
  std::string problem_;
};

} // namespace rung::io

// Keeps what another thread ends alive while the scan thread uses it. That thread first takes it away from where the
// scan thread looks for it, and then waits until the scan thread is out. The scan thread enters before it looks. The
// order of both is one for all threads, so one of the two sees the other.
#pragma once
#include <atomic>
#include <thread>

namespace rung::runtime {

class ScanUse {
public:
  // Scan thread.
  void enter() noexcept { inside_.store(true); }
  void leave() noexcept { inside_.store(false); }
  // The other one.
  void wait() const noexcept {
    while (inside_.load()) std::this_thread::yield();
  }

private:
  std::atomic<bool> inside_{false};
};

} // namespace rung::runtime

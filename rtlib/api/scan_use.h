// Keeps what another thread ends alive while the scan thread uses it. That thread first takes it away from where the
// scan thread looks for it, and then waits until the scan thread is out. The scan thread enters before it looks. The
// order of both is one for all threads, so one of the two sees the other.
#pragma once
#include <atomic>
#include <thread>

namespace rung::api {

class ScanUse {
public:
  // Scan thread. An exchange and a fence where a store and a load would do: emulators of processors let a load overtake
  // the store before it, which the processors themselves do not.
  void enter() noexcept { inside_.exchange(true); }
  void leave() noexcept { inside_.store(false); }
  // The other one.
  void wait() const noexcept {
    std::atomic_thread_fence(std::memory_order_seq_cst);
    while (inside_.load()) std::this_thread::yield();
  }

private:
  std::atomic<bool> inside_{false};
};

} // namespace rung::api

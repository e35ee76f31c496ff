// ScanUse protects an object that the scan thread uses and another thread frees. The other thread first removes the
// object from where the scan thread finds it, then waits until the scan thread has left; the scan thread enters before
// it looks for the object. All these accesses are sequentially consistent, so at least one of the two threads sees the
// other.
#pragma once
#include <array>
#include <atomic>
#include <memory>
#include <mutex>
#include <vector>

#include "rtlib/api/error.h"
#include "rtlib/core/handover.h"

namespace rung::api {

class ScanUse {
public:
  // Scan thread: stores a sample.
  void enter() noexcept { inside_.exchange(true); }
  void leave() noexcept { inside_.store(false); }
  // The thread that frees the object: waits until the scan thread has left.
  void wait() const noexcept {
    std::atomic_thread_fence(std::memory_order_seq_cst);
    while (inside_.load()) std::this_thread::yield();
  }

private:
  std::atomic<bool> inside_{false};
};

// Watches: at the end of a scan, the scan thread stores the values of cells for other threads, without waiting.

// The head of a sample, before its values.
struct SampleHead {
  uint64_t generation = 0;
  uint64_t pass = 0;
  uint64_t nowUs = 0;
};

// The watches of an instance.
class Watches {
public:
  // Any thread. False: there are too many.
  bool add(rung_watch& watch);
  void remove(rung_watch& watch); // afterwards the scan thread does not use it

  // Scan thread, at the end of a scan: takes a sample for each watch.
  void sample(const rung_instance& instance) noexcept {
    if (count_.load(std::memory_order_relaxed) != 0) sampleEach(instance, false);
  }
  // Scan thread: takes a sample only for watches that have none yet.
  void sampleNew(const rung_instance& instance) noexcept {
    if (count_.load(std::memory_order_relaxed) != 0) sampleEach(instance, true);
  }

private:
  void sampleEach(const rung_instance& instance, bool onlyNew) noexcept;

  std::mutex changes_;
  std::atomic<uint32_t> count_{0};
  core::ScanUse sampling_;
  std::array<std::atomic<rung_watch*>, RUNG_MOST_WATCHES> watches_{};
};

} // namespace rung::api

struct rung_watch {
  rung_watch(rung_instance& of, std::vector<rung_cell> watched, uint32_t depth);
  ~rung_watch(); // no other thread may use it

  // Scan thread.
  void take(const rung_instance& from, const rung::api::SampleHead& head) noexcept;
  // Any thread: read the newest or the next sample. RUNG_EMPTY: there is no sample yet, or none waits; RUNG_LATER: the
  // reader was interrupted repeatedly.
  int32_t newest(rung_value* values, rung_sample& sample) const noexcept;
  int32_t next(rung_value* values, rung_sample& sample) noexcept;

  bool keepsPasses() const noexcept { return depth_ != 0; }
  bool isNew() const noexcept { return newest_.empty(); }

  uint32_t mark = rung::api::kWatchMark;
  rung_instance& instance;
  std::vector<rung_cell> cells;

private:
  static constexpr size_t kHeadWords = 3;
  size_t words() const noexcept { return kHeadWords + cells.size(); }

  std::vector<uint64_t> scratch_; // scan thread: head and values of this scan
  rung::runtime::Latest newest_;
  // A ring of waiting samples, for one writer and one reader.
  uint32_t depth_;
  std::vector<uint64_t> kept_;
  rung::core::SlotRing ring_; // of `kept_`
  std::atomic<uint64_t> lost_{0};
};

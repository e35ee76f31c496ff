// Cells that other threads watch: at the end of a scan the scan thread stores samples of their values for these
// threads, without waiting.
#pragma once
#include <array>
#include <atomic>
#include <memory>
#include <mutex>
#include <vector>

#include "rtlib/api/error.h"
#include "rtlib/core/handover.h"

namespace rung::api {

// The header of a sample, before its values.
struct SampleHead {
  uint64_t generation = 0;
  uint64_t scan = 0;
  uint64_t nowUs = 0;
};

// The watches of an instance.
class Watches {
public:
  // Any thread. False: RUNG_MOST_WATCHES are in use.
  bool add(rung_watch& watch);
  void remove(rung_watch& watch); // on return the scan thread no longer uses it

  // Scan thread, at the end of a scan: samples every watch.
  void sample(const rung_instance& instance) noexcept {
    if (count_.load(std::memory_order_relaxed) != 0) sampleEach(instance, false);
  }
  // Scan thread: samples the watches that have no sample yet.
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
  ~rung_watch(); // no thread may use it any more

  // Scan thread: stores a sample.
  void take(const rung_instance& from, const rung::api::SampleHead& head) noexcept;
  // Any thread. `newest` returns the last sample, `next` the oldest queued one. RUNG_EMPTY: no sample yet, or none
  // queued; RUNG_LATER: the scan thread interrupted every attempt.
  int32_t newest(rung_value* values, rung_sample& sample) const noexcept;
  int32_t next(rung_value* values, rung_sample& sample) noexcept;

  bool keepsScans() const noexcept { return depth_ != 0; }
  bool isNew() const noexcept { return newest_.empty(); }

  uint32_t mark = rung::api::kWatchMark;
  rung_instance& instance;
  std::vector<rung_cell> cells;

private:
  static constexpr size_t kHeadWords = 3;
  size_t words() const noexcept { return kHeadWords + cells.size(); }

  std::vector<uint64_t> scratch_; // scan thread: head and values of this scan
  rung::core::Published newest_;
  // Queued samples, with one writer and one reader.
  uint32_t depth_;
  std::vector<uint64_t> kept_;
  rung::core::SlotRing ring_; // slots of `kept_`
  std::atomic<uint64_t> lost_{0};
};

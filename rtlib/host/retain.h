// The retained memory on disk. Two files, BASE.a and BASE.b, are written in turn; each has a generation number, the
// layout hash and a checksum, and is replaced as a whole (write, fsync, rename), so a crash at any moment leaves a good
// one.
#pragma once
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "rtlib/host/instance.h"
#include "rtlib/host/retain_map.h"

namespace rung::host {

struct RetainImage {
  bool found = false; // false: start cold
  std::vector<uint8_t> bytes;
  uint64_t generation = 0;
  std::string report; // what was wrong with the files, "" when nothing was; missing files are not wrong
};

// Blocks on the disk: not for the scan thread.
class RetainStore {
public:
  // `base` is a path without ending; bytes saved under another layout hash or size are not taken.
  RetainStore(std::string base, uint64_t layoutHash, uint32_t size);

  RetainImage load();
  bool save(std::span<const uint8_t> bytes, std::string& error);

private:
  std::string base_;
  uint64_t layoutHash_;
  uint32_t size_;
  uint64_t generation_ = 0; // of the newest good file
  bool newestIsB_ = true;
  bool looked_ = false; // generation_ and newestIsB_ are known
};

// Takes images from the scan thread and saves them on its own. `offer` copies and returns at once; it takes nothing
// while the last image is still being written. An image like the last one is not written again.
class RetainSaver {
public:
  // How the bytes that were copied in the scan become the image; runs on the saver's thread.
  using Pack = std::function<void(std::span<const uint8_t> raw, std::span<uint8_t> image)>;

  RetainSaver(RetainStore store, uint32_t rawSize, uint32_t imageSize, Pack pack,
              std::chrono::milliseconds poll = std::chrono::milliseconds(20));
  // For the retained memory of an instance.
  RetainSaver(RetainStore store, RetainMap map, std::chrono::milliseconds poll = std::chrono::milliseconds(20));
  ~RetainSaver(); // writes what was offered last
  RetainSaver(const RetainSaver&) = delete;
  RetainSaver& operator=(const RetainSaver&) = delete;

  // Scan thread. `copy` fills a span of rawSize bytes; it allocates nothing and does not throw.
  template <class Copy>
  bool offerFrom(Copy copy) noexcept {
    if (full_.load(std::memory_order_acquire)) return false;
    copy(std::span<uint8_t>(buffer_));
    full_.store(true, std::memory_order_release);
    return true;
  }
  // Instead of the last `offerFrom`; waits until it is written.
  template <class Copy>
  void finishFrom(Copy copy) {
    bool offered = offerFrom(copy);
    while (!offered || full_.load(std::memory_order_acquire)) {
      hurry();
      offered = offered || offerFrom(copy);
    }
  }
  bool offer(const Instance& instance) noexcept {
    return offerFrom([&](std::span<uint8_t> to) { instance.copyRetained(to); });
  }
  void finish(const Instance& instance) {
    finishFrom([&](std::span<uint8_t> to) { instance.copyRetained(to); });
  }
  // Scan thread: what was offered last is written, or could not be (see failed).
  bool idle() const noexcept { return !full_.load(std::memory_order_acquire); }
  uint64_t saved() const { return saved_.load(); }
  uint64_t failed() const { return failed_.load(); }
  std::string lastError() const;

private:
  void work();
  void saveOffered();
  void hurry(); // a moment's wait while the saver works

  RetainStore store_;
  Pack pack_;
  std::vector<uint8_t> buffer_; // as it was copied in the scan
  std::vector<uint8_t> image_;  // of buffer_
  std::vector<uint8_t> onDisk_;
  std::atomic<bool> full_{false}; // true: buffer_ belongs to the saver, else to the scan thread
  std::atomic<uint64_t> saved_{0};
  std::atomic<uint64_t> failed_{0};
  std::chrono::milliseconds poll_;
  mutable std::mutex mutex_;
  std::condition_variable wake_;
  bool stop_ = false;     // under mutex_
  bool hurry_ = false;    // under mutex_
  std::string lastError_; // under mutex_
  std::thread thread_;
};

} // namespace rung::host

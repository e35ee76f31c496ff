// Retained memory on disk. Two files, BASE.a and BASE.b, are written in turn. Each has a generation number, its layout
// and a checksum, and is replaced as a whole (write, fsync, rename), so a crash at any moment leaves a good one.
// BASE.lock keeps other processes out.
#pragma once
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "rtlib/core/handover.h"
#include "rtlib/load/file.h"
#include "rtlib/retain/retained_cells.h"
#include "rtlib/run/instance.h"

namespace rung::runtime {

struct RetainImage {
  bool found = false;      // false: start cold
  std::string description; // of an image with another layout, which was found instead: `bytes` are its contents
  std::vector<uint8_t> bytes;
  uint64_t generation = 0;
  std::string report; // what was wrong with the files; "": nothing, or this is the first start
};

// A place that stores images. Its functions block, so the scan thread must not call them.
class RetainTarget {
public:
  virtual ~RetainTarget() = default;
  // Stores the image of a program with this layout. True: it is stored permanently. False: `error` says what was not
  // written and why.
  virtual bool save(std::span<const uint8_t> bytes, const RetainLayout& layout, std::string& error) = 0;
};

class RetainStore final : public RetainTarget {
public:
  // `base` is the path of the files without .a and .b. Bytes saved under another layout or size are not `found`. The
  // disk outlives the store.
  RetainStore(std::string base, RetainLayout layout, uint32_t size, Disk& disk = systemDisk());

  // Locks the files, in all processes, until this store ends. A caller that loads in order to save later locks first;
  // `save` locks, too. False: `error` says why.
  bool lock(std::string& error);
  RetainImage load();
  bool save(std::span<const uint8_t> bytes, std::string& error) { return save(bytes, layout_, error); }
  bool save(std::span<const uint8_t> bytes, const RetainLayout& layout, std::string& error) override;

private:
  std::string base_;
  RetainLayout layout_;
  uint32_t size_;
  Disk* disk_;
  std::unique_ptr<Disk::Lock> lock_;
  bool usedBefore_ = false; // the lock was there: so were images
  uint64_t generation_ = 0; // of the newest good file
  bool newestIsB_ = true;
  bool looked_ = false; // generation_ and newestIsB_ are known
};

// What the scan thread copies for the saver thread, for one program: the bytes, and how they become an image.
class RetainChannel {
public:
  // Converts the bytes that the scan thread copied into the image. Saver thread.
  using Pack = std::function<void(std::span<const uint8_t> raw, std::span<uint8_t> image)>;

  RetainChannel(RetainLayout layout, uint32_t rawSize, uint32_t imageSize, Pack pack);
  // For the retained memory of an instance.
  explicit RetainChannel(const RetainMap& map);

private:
  friend class RetainSaver;
  // Discards what was offered to another saver.
  void enter(int64_t saver) noexcept;

  static constexpr uint32_t kFresh = 4; // in `shared_`: the saver has not taken this offer yet
  struct Offer {
    std::vector<uint8_t> raw;
    uint64_t ticket = 0; // 0: nothing was offered
  };

  RetainLayout layout_;
  uint32_t imageSize_;
  Pack pack_;
  // Triple buffer: one offer belongs to the scan thread, one to the saver, and the third is exchanged between them.
  std::array<Offer, 3> offers_;
  uint64_t newest_ = 0; // ticket of the last offer; scan thread
  uint32_t back_ = 0;   // scan thread
  uint32_t front_ = 1;  // saver thread
  std::atomic<uint32_t> shared_{2};
  int64_t saver_ = 0; // RetainSaver::begun_
};

// Saves, on a thread of its own, the images that the scan thread offers. `offer` copies and returns at once, whatever
// the saver is doing. Of several offered images only the newest is saved, whichever program it is of; an image equal to
// the last one is not written again. An image that could not be saved is retried until it is on disk or a newer one is
// offered.
class RetainSaver {
public:
  // Checks for images once per `period`, because waking the saver would cost the scan thread a system call. 0: there is
  // no thread; the caller checks by `look`.
  RetainSaver(std::unique_ptr<RetainTarget> target, std::unique_ptr<RetainChannel> channel,
              std::chrono::milliseconds period);
  ~RetainSaver(); // tries to save what was offered last
  RetainSaver(const RetainSaver&) = delete;
  RetainSaver& operator=(const RetainSaver&) = delete;

  // Scan thread. `copy` fills a span of rawSize bytes; it must not allocate or throw. The result is the image's ticket;
  // tickets ascend from 1.
  template <class Copy>
  uint64_t offerFrom(Copy copy) noexcept {
    RetainChannel::Offer& offer = channel_->offers_.back();
    copy(std::span<uint8_t>(offer.raw));
    offer.ticket = channel_->newest_ = ++lastTicket_;
    channel_->offers_.publish();
    return lastTicket_;
  }
  uint64_t offer(const Instance& instance) noexcept {
    return offerFrom([&](std::span<uint8_t> to) { instance.copyRetained(to); });
  }
  // Scan thread. Whether the saver has taken the last offer, so that another copy is useful.
  bool taken() const noexcept {
    return (channel_->shared_.load(std::memory_order_acquire) & RetainChannel::kFresh) == 0;
  }
  // Scan thread, after another program has taken over: later offers use its channel. The last offer of a former program
  // is still saved, unless there is a newer one. `channel` receives the former channel, which must exist until `settle`
  // has returned.
  void swapChannel(std::unique_ptr<RetainChannel>& channel) noexcept {
    channel->enter(begun_);
    if (channel_->newest_ > formerNewest_) {
      formerNewest_ = channel_->newest_;
      former_.store(channel_.get(), std::memory_order_release);
    }
    channel_.swap(channel);
    current_.store(channel_.get(), std::memory_order_release);
  }

  // Any thread, without a lock.
  uint64_t stored() const noexcept { return stored_.load(std::memory_order_acquire); } // ticket of the newest on disk
  bool failing() const noexcept { return failing_.load(std::memory_order_acquire); }   // the last attempt failed
  uint64_t saved() const noexcept { return saved_.load(std::memory_order_relaxed); }   // images written
  uint64_t failed() const noexcept { return failed_.load(std::memory_order_relaxed); } // failed attempts
  // The reason of the last failure. The result is the number of characters; 0 while the text changes.
  size_t problem(std::span<char> to) const noexcept { return problem_.read(to); }

  // Any thread, but not in a scan. Saves the last offer if it is not on disk.
  void look() noexcept;
  // Any thread, but not in a scan. Afterwards the saver no longer uses the former channel.
  void settle() noexcept;
  // Any thread, but not in a scan. Like `look`; true: the last offer is on disk.
  bool flush() noexcept {
    look();
    return !failing();
  }
  // Simulates a power failure: nothing is saved any more.
  void abandon() noexcept;
  std::string problem() const;

private:
  struct Image { // the image that is to be written
    uint64_t ticket = 0;
    RetainLayout layout{0};
    std::vector<uint8_t> bytes;
  };
  void work();
  void takeOffered();
  void take(RetainChannel& channel);
  bool save(std::string& error);

  std::unique_ptr<RetainTarget> target_;
  int64_t begun_;                          // in ns; unique among the savers of the process
  std::unique_ptr<RetainChannel> channel_; // scan thread
  std::atomic<RetainChannel*> former_{
      nullptr}; // for the saver: one of before with the newest offer, and the present one
  std::atomic<RetainChannel*> current_;
  uint64_t lastTicket_ = 0, formerNewest_ = 0; // the scan thread's
  std::mutex looking_;                         // held by `look` and `settle`
  Image pending_;
  std::vector<uint8_t> onDisk_; // if it is known
  uint64_t onDiskLayout_ = 0;
  bool onDiskKnown_ = false;
  bool abandoned_ = false; // under looking_
  std::atomic<uint64_t> stored_{0};
  std::atomic<uint64_t> saved_{0};
  std::atomic<uint64_t> failed_{0};
  std::atomic<bool> failing_{false};
  core::PublishedText problem_;
  std::chrono::milliseconds period_;
  std::mutex mutex_;
  std::condition_variable wake_;
  bool stop_ = false; // under mutex_
  std::thread thread_;
};

} // namespace rung::runtime

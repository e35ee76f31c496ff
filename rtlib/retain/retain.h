// The retained memory on disk. Two files, BASE.a and BASE.b, are written in turn; each has a generation number, its
// layout and a checksum, and is replaced as a whole (write, fsync, rename), so a crash at any moment leaves a good one.
// BASE.lock excludes other processes.
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
  std::string description; // not found, but an image of another layout: its description; `bytes` is that image
  std::vector<uint8_t> bytes;
  uint64_t generation = 0;
  std::string report; // errors of the files; "": none, or the first start
};

// The storage of images. Blocks: not for the scan thread.
class RetainTarget {
public:
  virtual ~RetainTarget() = default;
  // Stores the image of a program with this layout. True: it is stored durably. False: `error` says what was not
  // written and why.
  virtual bool save(std::span<const uint8_t> bytes, const RetainLayout& layout, std::string& error) = 0;
};

class RetainStore final : public RetainTarget {
public:
  // `base` is a path without extension; an image of another layout or size is not `found`. The disk outlives this
  // object.
  RetainStore(std::string base, RetainLayout layout, uint32_t size, Disk& disk = systemDisk());

  // Locks the files until this store ends, so that no other store of any process saves here. A caller that loads in
  // order to save later must lock first; `save` locks, too. False: `error` says why.
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
  bool usedBefore_ = false; // the lock file existed, so images did
  uint64_t generation_ = 0; // of the newest good file
  bool newestIsB_ = true;
  bool looked_ = false; // generation_ and newestIsB_ are known
};

// The channel from the scan thread to the saver for one program: the copied bytes, and their conversion to an image.
class RetainChannel {
public:
  // Converts the bytes copied in the scan to the image; runs on the saver's thread.
  using Pack = std::function<void(std::span<const uint8_t> raw, std::span<uint8_t> image)>;

  RetainChannel(RetainLayout layout, uint32_t rawSize, uint32_t imageSize, Pack pack);
  // For the retained memory of an instance.
  explicit RetainChannel(const RetainMap& map);

private:
  friend class RetainSaver;
  // Forgets offers to another saver.
  void enter(int64_t saver) noexcept;

  struct Offer {
    std::vector<uint8_t> raw;
    uint64_t ticket = 0; // 0: no offer yet
  };

  RetainLayout layout_;
  uint32_t imageSize_;
  Pack pack_;
  core::Newest<Offer> offers_;
  uint64_t newest_ = 0; // ticket of the last offer; scan thread
  int64_t saver_ = 0;   // RetainSaver::begun_
};

// Takes images from the scan thread and saves them on a thread of its own. `offer` copies and returns at once, whatever
// the saver is doing; of several images the newest is saved, whichever program it belongs to. An image equal to the
// last one is not written again. An image that could not be saved is kept, and tried again until it is on disk or a
// newer one arrives.
class RetainSaver {
public:
  // The thread looks for images once per `period`, because waking it would cost the scan thread a system call. 0: there
  // is no thread, and only `look` looks.
  RetainSaver(std::unique_ptr<RetainTarget> target, std::unique_ptr<RetainChannel> channel,
              std::chrono::milliseconds period);
  ~RetainSaver(); // tries to save the last offer
  RetainSaver(const RetainSaver&) = delete;
  RetainSaver& operator=(const RetainSaver&) = delete;

  // Scan thread. `copy` fills a span of rawSize bytes; it must not allocate or throw. Returns the image's ticket;
  // tickets increase from 1.
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
  // Scan thread: whether the saver has taken the last offer, so that a further copy is useful.
  bool taken() const noexcept { return channel_->offers_.taken(); }
  // Scan thread: another program has taken over, and further offers go through its channel. The last offer of a former
  // program is still saved, unless there is a newer one. `channel` receives the former channel, which must exist until
  // `settle` has returned.
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
  // Why the last failed attempt failed. Returns the number of characters; 0 while the text changes.
  size_t problem(std::span<char> to) const noexcept { return problem_.read(to); }

  // Any thread, not in a scan. Saves the last offer, if it is not on disk.
  void look() noexcept;
  // Any thread, not in a scan. On return the saver no longer uses the former channel.
  void settle() noexcept;
  // As `look`. True: the last offer is on disk.
  bool flush() noexcept {
    look();
    return !failing();
  }
  // The power has failed: nothing more is saved.
  void abandon() noexcept;
  std::string problem() const;

private:
  struct Image { // the image to be saved
    uint64_t ticket = 0;
    RetainLayout layout{0};
    std::vector<uint8_t> bytes;
  };
  void work();
  void takeOffered();
  void take(RetainChannel& channel);
  bool save(std::string& error);

  std::unique_ptr<RetainTarget> target_;
  int64_t begun_;                          // start time in ns; unique among the savers of the process
  std::unique_ptr<RetainChannel> channel_; // scan thread
  std::atomic<RetainChannel*> former_{
      nullptr}; // for the saver: the former channel with the newest offer; current_: the present one
  std::atomic<RetainChannel*> current_;
  uint64_t lastTicket_ = 0, formerNewest_ = 0; // scan thread
  std::mutex looking_;                         // held while a thread looks for images
  Image pending_;
  std::vector<uint8_t> onDisk_; // the image on disk, if known
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

// The retained memory on disk. Two files, BASE.a and BASE.b, are written in turn; each has a generation number, its
// layout and a checksum, and is replaced as a whole (write, fsync, rename), so a crash at any moment leaves a good
// one. BASE.lock keeps a second process out.
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
  std::string description; // not found, but an image of another layout, which has this: `bytes` are its
  std::vector<uint8_t> bytes;
  uint64_t generation = 0;
  std::string report; // what was wrong with the files, "" when nothing was; nor is a first start
};

// Where images are kept. Blocks: not for the scan thread.
class RetainTarget {
public:
  virtual ~RetainTarget() = default;
  // True: the image, of a program with this layout, is kept, whatever happens now. False: `error` says what was not
  // written and why.
  virtual bool save(std::span<const uint8_t> bytes, const RetainLayout& layout, std::string& error) = 0;
};

class RetainStore final : public RetainTarget {
public:
  // `base` is a path without ending; bytes saved under another layout or size are not `found`. The disk outlives it.
  RetainStore(std::string base, RetainLayout layout, uint32_t size, Disk& disk = systemDisk());

  // From now until this store ends no other store saves here, in any process. A caller that loads in order to save
  // later locks first; `save` does it too. False: `error` says why.
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

// What the scan thread copies for the saver, of one program: its bytes, and how they become an image.
class RetainChannel {
public:
  // How the bytes that were copied in the scan become the image; runs on the saver's thread.
  using Pack = std::function<void(std::span<const uint8_t> raw, std::span<uint8_t> image)>;

  RetainChannel(RetainLayout layout, uint32_t rawSize, uint32_t imageSize, Pack pack);
  // Of the retained memory of an instance.
  explicit RetainChannel(const RetainMap& map);

private:
  friend class RetainSaver;
  // Forgets what was offered to another saver.
  void enter(int64_t saver) noexcept;

  struct Offer {
    std::vector<uint8_t> raw;
    uint64_t ticket = 0; // 0: nothing was offered
  };

  RetainLayout layout_;
  uint32_t imageSize_;
  Pack pack_;
  core::Newest<Offer> offers_;
  uint64_t newest_ = 0; // ticket of the last offer; the scan thread's
  int64_t saver_ = 0;   // RetainSaver::begun_
};

// Takes images from the scan thread and saves them on its own. `offer` copies and returns at once, whatever the saver
// is doing; of several images the newest is saved, of whichever program it is. An image like the last one is not
// written again. One that could not be saved is kept, and tried again until it is on disk or a newer one comes.
class RetainSaver {
public:
  // Looks for images once a `period`, because waking it would cost the scan thread a system call. 0: it has no thread,
  // and looks where that is asked for.
  RetainSaver(std::unique_ptr<RetainTarget> target, std::unique_ptr<RetainChannel> channel,
              std::chrono::milliseconds period);
  ~RetainSaver(); // tries to save what was offered last
  RetainSaver(const RetainSaver&) = delete;
  RetainSaver& operator=(const RetainSaver&) = delete;

  // Scan thread. `copy` fills a span of rawSize bytes; it allocates nothing and does not throw. The image's ticket:
  // they grow from 1.
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
  // The saver has seen what was offered last: a copy is worth its time again.
  bool taken() const noexcept { return channel_->offers_.taken(); }
  // Another program has taken over: what is offered from now on goes through its channel. What was offered last, of
  // whichever program of before, is saved all the same, until there is something newer. `channel` gets the former
  // channel; it must not end before `settle` has returned.
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
  bool failing() const noexcept { return failing_.load(std::memory_order_acquire); }   // the last try went wrong
  uint64_t saved() const noexcept { return saved_.load(std::memory_order_relaxed); }   // images written
  uint64_t failed() const noexcept { return failed_.load(std::memory_order_relaxed); } // tries that went wrong
  // Why the last failed try failed; the number of characters, 0 while it changes.
  size_t problem(std::span<char> to) const noexcept { return problem_.read(to); }

  // Not in a scan, any thread. Saves what was offered last, where that is not on disk.
  void look() noexcept;
  // The saver has all that it needs of the channel of before, and uses it no more.
  void settle() noexcept;
  // As `look`. True: what was offered last is on disk.
  bool flush() noexcept {
    look();
    return !failing();
  }
  // The power is gone: nothing more is saved.
  void abandon() noexcept;
  std::string problem() const;

private:
  struct Image { // that is to be on disk
    uint64_t ticket = 0;
    RetainLayout layout{0};
    std::vector<uint8_t> bytes;
  };
  void work();
  void takeOffered();
  void take(RetainChannel& channel);
  bool save(std::string& error);

  std::unique_ptr<RetainTarget> target_;
  int64_t begun_;                          // in ns: no other saver of the process has the same
  std::unique_ptr<RetainChannel> channel_; // the scan thread's
  std::atomic<RetainChannel*> former_{
      nullptr}; // for the saver: one of before with the newest offer, and the present one
  std::atomic<RetainChannel*> current_;
  uint64_t lastTicket_ = 0, formerNewest_ = 0; // the scan thread's
  std::mutex looking_;                         // held while a thread looks
  Image pending_;
  std::vector<uint8_t> onDisk_; // where it is known
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

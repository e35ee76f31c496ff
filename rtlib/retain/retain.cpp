// The file of a retained image, all numbers little-endian:
//   0 magic "RUNGRET1" · 8 layout hash · 16 generation · 24 size of the image · 28 CRC-32 of all but these
//   four bytes · 32 image, and after it the description of its layout
#include "rtlib/retain/retain.h"

#include <fcntl.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <exception>
#include <utility>

#include "rtlib/run/realtime.h"

namespace rung::runtime {

namespace {

constexpr char kMagic[] = "RUNGRET1";
constexpr size_t kHeaderSize = 32;
constexpr size_t kCrcAt = 28;
constexpr uint64_t kNoGeneration = ~uint64_t{0}; // an invalid number, because none could follow it
constexpr size_t kMostBytes = 64 << 20;          // more than any image has
constexpr int kRetryPeriods = 10;                // between attempts after a failure

void put(std::vector<uint8_t>& to, size_t at, uint64_t value, size_t size) {
  for (size_t i = 0; i < size; ++i) to[at + i] = static_cast<uint8_t>(value >> (8 * i));
}

uint64_t get(std::span<const uint8_t> from, size_t at, size_t size) {
  uint64_t value = 0;
  for (size_t i = 0; i < size; ++i) value |= uint64_t{from[at + i]} << (8 * i);
  return value;
}

uint32_t checksum(std::span<const uint8_t> file) {
  const std::span<const uint8_t> contents = file.subspan(kHeaderSize);
  return static_cast<uint32_t>(crc32_z(crc32_z(0, file.data(), kCrcAt), contents.data(), contents.size()));
}

// The contents of one of the two files.
struct Found {
  bool good = false; // whole and intact
  uint64_t layoutHash = 0;
  uint64_t generation = 0;
  std::vector<uint8_t> image;
  std::string description;
  std::string wrong;
};

Found look(Disk& disk, const std::string& path) {
  Found found;
  std::string bytes, problem;
  if (!disk.read(path, kMostBytes, bytes, problem)) return found;
  if (!problem.empty()) {
    found.wrong = path + ": " + problem;
    return found;
  }
  const std::span file(reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size());
  if (file.size() < kHeaderSize) {
    found.wrong = path + ": too short";
  } else if (std::memcmp(file.data(), kMagic, 8) != 0) {
    found.wrong = path + ": not a retained image";
  } else if (get(file, 24, 4) > file.size() - kHeaderSize) {
    found.wrong = path + ": wrong length";
  } else if (get(file, kCrcAt, 4) != checksum(file)) {
    found.wrong = path + ": wrong checksum";
  } else if (get(file, 16, 8) == kNoGeneration) {
    found.wrong = path + ": wrong generation";
  } else {
    found.good = true;
    found.layoutHash = get(file, 8, 8);
    found.generation = get(file, 16, 8);
    const size_t end = kHeaderSize + get(file, 24, 4);
    found.image.assign(file.begin() + kHeaderSize, file.begin() + static_cast<ptrdiff_t>(end));
    found.description = bytes.substr(end);
  }
  return found;
}

} // namespace

RetainStore::RetainStore(std::string base, RetainLayout layout, uint32_t size, Disk& disk)
    : base_(std::move(base)), layout_(std::move(layout)), size_(size), disk_(&disk) {}

bool RetainStore::lock(std::string& error) {
  if (lock_ != nullptr) return true;
  bool made = false;
  std::string problem;
  std::unique_ptr<Disk::Lock> lock = disk_->lock(base_ + ".lock", made, problem);
  if (lock == nullptr) {
    error = !problem.empty() ? problem
                             : base_ + " is in use by another process, which holds " + base_ +
                                   ".lock: stop that one, or give each program a file of its own";
    return false;
  }
  lock_ = std::move(lock);
  usedBefore_ = !made;
  looked_ = false; // another process may have saved until now
  return true;
}

RetainImage RetainStore::load() {
  Found a = look(*disk_, base_ + ".a");
  Found b = look(*disk_, base_ + ".b");
  RetainImage image;
  image.report = a.wrong + (a.wrong.empty() || b.wrong.empty() ? "" : "; ") + b.wrong;
  looked_ = true;
  newestIsB_ = !a.good || (b.good && b.generation > a.generation);
  Found& newest = newestIsB_ ? b : a;
  if (!newest.good) {
    if (image.report.empty() && usedBefore_) image.report = base_ + ".a and .b are gone";
    if (!image.report.empty()) image.report += "; starting cold";
    return image;
  }
  generation_ = newest.generation;
  // An older image of this layout is not taken, because it misses all changes by the other program.
  if (newest.layoutHash != layout_.hash || newest.image.size() != size_) {
    image.report += (image.report.empty() ? "" : "; ") + base_ + (newestIsB_ ? ".b" : ".a") +
                    ": made by a program with other retained cells";
    image.description = std::move(newest.description);
    if (image.description.empty())
      image.report += "; starting cold";
    else
      image.bytes = std::move(newest.image);
    return image;
  }
  if (!image.report.empty()) image.report += "; using the other image, generation " + std::to_string(generation_);
  image.found = true;
  image.generation = generation_;
  image.bytes = std::move(newest.image);
  return image;
}

bool RetainStore::save(std::span<const uint8_t> bytes, const RetainLayout& layout, std::string& error) {
  if (layout.hash == layout_.hash && bytes.size() != size_) {
    error = "the retained image has the wrong size";
    return false;
  }
  if (!lock(error)) return false;
  if (!looked_) load(); // the generation must be above those on disk
  std::vector<uint8_t> file(kHeaderSize + bytes.size() + layout.description.size());
  std::memcpy(file.data(), kMagic, 8);
  put(file, 8, layout.hash, 8);
  put(file, 16, generation_ + 1, 8);
  put(file, 24, bytes.size(), 4);
  std::copy_n(bytes.data(), bytes.size(), file.data() + kHeaderSize);
  std::copy_n(layout.description.data(), layout.description.size(), file.data() + kHeaderSize + bytes.size());
  put(file, kCrcAt, checksum(file), 4);
  if (!disk_->replace(base_ + (newestIsB_ ? ".a" : ".b"), file, error)) return false;
  ++generation_;
  newestIsB_ = !newestIsB_;
  return true;
}

// ---- saver -------------------------------------------------------------------------------------------------------

RetainChannel::RetainChannel(RetainLayout layout, uint32_t rawSize, uint32_t imageSize, Pack pack)
    : layout_(std::move(layout)), imageSize_(imageSize), pack_(std::move(pack)),
      offers_({.raw = std::vector<uint8_t>(rawSize)}) {}

RetainChannel::RetainChannel(const RetainMap& map)
    : RetainChannel(map.layout(), map.rawSize(), map.size(),
                    [map](std::span<const uint8_t> raw, std::span<uint8_t> image) { map.pack(raw, image); }) {}

void RetainChannel::enter(int64_t saver) noexcept {
  if (saver_ == saver) return;
  saver_ = saver;
  newest_ = 0;
  for (Offer& offer : offers_.values()) offer.ticket = 0;
}

RetainSaver::RetainSaver(std::unique_ptr<RetainTarget> target, std::unique_ptr<RetainChannel> channel,
                         std::chrono::milliseconds period)
    : target_(std::move(target)), begun_(monotonicNs()), channel_(std::move(channel)), current_(channel_.get()),
      period_(period) {
  channel_->enter(begun_);
  if (period.count() != 0) thread_ = std::thread([this] { work(); });
}

RetainSaver::~RetainSaver() {
  if (thread_.joinable()) {
    {
      const std::lock_guard lock(mutex_);
      stop_ = true;
    }
    wake_.notify_one();
    thread_.join();
  }
  look();
}

std::string RetainSaver::problem() const {
  std::array<char, core::PublishedText::kMost> text{};
  return {text.data(), problem(text)};
}

void RetainSaver::take(RetainChannel& channel) {
  channel.offers_.take();
  const RetainChannel::Offer& offer = channel.offers_.front();
  if (offer.ticket <= pending_.ticket) return;
  if (pending_.layout.hash != channel.layout_.hash) pending_.layout = channel.layout_;
  pending_.bytes.assign(channel.imageSize_, 0);
  channel.pack_(offer.raw, pending_.bytes);
  pending_.ticket = offer.ticket;
}

// The present channel is loaded first: if another program takes over meanwhile, that channel becomes the former one.
void RetainSaver::takeOffered() {
  RetainChannel& current = *current_.load(std::memory_order_acquire);
  RetainChannel* former = former_.load(std::memory_order_acquire);
  if (former != nullptr) take(*former);
  take(current);
}

// A failed save may have replaced the file nevertheless, so the contents on disk are unknown then.
bool RetainSaver::save(std::string& error) {
  if (onDiskKnown_ && onDiskLayout_ == pending_.layout.hash && pending_.bytes == onDisk_) return true;
  onDiskKnown_ = false;
  if (!target_->save(pending_.bytes, pending_.layout, error)) return false;
  onDisk_ = pending_.bytes;
  onDiskLayout_ = pending_.layout.hash;
  onDiskKnown_ = true;
  saved_.fetch_add(1, std::memory_order_relaxed);
  return true;
}

void RetainSaver::look() noexcept {
  const std::lock_guard lock(looking_);
  if (abandoned_) return;
  bool good = false;
  try {
    takeOffered();
    if (pending_.ticket <= stored()) return;
    std::string error;
    good = save(error);
    if (!good) problem_.set(error);
  } catch (const std::exception& thrown) { // out of memory
    problem_.set(thrown.what());
  }
  if (good)
    stored_.store(pending_.ticket, std::memory_order_release);
  else
    failed_.fetch_add(1, std::memory_order_relaxed);
  failing_.store(!good, std::memory_order_release);
}

void RetainSaver::settle() noexcept {
  const std::lock_guard lock(looking_);
  RetainChannel* former = former_.load(std::memory_order_acquire);
  try {
    takeOffered();
  } catch (const std::exception& thrown) { // out of memory: the last offer is lost
    problem_.set(thrown.what());
    failing_.store(true, std::memory_order_release);
  }
  former_.compare_exchange_strong(former, nullptr); // another channel may have become the former one meanwhile
}

void RetainSaver::abandon() noexcept {
  const std::lock_guard lock(looking_);
  abandoned_ = true;
}

void RetainSaver::work() {
  becomeHelper();
  for (bool stop = false; !stop;) {
    {
      std::unique_lock lock(mutex_);
      stop = wake_.wait_for(lock, failing() ? period_ * kRetryPeriods : period_, [this] { return stop_; });
    }
    look();
  }
}

} // namespace rung::runtime

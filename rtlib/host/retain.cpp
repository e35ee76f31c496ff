// The file of a retained image, all numbers little-endian:
//   0 magic "RUNGRET1" · 8 layout hash · 16 generation · 24 size · 28 CRC-32 of bytes 0..27 and of the contents · 32
//   contents
#include "rtlib/host/retain.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <optional>
#include <utility>

namespace rung::host {

namespace {

constexpr char kMagic[] = "RUNGRET1";
constexpr size_t kHeaderSize = 32;
constexpr size_t kCrcAt = 28;

constexpr std::array<uint32_t, 256> kCrcTable = [] {
  std::array<uint32_t, 256> table{};
  for (uint32_t i = 0; i < 256; ++i) {
    uint32_t c = i;
    for (int k = 0; k < 8; ++k) c = (c & 1) != 0 ? 0xEDB88320u ^ (c >> 1) : c >> 1;
    table[i] = c;
  }
  return table;
}();

uint32_t crc(std::span<const uint8_t> bytes, uint32_t state) {
  for (const uint8_t b : bytes) state = kCrcTable[(state ^ b) & 0xFF] ^ (state >> 8);
  return state;
}

void put(std::vector<uint8_t>& to, size_t at, uint64_t value, size_t size) {
  for (size_t i = 0; i < size; ++i) to[at + i] = static_cast<uint8_t>(value >> (8 * i));
}

uint64_t get(std::span<const uint8_t> from, size_t at, size_t size) {
  uint64_t value = 0;
  for (size_t i = 0; i < size; ++i) value |= uint64_t{from[at + i]} << (8 * i);
  return value;
}

uint32_t checksum(std::span<const uint8_t> file) {
  return ~crc(file.subspan(kHeaderSize), crc(file.first(kCrcAt), 0xFFFFFFFFu));
}

// An open file that closes itself.
class File {
public:
  File(const std::string& path, int flags) : fd_(::open(path.c_str(), flags | O_CLOEXEC, 0644)) {}
  ~File() { close(); }
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  int fd() const { return fd_; }
  bool close() {
    const int fd = std::exchange(fd_, -1);
    return fd < 0 || ::close(fd) == 0;
  }

private:
  int fd_;
};

bool writeAll(int fd, std::span<const uint8_t> bytes) {
  while (!bytes.empty()) {
    const ssize_t n = ::write(fd, bytes.data(), bytes.size());
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    bytes = bytes.subspan(static_cast<size_t>(n));
  }
  return true;
}

// Nothing, with errno, when the file cannot be read; cut when it is longer than any image.
std::optional<std::vector<uint8_t>> readFile(const std::string& path) {
  constexpr off_t kMostBytes = 64 << 20;
  const File file(path, O_RDONLY);
  struct stat status{};
  if (file.fd() < 0 || ::fstat(file.fd(), &status) != 0) return std::nullopt;
  std::vector<uint8_t> bytes(static_cast<size_t>(std::min(status.st_size, kMostBytes)));
  size_t have = 0;
  while (have < bytes.size()) {
    const ssize_t n = ::read(file.fd(), bytes.data() + have, bytes.size() - have);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) break;
    have += static_cast<size_t>(n);
  }
  bytes.resize(have);
  return bytes;
}

std::string folderOf(const std::string& path) {
  const size_t slash = path.rfind('/');
  if (slash == std::string::npos) return ".";
  return slash == 0 ? "/" : path.substr(0, slash);
}

bool replaceFile(const std::string& path, std::span<const uint8_t> bytes, std::string& error) {
  const std::string temporary = path + ".tmp";
  File file(temporary, O_WRONLY | O_CREAT | O_TRUNC);
  const bool written = file.fd() >= 0 && writeAll(file.fd(), bytes) && ::fsync(file.fd()) == 0 && file.close();
  if (!written || std::rename(temporary.c_str(), path.c_str()) != 0) {
    error = "cannot write " + path + ": " + std::strerror(errno);
    return false;
  }
  const File folder(folderOf(path), O_RDONLY | O_DIRECTORY);
  if (folder.fd() >= 0)
    ::fsync(folder.fd()); // makes the rename last; some file systems refuse, the file is whole anyway
  return true;
}

// One of the two files, as found.
struct Found {
  bool there = false;
  bool good = false; // whole and intact
  uint64_t layoutHash = 0;
  uint64_t generation = 0;
  std::vector<uint8_t> contents;
  std::string wrong;
};

Found look(const std::string& path) {
  Found found;
  const std::optional<std::vector<uint8_t>> bytes = readFile(path);
  if (!bytes) {
    if (errno != ENOENT) found.wrong = path + ": " + std::strerror(errno);
    return found;
  }
  found.there = true;
  const std::span<const uint8_t> file = *bytes;
  if (file.size() < kHeaderSize) {
    found.wrong = path + ": too short";
  } else if (std::memcmp(file.data(), kMagic, 8) != 0) {
    found.wrong = path + ": no retained image";
  } else if (get(file, 24, 4) != file.size() - kHeaderSize) {
    found.wrong = path + ": wrong length";
  } else if (get(file, kCrcAt, 4) != checksum(file)) {
    found.wrong = path + ": wrong checksum";
  } else {
    found.good = true;
    found.layoutHash = get(file, 8, 8);
    found.generation = get(file, 16, 8);
    found.contents.assign(file.begin() + kHeaderSize, file.end());
  }
  return found;
}

} // namespace

RetainStore::RetainStore(std::string base, uint64_t layoutHash, uint32_t size)
    : base_(std::move(base)), layoutHash_(layoutHash), size_(size) {}

RetainImage RetainStore::load() {
  Found a = look(base_ + ".a");
  Found b = look(base_ + ".b");
  RetainImage image;
  image.report = a.wrong + (a.wrong.empty() || b.wrong.empty() ? "" : "; ") + b.wrong;
  looked_ = true;
  newestIsB_ = !a.good || (b.good && b.generation > a.generation);
  Found& newest = newestIsB_ ? b : a;
  if (!newest.good) {
    if (!image.report.empty()) image.report += "; starting cold";
    return image;
  }
  generation_ = newest.generation;
  // An older image of this layout would be out of date by everything that the other program did: not taken.
  if (newest.layoutHash != layoutHash_ || newest.contents.size() != size_) {
    image.report += (image.report.empty() ? "" : "; ") + base_ + (newestIsB_ ? ".b" : ".a") +
                    ": made by a program with another memory layout; starting cold";
    return image;
  }
  if (!image.report.empty()) image.report += "; using the other image, generation " + std::to_string(generation_);
  image.found = true;
  image.generation = generation_;
  image.bytes = std::move(newest.contents);
  return image;
}

bool RetainStore::save(std::span<const uint8_t> bytes, std::string& error) {
  if (bytes.size() != size_) {
    error = "the retained image has the wrong size";
    return false;
  }
  if (!looked_) load(); // the generation must be above those on disk
  std::vector<uint8_t> file(kHeaderSize + bytes.size());
  std::memcpy(file.data(), kMagic, 8);
  put(file, 8, layoutHash_, 8);
  put(file, 16, generation_ + 1, 8);
  put(file, 24, bytes.size(), 4);
  if (!bytes.empty()) std::memcpy(file.data() + kHeaderSize, bytes.data(), bytes.size());
  put(file, kCrcAt, checksum(file), 4);
  if (!replaceFile(base_ + (newestIsB_ ? ".a" : ".b"), file, error)) return false;
  ++generation_;
  newestIsB_ = !newestIsB_;
  return true;
}

RetainSaver::RetainSaver(RetainStore store, uint32_t rawSize, uint32_t imageSize, Pack pack,
                         std::chrono::milliseconds poll)
    : store_(std::move(store)), pack_(std::move(pack)), buffer_(rawSize), image_(imageSize), poll_(poll),
      thread_([this] { work(); }) {}

RetainSaver::RetainSaver(RetainStore store, RetainMap map, std::chrono::milliseconds poll)
    : RetainSaver(
          std::move(store), map.rawSize(), map.size(),
          [map](std::span<const uint8_t> raw, std::span<uint8_t> image) { map.pack(raw, image); }, poll) {}

RetainSaver::~RetainSaver() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  wake_.notify_one();
  thread_.join();
}

void RetainSaver::hurry() {
  {
    const std::lock_guard lock(mutex_);
    hurry_ = true;
  }
  wake_.notify_one();
  std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

std::string RetainSaver::lastError() const {
  const std::lock_guard lock(mutex_);
  return lastError_;
}

void RetainSaver::saveOffered() {
  if (!full_.load(std::memory_order_acquire)) return;
  pack_(buffer_, image_);
  std::string error;
  const bool good = image_ == onDisk_ || store_.save(image_, error);
  if (good && image_ != onDisk_) saved_.fetch_add(1);
  if (good) onDisk_ = image_;
  full_.store(false, std::memory_order_release);
  if (good) return;
  failed_.fetch_add(1);
  const std::lock_guard lock(mutex_);
  lastError_ = error;
}

// Looks again and again, because waking it would cost the scan thread a system call.
void RetainSaver::work() {
  bool stop = false;
  while (!stop) {
    {
      std::unique_lock lock(mutex_);
      wake_.wait_for(lock, poll_, [this] { return stop_ || hurry_; });
      hurry_ = false;
      stop = stop_;
    }
    saveOffered();
  }
}

} // namespace rung::host

// See shared_memory.h.
#include "machine/io/connections/shared_memory.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstring>
#include <stdexcept>

#include "machine/io/connections/modbus_image.h"
#include "rtlib/run/realtime.h"

namespace rung::io {
namespace {

constexpr int64_t kLookNs = 20'000'000;  // between two checks for the end
constexpr int64_t kKeepNs = 500'000'000; // between two checks of the file
constexpr mode_t kMode = 0600;
constexpr mode_t kAllModes = 07777;
constexpr size_t kAlignment = 8;

// Size of an area in bytes, rounded up to the alignment of the next one.
size_t sizeOf(const std::vector<ExchangedPin>& pins) {
  size_t end = 0;
  for (const ExchangedPin& pin : pins) end = std::max(end, size_t{pin.place.place} + bytesOf(pin.place.format));
  return (end + kAlignment - 1) / kAlignment * kAlignment;
}

std::string openProblem(int code) {
  if (code == ELOOP) return "it is a symbolic link";
  if (code == EINVAL) return "it is a folder"; // result of shm_open
  return std::strerror(code);
}

} // namespace

SharedMemory::SharedMemory(const host::Connection& connection, Exchange& exchange)
    : title_(connection.title()), name_("/rung-" + connection.name), exchange_(exchange),
      periodNs_(connection.periodNs), outputs_(sizeOf(exchange.outputs())), inputs_(sizeOf(exchange.inputs())),
      values_(exchange.inputs().size()) {
  open();
  layOut();
}

SharedMemory::~SharedMemory() {
  struct stat about{};
  const bool isOurs = fstat(file_.number(), &about) == 0 && about.st_nlink != 0;
  if (isOurs) shm_unlink(name_.c_str()); // otherwise the name may belong to another process
}

void SharedMemory::refuse(const std::string& found) const { throw std::runtime_error(title_ + ": " + found); }

// shm_open does not follow symbolic links. A file that is not ours is closed again.
void SharedMemory::open() {
  file_ = host::Socket();
  host::Socket file(shm_open(name_.c_str(), O_RDWR | O_CREAT, kMode));
  if (file.number() < 0) refuse("cannot open /dev/shm" + name_ + ": " + openProblem(errno));
  checkOwner(file.number());
  if (flock(file.number(), LOCK_EX | LOCK_NB) != 0)
    refuse("another process uses /dev/shm" + name_ + "; end it, or give this one another name");
  file_ = std::move(file);
}

void SharedMemory::checkOwner(int file) const {
  struct stat about{};
  if (fstat(file, &about) != 0 || !S_ISREG(about.st_mode) || about.st_nlink != 1)
    refuse("/dev/shm" + name_ + " is not a file of its own; remove it, or write another name");
  if (about.st_uid != geteuid())
    refuse("/dev/shm" + name_ + " belongs to user " + std::to_string(about.st_uid) + ", expected " +
           std::to_string(geteuid()) + ", who runs this; write another name");
  if ((about.st_mode & kAllModes & ~kMode) != 0)
    refuse("/dev/shm" + name_ + " may be used by others than its user; remove it");
}

// Programs that have already mapped the file stay connected, because its sequence continues.
void SharedMemory::layOut() {
  header_.outputsSize = static_cast<uint32_t>(outputs_.size());
  header_.inputsAt = header_.outputsAt + header_.outputsSize;
  header_.inputsSize = static_cast<uint32_t>(inputs_.size());
  const off_t size = header_.inputsAt + header_.inputsSize;
  if (ftruncate(file_.number(), size) != 0 || !reserve(size) ||
      !get(&taken_, sizeof taken_, offsetof(Header, inputsSequence)) ||
      !get(&header_.outputsSequence, sizeof header_.outputsSequence, offsetof(Header, outputsSequence)) ||
      !put(&header_, offsetof(Header, inputsSequence), 0))
    refuse("cannot write /dev/shm" + name_ + ": " + std::strerror(errno));
}

// Allocates the memory, so that later writes cannot fail.
bool SharedMemory::reserve(int64_t size) const {
  errno = posix_fallocate(file_.number(), 0, size);
  return errno == 0;
}

bool SharedMemory::get(void* to, size_t size, uint32_t at) const {
  return pread(file_.number(), to, size, at) == static_cast<ssize_t>(size);
}

bool SharedMemory::put(const void* from, size_t size, uint32_t at) const {
  return pwrite(file_.number(), from, size, at) == static_cast<ssize_t>(size);
}

// Restores the file if another program has removed it or overwritten its header, so that programs that open it now find
// this side.
void SharedMemory::keep() noexcept try {
  constexpr size_t kConstant = offsetof(Header, outputsSequence);
  struct stat about{};
  const bool isThere = fstat(file_.number(), &about) == 0 && about.st_nlink == 1;
  Header found;
  if (isThere && about.st_size == header_.inputsAt + header_.inputsSize && get(&found, kConstant, 0) &&
      std::memcmp(&found, &header_, kConstant) == 0)
    return;
  if (!isThere) open();
  layOut();
  setProblem(isThere ? "another program had written over its head or shortened it; it was created again"
                     : "another program had removed it; it was created again");
} catch (const std::exception& problem) {
  const std::string text = problem.what(), head = title_ + ": ";
  setProblem(text.starts_with(head) ? text.substr(head.size()) : text);
}

void SharedMemory::run(const std::atomic<bool>& ending) noexcept {
  for (int64_t kept = 0; !ending;) {
    const int64_t now = runtime::monotonicNs();
    if (now - kept >= kKeepNs) {
      keep();
      kept = now;
    }
    if (isOpen()) { // otherwise `keep` tries again
      writeOutputs();
      readInputs(now);
    }
    for (int64_t end = now + periodNs_, look = now; look < end && !ending; look = runtime::monotonicNs())
      runtime::sleepUntil(std::min(end, look + kLookNs));
  }
  if (isOpen()) writeOutputs();
}

void SharedMemory::writeOutputs() {
  const std::vector<double>& values = exchange_.newestOutputs();
  for (size_t i = 0; i < values.size(); ++i)
    toBytes(exchange_.outputs()[i], values[i], &outputs_[exchange_.outputs()[i].place.place]);
  const auto mark = [this] {
    return put(&header_.outputsSequence, sizeof header_.outputsSequence, offsetof(Header, outputsSequence));
  };
  header_.outputsSequence |= 1;
  bool done = mark();
  std::atomic_thread_fence(std::memory_order_seq_cst);
  done = put(outputs_.data(), outputs_.size(), header_.outputsAt) && done;
  std::atomic_thread_fence(std::memory_order_seq_cst);
  ++header_.outputsSequence;
  if (!mark() || !done) setProblem(std::string("cannot write: ") + std::strerror(errno));
}

void SharedMemory::readInputs(int64_t now) {
  uint32_t before = 0, after = 0;
  const auto look = [this](uint32_t& sequence) {
    return get(&sequence, sizeof sequence, offsetof(Header, inputsSequence));
  };
  bool whole = look(before);
  if (whole && (before == taken_ || before % 2 != 0)) return; // nothing new, or being written
  std::atomic_thread_fence(std::memory_order_seq_cst);
  whole = whole && get(inputs_.data(), inputs_.size(), header_.inputsAt);
  std::atomic_thread_fence(std::memory_order_seq_cst);
  whole = whole && look(after);
  if (!whole) return setProblem("the memory has been shortened by another program");
  if (after != before || !takeInputs()) return; // changed during the read: the next call reads it
  taken_ = before;
  exchange_.publish(values_, now);
}

bool SharedMemory::takeInputs() {
  for (size_t i = 0; i < values_.size(); ++i) {
    const ExchangedPin& pin = exchange_.inputs()[i];
    const std::optional<double> value = fromBytes(pin, &inputs_[pin.place.place]);
    if (!value) return setProblem("the input at " + std::to_string(pin.place.place) + " is not a number"), false;
    values_[i] = *value;
  }
  setProblem("");
  return true;
}

} // namespace rung::io

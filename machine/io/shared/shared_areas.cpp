// Reading and writing shared areas.
#include "machine/io/shared/shared_areas.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstddef>
#include <cstring>
#include <thread>
#include <utility>

#include "rtlib/load/file.h"

namespace rung::io {

namespace {

#ifdef __GLIBC__
// The bit of a locked mutex that other threads set: it shows that they wait.
constexpr int kWaiters = INT32_MIN; // FUTEX_WAITERS

int lockWord(const pthread_mutex_t& mutex) { return __atomic_load_n(&mutex.__data.__lock, __ATOMIC_RELAXED); }

bool isAsLocked(const pthread_mutex_t& mutex, const pthread_mutex_t& asLocked) {
  if (((lockWord(mutex) ^ lockWord(asLocked)) & ~kWaiters) != 0) return false;
  pthread_mutex_t now;
  std::memcpy(&now, &mutex, sizeof now);
  now.__data.__lock = asLocked.__data.__lock;
  return std::ranges::equal(std::as_bytes(std::span(&now, 1)), std::as_bytes(std::span(&asLocked, 1)));
}

// Checks the kind of a mutex: the C library would use the contents of an overwritten one as pointers.
bool isRobust(const pthread_mutex_t& mutex) {
  static const int kKind = [] {
    pthread_mutex_t fresh;
    makeMutex(fresh);
    return fresh.__data.__kind;
  }();
  return __atomic_load_n(&mutex.__data.__kind, __ATOMIC_RELAXED) == kKind;
}

void repair(pthread_mutex_t& mutex, pthread_mutex_t asLocked) {
  asLocked.__data.__lock |= kWaiters; // a thread may wait
  std::memcpy(&mutex, &asLocked, sizeof mutex);
}
#else
bool isAsLocked(const pthread_mutex_t&, const pthread_mutex_t&) { return true; }
bool isRobust(const pthread_mutex_t&) { return true; }
void repair(pthread_mutex_t&, const pthread_mutex_t&) {}
#endif

} // namespace

AreaResult unlockArea(pthread_mutex_t& mutex, const pthread_mutex_t& asLocked) noexcept {
  const bool isSound = isAsLocked(mutex, asLocked);
  if (!isSound) repair(mutex, asLocked);
  pthread_mutex_unlock(&mutex);
  return isSound ? AreaResult::Done : AreaResult::Broken;
}

void SharedAreas::Unmap::operator()(Layout* layout) const noexcept {
  if (mapped) {
    ::munmap(layout, sizeof *layout);
  } else {
    for (pthread_mutex_t& mutex : layout->mutexes) pthread_mutex_destroy(&mutex);
    delete layout;
  }
}

SharedAreas::SharedAreas() : layout_(new Layout(), Unmap{false}) {
  initialize(*layout_);
  isRobust(layout_->mutexes[0]); // the first call must not be in a scan
}

SharedAreas::~SharedAreas() = default;

// Checks the length of the file: access beyond its end would terminate the process.
bool SharedAreas::isSound(uint32_t area) const noexcept {
  if (!file_.ok()) return true;
  struct stat about{};
  if (::fstat(file_.fd(), &about) != 0 || about.st_size < static_cast<off_t>(sizeof(Layout))) return false;
  return isHead(layout_->head) && isRobust(layout_->mutexes[area]);
}

AreaResult SharedAreas::lock(uint32_t area) noexcept {
  if (held_[area].load(std::memory_order_relaxed)) return AreaResult::Locked;
  if (!isSound(area)) return AreaResult::Broken;
  pthread_mutex_t& mutex = layout_->mutexes[area];
  switch (pthread_mutex_trylock(&mutex)) {
  case 0: return AreaResult::Done;
  case EBUSY: return AreaResult::Locked;
  case EOWNERDEAD: pthread_mutex_consistent(&mutex); return AreaResult::Done;
  default: return AreaResult::Broken;
  }
}

AreaResult SharedAreas::move(uint32_t area, uint32_t offset, uint8_t* own, size_t size, bool toOwn) noexcept {
  if (area >= kAreas) return AreaResult::NoArea;
  if (offset > kAreaBytes || size > kAreaBytes - offset) return AreaResult::Outside;
  if (size == 0) return AreaResult::Done;
  if (const AreaResult locked = lock(area); locked != AreaResult::Done) return locked;
  pthread_mutex_t& mutex = layout_->mutexes[area];
  pthread_mutex_t asLocked;
  std::memcpy(&asLocked, &mutex, sizeof mutex);
  uint8_t* const shared = layout_->areas[area].bytes.data() + offset;
  std::memcpy(toOwn ? own : shared, toOwn ? shared : own, size);
  return unlockArea(mutex, asLocked);
}

AreaResult SharedAreas::read(uint32_t area, uint32_t offset, std::span<uint8_t> to) noexcept {
  return move(area, offset, to.data(), to.size(), true);
}

AreaResult SharedAreas::write(uint32_t area, uint32_t offset, std::span<const uint8_t> from) noexcept {
  return move(area, offset, const_cast<uint8_t*>(from.data()), from.size(), false); // only read from
}

bool SharedAreas::hold(uint32_t area, bool on) noexcept {
  if (area < kAreas) held_[area].store(on, std::memory_order_relaxed);
  return area < kAreas;
}

void SharedAreas::clear() noexcept {
  for (Area& area : layout_->areas) area.bytes.fill(0);
  for (std::atomic<bool>& held : held_) held.store(false, std::memory_order_relaxed);
}

std::span<uint8_t> SharedAreas::bytes(uint32_t area) noexcept {
  return area < kAreas ? std::span<uint8_t>(layout_->areas[area].bytes) : std::span<uint8_t>();
}

// The file of shared areas: creating it, and sharing it with other processes.

namespace {

using Layout = SharedAreas::Layout;
using Head = SharedAreas::Head;

constexpr std::array<char, 8> kMagic = {'R', 'U', 'N', 'G', '-', 'S', 'A', '\0'};
constexpr Head kHead{kMagic,
                     SharedAreas::kVersion,
                     sizeof(Layout),
                     SharedAreas::kAreas,
                     SharedAreas::kAreaBytes,
                     sizeof(pthread_mutex_t),
                     offsetof(Layout, areas)};
constexpr mode_t kMode = 0600, kOthers = 0077;
constexpr int kTries = 100; // while another process holds the lock to create the file
constexpr auto kBetweenTries = std::chrono::milliseconds(10);

static_assert(sizeof(Head) == 32 && alignof(pthread_mutex_t) <= sizeof(Head));
static_assert(sizeof(Layout) == offsetof(Layout, areas) + size_t{SharedAreas::kAreas} * SharedAreas::kAreaBytes);

std::string notOurs(const struct stat& about) {
  if (!S_ISREG(about.st_mode) || about.st_nlink != 1) return "it is not a file of its own";
  if (about.st_uid != ::geteuid())
    return "it belongs to user " + std::to_string(about.st_uid) + ", expected " + std::to_string(::geteuid()) +
           ", who runs this";
  if ((about.st_mode & kOthers) != 0) return "others than its user may use it, expected mode 0600";
  return {};
}

// Opening does not block; a pipe or a device is refused.
std::string open(const std::string& path, runtime::File& file, off_t& size) {
  file = runtime::File(::open(path.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, kMode));
  if (!file.ok()) return runtime::fileProblem(errno);
  struct stat about{};
  if (::fstat(file.fd(), &about) != 0) return runtime::fileProblem(errno);
  size = about.st_size;
  return notOurs(about);
}

bool share(int fd) {
  for (int i = 0; i < kTries; ++i) {
    if (::flock(fd, LOCK_SH | LOCK_NB) == 0) return true;
    std::this_thread::sleep_for(kBetweenTries);
  }
  return false;
}

std::string wrongSize(off_t size) {
  return "it has " + std::to_string(size) + " bytes, expected " + std::to_string(sizeof(Layout)) +
         "; it is not a file of shared areas";
}

Layout* map(int fd) {
  void* const memory = ::mmap(nullptr, sizeof(Layout), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_POPULATE, fd, 0);
  return memory == MAP_FAILED ? nullptr : static_cast<Layout*>(memory);
}

// Returns "", or why the contents are not those of shared areas; `isFirst`: they have to be initialized.
std::string check(Layout& layout, bool isFirst) {
  if (isFirst ? !mayBeMadeAnew(layout.head) : !isHead(layout.head))
    return "it is not a file of shared areas of version " + std::to_string(SharedAreas::kVersion);
  if (isFirst) initialize(layout);
  return {};
}

} // namespace

void makeMutex(pthread_mutex_t& mutex) {
  pthread_mutexattr_t kind;
  pthread_mutexattr_init(&kind);
  pthread_mutexattr_setpshared(&kind, PTHREAD_PROCESS_SHARED);
  pthread_mutexattr_setrobust(&kind, PTHREAD_MUTEX_ROBUST);
  std::memset(&mutex, 0, sizeof mutex); // including bytes that the library does not initialize
  pthread_mutex_init(&mutex, &kind);
  pthread_mutexattr_destroy(&kind);
}

void initialize(Layout& layout) {
  layout.head = {};
  for (pthread_mutex_t& mutex : layout.mutexes) makeMutex(mutex);
  for (SharedAreas::Area& area : layout.areas) area.bytes.fill(0);
  std::atomic_thread_fence(std::memory_order_release);
  layout.head = kHead;
}

bool isHead(const Head& head) noexcept { return std::memcmp(&head, &kHead, sizeof head) == 0; }

bool mayBeMadeAnew(const Head& head) noexcept { return head.magic == kMagic || head == Head{}; }

std::string SharedAreas::mapFile(const std::string& path) {
  const auto cannot = [&](const std::string& why) { return "cannot use " + path + " for shared areas: " + why; };
  runtime::File file;
  off_t size = 0;
  if (std::string wrong = open(path, file, size); !wrong.empty()) return cannot(wrong);
  const bool isFirst = ::flock(file.fd(), LOCK_EX | LOCK_NB) == 0;
  if (!isFirst && !share(file.fd())) return cannot("another program keeps it locked");
  struct stat about{};
  if (::fstat(file.fd(), &about) == 0) size = about.st_size; // another process may have created it meanwhile
  if (size != static_cast<off_t>(sizeof(Layout)) && !(isFirst && size == 0)) return cannot(wrongSize(size));
  errno = ::posix_fallocate(file.fd(), 0, sizeof(Layout));
  if (errno != 0) return cannot(runtime::fileProblem(errno));
  std::unique_ptr<Layout, Unmap> layout(map(file.fd()), Unmap{true});
  if (!layout) return cannot(runtime::fileProblem(errno));
  if (std::string wrong = check(*layout, isFirst); !wrong.empty()) return cannot(wrong);
  if (isFirst && !share(file.fd())) return cannot("another program keeps it locked");
  layout_ = std::move(layout);
  file_ = std::move(file);
  return {};
}

} // namespace rung::io

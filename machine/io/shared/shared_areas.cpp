// Reading and writing shared areas (see shared_areas.h).
#include "machine/io/shared/shared_areas.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <sys/mman.h>
#include <sys/stat.h>

#include "machine/io/shared/shared_areas_layout.h"

namespace rung::io {
namespace {

#ifdef __GLIBC__
// What others change of a mutex while it is locked: they note that they wait.
constexpr int kWaiters = INT32_MIN; // FUTEX_WAITERS

int lockWord(const pthread_mutex_t& mutex) { return __atomic_load_n(&mutex.__data.__lock, __ATOMIC_RELAXED); }

bool isAsLocked(const pthread_mutex_t& mutex, const pthread_mutex_t& asLocked) {
  if (((lockWord(mutex) ^ lockWord(asLocked)) & ~kWaiters) != 0) return false;
  pthread_mutex_t now;
  std::memcpy(&now, &mutex, sizeof now);
  now.__data.__lock = asLocked.__data.__lock;
  return std::ranges::equal(std::as_bytes(std::span(&now, 1)), std::as_bytes(std::span(&asLocked, 1)));
}

// A mutex that was written over would make the C library follow whatever it holds as pointers.
bool isRobust(const pthread_mutex_t& mutex) {
  static const int kKind = [] {
    pthread_mutex_t fresh;
    makeMutex(fresh);
    return fresh.__data.__kind;
  }();
  return __atomic_load_n(&mutex.__data.__kind, __ATOMIC_RELAXED) == kKind;
}

void repair(pthread_mutex_t& mutex, pthread_mutex_t asLocked) {
  asLocked.__data.__lock |= kWaiters; // somebody may wait
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
  isRobust(layout_->mutexes[0]); // its first call is not a scan's
}

SharedAreas::~SharedAreas() = default;

// A file that has been shortened has no memory any more, and touching it would end the process.
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

} // namespace rung::io

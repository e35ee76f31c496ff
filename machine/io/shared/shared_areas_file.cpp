// The file of shared areas (see shared_areas.h): making it, and joining the others who have mapped it.
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstddef>
#include <cstring>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <thread>
#include <unistd.h>
#include <utility>

#include "machine/io/shared/shared_areas_layout.h"
#include "rtlib/load/disk_file.h"

namespace rung::io {
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
constexpr int kTries = 100; // of a lock that somebody has while the file is made
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

// Nothing is waited for: a pipe or a device of this name is refused.
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

// "", or why the contents are not those of shared areas; `isFirst`: they are to be made.
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
  std::memset(&mutex, 0, sizeof mutex); // also what the library leaves as it is
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
  if (::fstat(file.fd(), &about) == 0) size = about.st_size; // it may have been made meanwhile
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

// Files are written under a temporary name, then renamed.
#include "rtlib/load/file.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <link.h>
#include <sys/file.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <climits>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <system_error>
#include <utility>

namespace rung::runtime {

namespace {

// The file to which a link leads, or the path itself.
std::string targetOf(const std::string& path) {
  std::array<char, PATH_MAX> real{};
  return ::realpath(path.c_str(), real.data()) != nullptr ? std::string(real.data()) : path;
}

std::string unfinishedName(const std::string& path) {
  uint64_t random = 0;
  if (::getrandom(&random, sizeof random, 0) != sizeof random) random = static_cast<uint64_t>(::getpid());
  std::array<char, 24> text{};
  std::snprintf(text.data(), text.size(), ".%016llx.tmp", static_cast<unsigned long long>(random));
  return path + text.data();
}

// Creates a file that no other process has opened or prepared a link for.
File createUnfinished(int folder, const std::string& path, mode_t mode, std::string& name) {
  for (int attempt = 0; attempt < 8; ++attempt) {
    name = unfinishedName(path);
    File file(::openat(folder, name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, mode));
    if (file.ok() || errno != EEXIST) return file;
  }
  return File();
}

bool rename(int folder, const std::string& from, const std::string& to, bool mayReplace) {
  return ::renameat2(folder, from.c_str(), folder, to.c_str(), mayReplace ? 0 : RENAME_NOREPLACE) == 0;
}

// Makes a rename durable. Some file systems do not support this for folders and return EINVAL.
std::string syncFolder(int folder, const std::string& name) {
  const File file(::openat(folder, name.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  const bool synced = file.ok() && ::fsync(file.fd()) == 0;
  return synced || errno == EINVAL ? "" : "its folder: " + std::string(std::strerror(errno));
}

bool writeInto(const std::string& path, std::string_view bytes) {
  File file(::open(path.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY));
  return file.ok() && writeAll(file.fd(), bytes) && file.close();
}

} // namespace

std::string folderOf(const std::string& path) {
  const size_t slash = path.rfind('/');
  if (slash == std::string::npos) return ".";
  return slash == 0 ? "/" : path.substr(0, slash);
}

File::~File() {
  if (fd_ >= 0) ::close(fd_);
}

bool File::close() {
  const int fd = release();
  return fd < 0 || ::close(fd) == 0;
}

bool writeAll(int fd, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t n = ::write(fd, bytes.data(), bytes.size());
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    bytes.remove_prefix(static_cast<size_t>(n));
  }
  return true;
}

std::string readAll(int fd, size_t most, std::string& bytes) {
  bytes.clear();
  std::array<char, 1 << 16> piece{};
  for (;;) {
    const ssize_t n = ::pread(fd, piece.data(), piece.size(), static_cast<off_t>(bytes.size()));
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return std::strerror(errno);
    if (n == 0) return {};
    if (bytes.size() + static_cast<size_t>(n) > most) return "it is larger than " + std::to_string(most >> 20) + " MB";
    bytes.append(piece.data(), static_cast<size_t>(n));
  }
}

std::string finishReplacing(int folder, File file, const std::string& unfinished, const std::string& name,
                            std::string_view bytes, const Writing& writing) {
  if (!writeAll(file.fd(), bytes) || (writing.lasts && ::fsync(file.fd()) != 0) || !file.close() ||
      !rename(folder, unfinished, name, writing.mayReplace)) {
    std::string why = std::strerror(errno);
    ::unlinkat(folder, unfinished.c_str(), 0);
    return why;
  }
  return writing.lasts ? syncFolder(folder, folderOf(name)) : std::string();
}

std::string replaceFileIn(int folder, const std::string& name, std::string_view bytes, const Writing& writing) {
  std::string unfinished;
  File file = createUnfinished(folder, name, writing.mode, unfinished);
  if (!file.ok()) return std::strerror(errno);
  return finishReplacing(folder, std::move(file), unfinished, name, bytes, writing);
}

std::string replaceFile(const std::string& path, std::string_view bytes, const Writing& writing) {
  struct stat there{};
  const bool exists = ::stat(path.c_str(), &there) == 0;
  const bool isStream = exists && !S_ISREG(there.st_mode) && !S_ISDIR(there.st_mode);
  std::string why;
  if (!writing.mayReplace || !exists)
    why = replaceFileIn(AT_FDCWD, path, bytes, writing);
  else if (isStream)
    why = writeInto(path, bytes) ? "" : std::strerror(errno);
  else
    why = replaceFileIn(AT_FDCWD, targetOf(path), bytes, writing);
  if (!why.empty() && ::stat(folderOf(path).c_str(), &there) != 0 && errno == ENOENT)
    why = "the folder " + folderOf(path) + " does not exist";
  return why.empty() ? "" : "cannot write '" + path + "': " + why;
}

// Opening, reading, replacing and locking.

namespace {

constexpr int kNotRegular = EBADFD; // no system call used here returns it

std::string cannotWrite(const std::string& path, int code) { return "cannot write " + path + ": " + fileProblem(code); }

} // namespace

File openDiskFile(const std::string& path, int flags) {
  File file(::open(path.c_str(), flags | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0644));
  struct stat status{};
  if (!file.ok() || (::fstat(file.fd(), &status) == 0 && S_ISREG(status.st_mode))) return file;
  file.close();
  errno = kNotRegular;
  return file;
}

std::string fileProblem(int code) {
  if (code == ELOOP) return "it is a symbolic link";
  if (code == kNotRegular) return "it is not a regular file";
  return std::generic_category().message(code);
}

bool replaceDiskFile(const std::string& path, std::span<const uint8_t> bytes, std::string& error) {
  const std::string temporary = path + ".tmp";
  // A crash may have left it; it is removed, so that a link in its place is not followed.
  if (::unlink(temporary.c_str()) != 0 && errno != ENOENT) {
    error = cannotWrite(temporary, errno);
    return false;
  }
  File file = openDiskFile(temporary, O_WRONLY | O_CREAT | O_EXCL);
  if (!file.ok()) {
    error = cannotWrite(temporary, errno);
    return false;
  }
  const std::string wrong =
      finishReplacing(AT_FDCWD, std::move(file), temporary, path,
                      {reinterpret_cast<const char*>(bytes.data()), bytes.size()}, {.lasts = true});
  if (!wrong.empty()) error = "cannot write " + path + ": " + wrong;
  return wrong.empty();
}

// The lock has a separate file, because a lock belongs to the file and not to its name: a lock on a file that is
// replaced would end with the first replacement. The file is never removed, so all processes lock the same one.
DiskLock lockDiskFile(const std::string& path) {
  DiskLock lock;
  lock.file = openDiskFile(path, O_RDWR); // NFS locks only files that are open for writing
  lock.made = !lock.file.ok() && errno == ENOENT;
  if (lock.made) lock.file = openDiskFile(path, O_RDWR | O_CREAT);
  if (!lock.file.ok()) {
    lock.error = cannotWrite(path, errno);
    return lock;
  }
  while (::flock(lock.file.fd(), LOCK_EX | LOCK_NB) != 0) {
    if (errno == EINTR) continue;
    if (errno != EWOULDBLOCK) lock.error = "cannot lock " + path + ": " + fileProblem(errno);
    lock.file.close();
    break;
  }
  return lock;
}

namespace {

class SystemDisk final : public Disk {
public:
  bool read(const std::string& path, size_t most, std::string& bytes, std::string& problem) override {
    const File file = openDiskFile(path, O_RDONLY);
    if (!file.ok() && errno == ENOENT) return false;
    problem = file.ok() ? readAll(file.fd(), most, bytes) : fileProblem(errno);
    return true;
  }
  bool replace(const std::string& path, std::span<const uint8_t> bytes, std::string& error) override {
    return replaceDiskFile(path, bytes, error);
  }
  std::unique_ptr<Lock> lock(const std::string& path, bool& made, std::string& error) override {
    DiskLock lock = lockDiskFile(path);
    made = lock.made;
    error = std::move(lock.error);
    return lock.file.ok() ? std::make_unique<Held>(std::move(lock.file)) : nullptr;
  }

private:
  class Held final : public Lock {
  public:
    explicit Held(File file) : file_(std::move(file)) {}

  private:
    File file_;
  };
};

} // namespace

Disk& systemDisk() noexcept {
  static SystemDisk disk;
  return disk;
}

// Segments of a loaded library.

MappedFile::MappedFile(void* library) {
  link_map* map = nullptr;
  if (dlinfo(library, RTLD_DI_LINKMAP, &map) != 0) return;
  struct Search {
    MappedFile& file;
    ElfW(Addr) base;
    const ElfW(Dyn) * dynamic;
  } search{*this, map->l_addr, map->l_ld};
  dl_iterate_phdr(
      [](dl_phdr_info* info, size_t, void* data) {
        auto& wanted = *static_cast<Search*>(data);
        bool isIt = false;
        for (size_t i = 0; i < info->dlpi_phnum; ++i)
          isIt = isIt || (info->dlpi_phdr[i].p_type == PT_DYNAMIC &&
                          info->dlpi_addr + info->dlpi_phdr[i].p_vaddr == reinterpret_cast<uintptr_t>(wanted.dynamic));
        for (size_t i = 0; isIt && i < info->dlpi_phnum; ++i) {
          const auto& segment = info->dlpi_phdr[i];
          if (segment.p_type != PT_LOAD || (segment.p_flags & PF_R) == 0) continue;
          const uintptr_t begin = info->dlpi_addr + segment.p_vaddr;
          wanted.file.segments_.push_back({begin, begin + segment.p_memsz, (segment.p_flags & PF_X) != 0});
        }
        return isIt ? 1 : 0;
      },
      &search);
}

MappedFile::MappedFile(const void* begin, uint64_t bytes, bool isCode)
    : segments_{{reinterpret_cast<uintptr_t>(begin), reinterpret_cast<uintptr_t>(begin) + bytes, isCode}} {}

const MappedFile::Segment* MappedFile::segmentOf(const void* address, uint64_t bytes) const noexcept {
  const auto at = reinterpret_cast<uintptr_t>(address);
  for (const Segment& segment : segments_)
    if (at >= segment.begin && at <= segment.end && bytes <= segment.end - at) return &segment;
  return nullptr;
}

bool MappedFile::holdsCode(const void* address) const noexcept {
  const Segment* segment = segmentOf(address, 1);
  return segment != nullptr && segment->isCode;
}

bool MappedFile::holdsText(const char* text) const noexcept {
  const Segment* segment = segmentOf(text, 1);
  return segment != nullptr && std::memchr(text, 0, segment->end - reinterpret_cast<uintptr_t>(text)) != nullptr;
}

} // namespace rung::runtime

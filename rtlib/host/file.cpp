// Written under a name of its own, then renamed (see file.h).
#include "rtlib/host/file.h"

#include <array>
#include <cerrno>
#include <climits>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

namespace rung::host {
namespace {

// Of a link, the file that it leads to.
std::string targetOf(const std::string& path) {
  std::array<char, PATH_MAX> real{};
  return ::realpath(path.c_str(), real.data()) != nullptr ? std::string(real.data()) : path;
}

std::string folderOf(const std::string& path) {
  const size_t slash = path.rfind('/');
  if (slash == std::string::npos) return ".";
  return slash == 0 ? "/" : path.substr(0, slash);
}

std::string unfinishedName(const std::string& path) {
  uint64_t random = 0;
  if (::getrandom(&random, sizeof random, 0) != sizeof random) random = static_cast<uint64_t>(::getpid());
  std::array<char, 24> text{};
  std::snprintf(text.data(), text.size(), ".%016llx.tmp", static_cast<unsigned long long>(random));
  return path + text.data();
}

// A file that nobody else has, nor has prepared a link for.
File createUnfinished(const std::string& path, mode_t mode, std::string& name) {
  for (int attempt = 0; attempt < 8; ++attempt) {
    name = unfinishedName(path);
    File file(::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, mode));
    if (file.ok() || errno != EEXIST) return file;
  }
  return File();
}

bool rename(const std::string& from, const std::string& to, bool mayReplace) {
  return ::renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), mayReplace ? 0 : RENAME_NOREPLACE) == 0;
}

// False, with errno, and nothing is left.
bool writeAndRename(const std::string& path, std::string_view bytes, const Writing& writing) {
  std::string unfinished;
  File file = createUnfinished(path, writing.mode, unfinished);
  if (!file.ok()) return false;
  if (writeAll(file.fd(), bytes) && (!writing.lasts || ::fsync(file.fd()) == 0) && file.close() &&
      rename(unfinished, path, writing.mayReplace))
    return true;
  const int why = errno;
  ::unlink(unfinished.c_str());
  errno = why;
  return false;
}

bool writeInto(const std::string& path, std::string_view bytes) {
  File file(::open(path.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY));
  return file.ok() && writeAll(file.fd(), bytes) && file.close();
}

} // namespace

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

std::string replaceFile(const std::string& path, std::string_view bytes, const Writing& writing) {
  struct stat there{};
  const bool exists = ::stat(path.c_str(), &there) == 0;
  const bool isStream = exists && !S_ISREG(there.st_mode) && !S_ISDIR(there.st_mode);
  const std::string target = writing.mayReplace ? targetOf(path) : path;
  const bool written = isStream && writing.mayReplace ? writeInto(path, bytes) : writeAndRename(target, bytes, writing);
  if (!written) return "cannot write '" + path + "': " + std::strerror(errno);
  if (writing.lasts) {
    // Makes the name last; some file systems refuse, the file is whole anyway.
    const File folder(::open(folderOf(target).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (folder.ok()) ::fsync(folder.fd());
  }
  return {};
}

} // namespace rung::host

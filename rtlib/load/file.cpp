// Written under a name of its own, then renamed (see file.h).
#include "rtlib/load/file.h"

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

namespace rung::runtime {
namespace {

// Of a link, the file that it leads to.
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

// A file that nobody else has, nor has prepared a link for.
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

// Makes a rename last. Some file systems have nothing to write for a folder and say so: EINVAL.
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

} // namespace rung::runtime

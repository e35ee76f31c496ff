// Reads files named by a user. Devices and pipes, which might never end or block, and files that are too large are
// refused.
#pragma once
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <string>
#include <string_view>
#include <sys/stat.h>
#include <unistd.h>

namespace rung::text {

inline constexpr size_t kMostSource = size_t{64} << 20; // maximum bytes of a source, a scenario or a report

// Opens a file. Returns its descriptor; -1, and `problem` says why.
inline int openRegular(const std::string& path, std::string& problem) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
  struct stat about{};
  if (file < 0 || ::fstat(file, &about) != 0)
    problem = std::strerror(errno);
  else if (S_ISDIR(about.st_mode))
    problem = "it is a folder";
  else if (!S_ISREG(about.st_mode))
    problem = "it is not a regular file";
  else
    return file;
  if (file >= 0) ::close(file);
  return -1;
}

// Reads a file of at most `most` bytes. Returns "", or why it cannot be read.
inline std::string readRegular(const std::string& path, size_t most, std::string& contents) {
  std::string problem;
  const int file = openRegular(path, problem);
  if (file < 0) return problem;
  contents.clear();
  char piece[1 << 16];
  for (;;) {
    const ssize_t got = ::read(file, piece, sizeof piece);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) problem = std::strerror(errno);
    if (got <= 0) break;
    if (contents.size() + static_cast<size_t>(got) > most) {
      problem = "it has more than " + std::to_string(most >> 20) + " MB";
      break;
    }
    contents.append(piece, static_cast<size_t>(got));
  }
  ::close(file);
  return problem;
}

} // namespace rung::text

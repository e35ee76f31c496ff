// Files of the operating system: a descriptor with its owner, a file's bytes, and the one way to write a file.
#pragma once
#include <string>
#include <string_view>
#include <sys/types.h>
#include <utility>

namespace rung::runtime {

// Owns a file descriptor.
class File {
public:
  explicit File(int fd = -1) : fd_(fd) {}
  ~File();
  File(File&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
  File& operator=(File&& other) noexcept {
    std::swap(fd_, other.fd_);
    return *this;
  }
  File(const File&) = delete;
  File& operator=(const File&) = delete;

  bool ok() const { return fd_ >= 0; }
  int fd() const { return fd_; }
  // Whoever asks owns it from then on.
  int release() { return std::exchange(fd_, -1); }
  // False, with errno: what was written may not be there.
  bool close();

private:
  int fd_;
};

// False, with errno.
bool writeAll(int fd, std::string_view bytes);

// All bytes of the file, from its start, wherever the descriptor's position is. Empty, or what went wrong: also when
// they are more than `most`.
std::string readAll(int fd, size_t most, std::string& bytes);

// The folder of a path, "." of a bare name.
std::string folderOf(const std::string& path);

struct Writing {
  mode_t mode = 0666;     // less the process's umask
  bool mayReplace = true; // false: a file of this name is an error
  bool lasts = false;     // on the disk when the function returns, whatever happens to the machine then
};

// The second half of replacing a file: `unfinished`, a file of the same folder that nobody else uses, gets the bytes
// through `file` and then the name; it is gone when that fails. Empty, or why not.
std::string finishReplacing(int folder, File file, const std::string& unfinished, const std::string& name,
                            std::string_view bytes, const Writing& writing);

// The name, seen from an open folder or from AT_FDCWD, leads to the whole old file or to the whole new one at any time,
// also where several processes write to one name; whoever has the old file open or loaded keeps it as it was. Empty, or
// why not.
std::string replaceFileIn(int folder, const std::string& name, std::string_view bytes, const Writing& writing = {});
// The same for a path that a user has named: a link is followed, a device or a pipe is just written to. Empty, or
// "cannot write 'PATH': why".
std::string replaceFile(const std::string& path, std::string_view bytes, const Writing& writing = {});

} // namespace rung::runtime

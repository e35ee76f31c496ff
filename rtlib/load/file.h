// Files of the operating system: a descriptor with its owner, a file's bytes, and the one way to write a file.
#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <sys/types.h>

namespace rung::runtime {

// A file descriptor, closed by the destructor.
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
  // The caller owns it from then on.
  int release() { return std::exchange(fd_, -1); }
  // Closes the file. False, with errno: written data may be lost.
  bool close();

private:
  int fd_;
};

// Writes all bytes. False, with errno: it failed.
bool writeAll(int fd, std::string_view bytes);

// Reads all bytes of the file from its start, whatever the descriptor's position. Returns "", or the reason of a
// failure; a file of more than `most` bytes is a failure.
std::string readAll(int fd, size_t most, std::string& bytes);

// The folder of a path; "." for a name without folder.
std::string folderOf(const std::string& path);

struct Writing {
  mode_t mode = 0666;     // less the process's umask
  bool mayReplace = true; // false: a file of this name is an error
  bool lasts = false;     // the file is on disk when the function returns (fsync)
};

// The second half of replacing a file: writes the bytes through `file` to `unfinished`, a file of the same folder that
// no other process uses, and renames it to `name`. On failure `unfinished` is removed. Returns "", or the reason.
std::string finishReplacing(int folder, File file, const std::string& unfinished, const std::string& name,
                            std::string_view bytes, const Writing& writing);

// Replaces the file `name` of an open folder (or AT_FDCWD) atomically: at any time the name refers to the complete old
// file or the complete new one, even if several processes write it. A process that has the old file open or loaded
// keeps it unchanged. Returns "", or the reason of a failure.
std::string replaceFileIn(int folder, const std::string& name, std::string_view bytes, const Writing& writing = {});
// The same for a path given by a user: a link is followed, a device or a pipe is written directly. Returns "", or
// "cannot write 'PATH': why".
std::string replaceFile(const std::string& path, std::string_view bytes, const Writing& writing = {});

// Files that survive a power failure and that no other process shares. The functions block: not for the scan thread.

// Opens a file without following a symbolic link or waiting at a pipe. The result is not open, with errno, if the path
// is not a regular file or cannot be opened.
File openDiskFile(const std::string& path, int flags);

// The text of an errno value for a file, such as "No space left on device".
std::string fileProblem(int code);

// True: the new contents are on disk. False: `error` says which file and why, and the file is completely the old or the
// new one. It writes PATH.tmp, so a crash leaves one extra file at most; for one process at a time (for several, see
// replaceFile).
bool replaceDiskFile(const std::string& path, std::span<const uint8_t> bytes, std::string& error);

struct DiskLock {
  File file;         // open: it is locked
  bool made = false; // the file did not exist before
  std::string error; // "" when another process has the lock
};

// The storage of such files. Tests use one in memory, which becomes full or loses power on request.
class Disk {
public:
  // The file is locked as long as this object exists.
  class Lock {
  public:
    virtual ~Lock() = default;
  };
  virtual ~Disk() = default;
  // False: the file does not exist. `problem`: why it cannot be read, or "".
  virtual bool read(const std::string& path, size_t most, std::string& bytes, std::string& problem) = 0;
  // As replaceDiskFile.
  virtual bool replace(const std::string& path, std::span<const uint8_t> bytes, std::string& error) = 0;
  // As lockDiskFile. Null: `error` says why, or is "" if another process has the lock. `made`: the file did not exist
  // before.
  virtual std::unique_ptr<Lock> lock(const std::string& path, bool& made, std::string& error) = 0;
};
Disk& systemDisk() noexcept;
// Locks a file against other processes and other callers in this one until it is closed; a crash releases the lock,
// too. The file is created if necessary, and is not removed.
DiskLock lockDiskFile(const std::string& path);

// The memory of a loaded library in the process, into which its tables must point.

class MappedFile {
public:
  // `library` is a handle of dlopen. The object is empty if the system does not report where the library is mapped.
  explicit MappedFile(void* library);
  // A single span of memory, for tests.
  MappedFile(const void* begin, uint64_t bytes, bool isCode);

  bool holds(const void* address, uint64_t bytes) const noexcept { return segmentOf(address, bytes) != nullptr; }
  bool holdsCode(const void* address) const noexcept;
  // Whether a text with its terminating 0 is inside.
  bool holdsText(const char* text) const noexcept;

private:
  struct Segment {
    uintptr_t begin = 0;
    uintptr_t end = 0;
    bool isCode = false;
  };
  const Segment* segmentOf(const void* address, uint64_t bytes) const noexcept;
  std::vector<Segment> segments_;
};

} // namespace rung::runtime

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

// False, with errno.
bool writeAll(int fd, std::string_view bytes);

// Reads all bytes of the file from its start, whatever the descriptor's position is. Empty, or the reason of a failure;
// more than `most` bytes are one.
std::string readAll(int fd, size_t most, std::string& bytes);

// The folder of a path; "." for a name without folder.
std::string folderOf(const std::string& path);

struct Writing {
  mode_t mode = 0666;     // less the process's umask
  bool mayReplace = true; // false: a file of this name is an error
  bool lasts = false;     // on the disk when the function returns, whatever happens to the machine then
};

// The second half of replacing a file: `unfinished`, a file of the same folder that no other process uses, gets the
// bytes through `file` and then the name; it is gone when that fails. Empty, or why not.
std::string finishReplacing(int folder, File file, const std::string& unfinished, const std::string& name,
                            std::string_view bytes, const Writing& writing);

// The name, seen from an open folder or from AT_FDCWD, leads to the whole old file or to the whole new one at any time,
// also where several processes write to one name; a process that has the old file open or loaded keeps it unchanged.
// Empty, or why not.
std::string replaceFileIn(int folder, const std::string& name, std::string_view bytes, const Writing& writing = {});
// The same for a path that a user has named: a link is followed, a device or a pipe is just written to. Empty, or
// "cannot write 'PATH': why".
std::string replaceFile(const std::string& path, std::string_view bytes, const Writing& writing = {});

// Files that a power failure must not damage and another process must not share. Blocks: not for the scan thread.

// Neither follows a symbolic link nor waits at a pipe. Not open, with errno, when it is not a regular file or cannot be
// opened.
File openDiskFile(const std::string& path, int flags);

// What `code` of errno means for a file: "No space left on device".
std::string fileProblem(int code);

// The new contents are on disk when it returns true; else `error` says which file and why, and the file is the old or
// the new one, whole. PATH.tmp is used up, so crashes leave one file at most: for one process at a time; where several
// write, see replaceFile.
bool replaceDiskFile(const std::string& path, std::span<const uint8_t> bytes, std::string& error);

struct DiskLock {
  File file;         // open: it is locked
  bool made = false; // there was none before
  std::string error; // "" when another process has the lock
};

// The place of such files. A test has one in memory, which becomes full or loses its power on request.
class Disk {
public:
  // As long as it exists, the file is locked.
  class Lock {
  public:
    virtual ~Lock() = default;
  };
  virtual ~Disk() = default;
  // False: there is none. `problem`: why it cannot be read, or "".
  virtual bool read(const std::string& path, size_t most, std::string& bytes, std::string& problem) = 0;
  // As replaceDiskFile.
  virtual bool replace(const std::string& path, std::span<const uint8_t> bytes, std::string& error) = 0;
  // As lockDiskFile. Null: `error` says why, or it is "" if another process has it. `made`: there was no file before.
  virtual std::unique_ptr<Lock> lock(const std::string& path, bool& made, std::string& error) = 0;
};
Disk& systemDisk() noexcept;
// Keeps other processes, and other users in this one, from locking the same file for as long as it is open; a crash
// frees it too. The file is made where there is none, and stays.
DiskLock lockDiskFile(const std::string& path);

// The memory of a loaded library in the process: its tables may only point into it.

class MappedFile {
public:
  // Of dlopen; empty where the system does not say where it lies.
  explicit MappedFile(void* library);
  // Of one span of memory, for tests.
  MappedFile(const void* begin, uint64_t bytes, bool isCode);

  bool holds(const void* address, uint64_t bytes) const noexcept { return segmentOf(address, bytes) != nullptr; }
  bool holdsCode(const void* address) const noexcept;
  // Ended by 0.
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

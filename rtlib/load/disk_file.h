// Files that a power failure must not damage and another process must not share. Blocks: not for the scan thread.
#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "rtlib/load/file.h"

namespace rung::runtime {

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

// Where such files are. A test has one in memory, which is full, or loses its power, when the test says so.
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
  // As lockDiskFile. Null: `error` says why, or it is "" where somebody else has it. `made`: there was no file before.
  virtual std::unique_ptr<Lock> lock(const std::string& path, bool& made, std::string& error) = 0;
};
Disk& systemDisk() noexcept;
// Keeps other processes, and other users in this one, from locking the same file for as long as it is open; a crash
// frees it too. The file is made where there is none, and stays.
DiskLock lockDiskFile(const std::string& path);

} // namespace rung::runtime

// Files that a power failure must not damage and another process must not share. Blocks: not for the scan thread.
#pragma once
#include <cstdint>
#include <span>
#include <string>

#include "rtlib/host/file.h"

namespace rung::host {

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
// Keeps other processes, and other users in this one, from locking the same file for as long as it is open; a crash
// frees it too. The file is made where there is none, and stays.
DiskLock lockDiskFile(const std::string& path);

} // namespace rung::host

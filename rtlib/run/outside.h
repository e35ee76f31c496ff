// What a program's host uses of the machine: handed in, so that a test can have another one.
#pragma once
#include <chrono>
#include <optional>

#include "rtlib/load/disk_file.h"

namespace rung::runtime {

struct Outside {
  Disk* disk = &systemDisk();
  // How often a thread of its own looks whether retained memory is to be written; nothing: as the dialect needs it; 0:
  // RetainSaver has no thread.
  std::optional<std::chrono::milliseconds> savePeriod;
};

} // namespace rung::runtime

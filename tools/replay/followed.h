// The past of a program that still runs: its recording grows, and the oldest of it goes.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "tools/replay/growing_recording.h"
#include "tools/replay/past.h"

namespace rung::replay {

struct Followed {
  std::unique_ptr<GrowingRecording> files;
  std::unique_ptr<Past> past;

  // Takes what has been written since. Whether there was anything.
  bool take() {
    if (!files->take()) return false;
    past->grown();
    return true;
  }
};

// What is kept in memory of a machine that is followed.
inline constexpr RecordingLimits kFollowedLimits{.bytes = uint64_t{64} << 20, .us = 600'000'000};

// The position is the newest scan. Fails as GrowingRecording::open and Past::open do.
Result<Followed> follow(const std::string& path, std::vector<std::shared_ptr<const compiler::Compiled>> known = {});

} // namespace rung::replay

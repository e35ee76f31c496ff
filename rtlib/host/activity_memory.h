// What rt::Activity needs for one instance of a program, made of the program's tables. Allocates when it is made.
#pragma once
#include <cstdint>
#include <vector>

#include "rtlib/core/activity.h"
#include "rung/program.h"

namespace rung::host {

class ActivityMemory {
public:
  // Of a program without such tables there is nothing in it.
  explicit ActivityMemory(const rung_program& program);

  rt::Activity make() noexcept;

private:
  void findLines(const std::vector<bool>& lines);
  void findWatchers(const rung_program& program, const std::vector<uint32_t>& lineAt);
  void findWritten(const rung_program& program, const std::vector<uint32_t>& lineAt);

  uint32_t task_ = RUNG_NONE;
  std::vector<rt::ActivityStretch> stretches_;
  std::vector<uint32_t> lineOffsets_;
  std::vector<uint32_t> firstWatcher_;
  std::vector<uint32_t> watchers_;
  std::vector<uint32_t> firstWritten_;
  std::vector<uint32_t> writtenLines_;
  std::vector<uint8_t> mayRest_;
  std::vector<rt::Rest> rests_;
  std::vector<uint8_t> copy_;
};

} // namespace rung::host

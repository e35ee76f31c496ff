// Comparing, waking and resting (see activity.h).
#include "rtlib/core/activity.h"

#include <array>
#include <cstring>

namespace rung::rt {
namespace {

constexpr uint32_t kAtOnce = 4;       // lines
constexpr uint32_t kMostRan = 60;     // per cent of the chunks; when more ran, comparing does not pay
constexpr uint32_t kRunsWithout = 31; // runs without comparing, then

template <uint32_t Bytes>
bool same(const uint8_t* a, const uint8_t* b) noexcept {
  std::array<uint64_t, Bytes / 8> here, there;
  std::memcpy(&here, a, sizeof here);
  std::memcpy(&there, b, sizeof there);
  uint64_t different = 0;
  for (size_t i = 0; i < here.size(); ++i) different |= here[i] ^ there[i];
  return different == 0;
}

} // namespace

void Activity::forget() noexcept {
  for (Rest& rest : tables_.rests) rest = {};
  without_ = 0;
}

bool Activity::looks() noexcept {
  if (without_ == 0) return true;
  --without_;
  return false;
}

// True: the line differed from the copy. The copy is updated, and the chunks that watch the changed bytes are awake.
bool Activity::take(const uint8_t* memory, uint32_t line) noexcept {
  const uint8_t* const now = memory + tables_.lineOffsets[line];
  uint8_t* const before = tables_.copy.data() + size_t{line} * kActivityLine;
  if (same<kActivityLine>(now, before)) return false;
  for (uint32_t i = 0; i < kActivityLine; ++i) {
    if (now[i] == before[i]) continue;
    before[i] = now[i];
    const uint32_t byte = line * kActivityLine + i;
    for (uint32_t w = tables_.firstWatcher[byte]; w < tables_.firstWatcher[byte + 1]; ++w)
      tables_.rests[tables_.watchers[w]].rests = 0;
  }
  return true;
}

void Activity::begin(const uint8_t* memory) noexcept {
  for (const ActivityStretch& stretch : tables_.stretches) {
    uint32_t line = stretch.firstLine;
    const uint32_t end = line + stretch.lineCount;
    const uint8_t* now = memory + stretch.offset;
    const uint8_t* before = tables_.copy.data() + size_t{line} * kActivityLine;
    constexpr uint32_t kBytes = kAtOnce * kActivityLine;
    for (; line + kAtOnce <= end; line += kAtOnce, now += kBytes, before += kBytes) {
      if (same<kBytes>(now, before)) continue;
      for (uint32_t i = 0; i < kAtOnce; ++i) take(memory, line + i);
    }
    for (; line < end; ++line) take(memory, line);
  }
  passed_ = ran_ = 0;
}

void Activity::ran(const uint8_t* memory, uint32_t chunk, uint32_t next, uint32_t weight) noexcept {
  ++ran_;
  bool changed = false;
  const uint32_t end = tables_.firstWritten[chunk + 1];
  for (uint32_t w = tables_.firstWritten[chunk]; w < end; ++w) changed |= take(memory, tables_.writtenLines[w]);
  if (!changed && tables_.mayRest[chunk] != 0) tables_.rests[chunk] = {next, weight, 1};
}

void Activity::end() noexcept {
  if (uint64_t{ran_} * 100 > uint64_t{passed_} * kMostRan) without_ = kRunsWithout;
}

} // namespace rung::rt

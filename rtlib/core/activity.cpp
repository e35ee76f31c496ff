// Comparing, waking and resting (see activity.h).
#include "rtlib/core/activity.h"

#include <algorithm>
#include <cstring>

namespace rung::rt {
namespace {

// In weights of chunks, whose unit is about that of an instruction.
constexpr uint64_t kLineCost = 3;        // of comparing a line among many
constexpr uint64_t kFindCost = 60;       // of finding one that differs among them
constexpr uint64_t kChunkCost = 120;     // of looking at a chunk that ran
constexpr uint64_t kWrittenLineCost = 9; // and at a line that it may have written
constexpr uint64_t kByteCost = 30;       // of one that differs
constexpr uint64_t kWakeCost = 8;        // of a word of chunks that it wakes
constexpr uint64_t kMoveCost = 12;       // of moving a number on
constexpr uint64_t kMostGained = 8; // times what a look costs: how long looking continues when it does not pay any more
constexpr uint32_t kWord = 8;       // bytes
constexpr uint32_t kFirstPause = 31;
constexpr uint32_t kLongestPause = 511; // runs; what comes to rest during them is found late

// GCC's and clang's, on every processor.
using Vector = uint64_t __attribute__((vector_size(kActivityLine), may_alias));

template <uint32_t Lines>
Vector difference(const uint8_t* memory, const uint8_t* copy) noexcept {
  Vector different{};
  for (uint32_t i = 0; i < Lines; ++i)
    different |= *reinterpret_cast<const Vector*>(memory + size_t{i} * kActivityLine) ^
                 *reinterpret_cast<const Vector*>(copy + size_t{i} * kActivityLine);
  return different;
}

bool isZero(Vector vector) noexcept { return (vector[0] | vector[1]) == 0; }

template <uint32_t Lines>
bool same(const uint8_t* memory, const uint8_t* copy) noexcept {
  return isZero(difference<Lines>(memory, copy));
}

constexpr bool kLittleEndian = std::endian::native == std::endian::little;

// Of a word that is not 0, in the order of memory.
int firstByte(uint64_t word) noexcept { return (kLittleEndian ? std::countr_zero(word) : std::countl_zero(word)) / 8; }
uint64_t byteMask(int byte) noexcept { return uint64_t{0xFF} << 8 * (kLittleEndian ? byte : 7 - byte); }

} // namespace

void Activity::forget() noexcept {
  std::ranges::fill(tables_.passed, 0);
  std::ranges::fill(tables_.turned, 0);
  timers_.forget();
  copied_ = false;
  gained_ = 0;
  without_ = 0;
  pause_ = kFirstPause;
}

bool Activity::looks() noexcept {
  if (without_ == 0) return true;
  --without_;
  return false;
}

void Activity::wakeAll(uint8_t* memory) noexcept {
  std::ranges::fill(tables_.passed, 0);
  std::ranges::fill(tables_.turned, 0);
  timers_.wakeAll(memory, tables_.copy.data(), passed_);
  if (copied_) relayed_.end(memory, tables_.copy.data(), passed_);
  copied_ = false;
}

void Activity::wakeChunks(uint8_t* memory, const ChunkBits& chunks) noexcept {
  tables_.passed[chunks.word] &= ~chunks.bits;
  tables_.turned[chunks.word] &= ~chunks.bits;
  timers_.wake(memory, tables_.copy.data(), chunks, passed_);
}

// Those who watch the byte, counted over all lines.
void Activity::wakeWatchers(uint8_t* memory, uint32_t byte) noexcept {
  const uint32_t first = tables_.firstWatcher[byte];
  const uint32_t end = tables_.firstWatcher[byte + 1];
  waking_ += kByteCost + (end - first) * kWakeCost;
  for (const ChunkBits& chunks : tables_.watchers.subspan(first, end - first)) wakeChunks(memory, chunks);
}

// The line differs: the copy is updated, and the chunks that watch the changed bytes are awake.
void Activity::takeLine(uint8_t* memory, uint32_t offset) noexcept {
  const uint32_t line = tables_.lineNumbers[offset / kActivityLine];
  for (uint32_t at = 0; at < kActivityLine; at += kWord) {
    uint64_t here, there;
    std::memcpy(&here, memory + offset + at, kWord);
    std::memcpy(&there, &tables_.copy[offset + at], kWord);
    std::memcpy(&tables_.copy[offset + at], &here, kWord);
    for (uint64_t different = here ^ there; different != 0;) {
      const int first = firstByte(different);
      different &= ~byteMask(first);
      wakeWatchers(memory, line * kActivityLine + at + static_cast<uint32_t>(first));
    }
  }
  if (waking_ > tables_.mostWaking) wakeAll(memory);
}

// From `offset` to `end`, as far as there are so many at a time. Gives where the next ones begin.
template <uint32_t Lines>
uint32_t Activity::takeLines(uint8_t* memory, uint32_t offset, uint32_t end) noexcept {
  const uint8_t* const copy = tables_.copy.data();
  constexpr uint32_t kSize = Lines * kActivityLine;
  for (; offset + kSize <= end && copied_; offset += kSize) {
    if (same<Lines>(memory + offset, copy + offset)) continue;
    if constexpr (Lines == 1) {
      comparing_ += kFindCost;
      takeLine(memory, offset);
    } else {
      takeLines<Lines / 4>(memory, offset, offset + kSize);
    }
  }
  return offset;
}

void Activity::begin(uint8_t* memory) noexcept {
  passed_ = 0;
  comparing_ = waking_ = left_ = 0;
  const bool copies = !copied_;
  looked_ = copies ? 0 : looked_ + 1;
  learns_ = copies;
  for (const ActivityStretch& stretch : tables_.stretches) {
    comparing_ += stretch.size / kActivityLine * kLineCost;
    if (copies) {
      std::memcpy(tables_.copy.data() + stretch.offset, memory + stretch.offset, stretch.size);
    } else {
      const uint32_t end = stretch.offset + stretch.size;
      const uint32_t few = takeLines<16>(memory, stretch.offset, end);
      takeLines<1>(memory, takeLines<4>(memory, few, end), end);
    }
  }
  copied_ = copied_ || copies;
  if (copied_) relayed_.begin(memory, [&](const ChunkBits& chunk) { wakeChunks(memory, chunk); });
}

void Activity::pass(uint32_t chunk) noexcept {
  if (chunk >= tables_.firstOfEntry && chunk < tables_.endOfEntry) passed_ = chunk;
}

void Activity::reach(uint8_t* memory, uint32_t chunk) noexcept {
  pass(chunk);
  if (copied_ && (tables_.properties[chunk] & kRelays) != 0) relayed_.reach(memory, chunk);
}

void Activity::ran(uint8_t* memory, uint32_t chunk, uint32_t next, uint32_t weight) noexcept {
  if (!copied_) return;
  uint8_t* const copy = tables_.copy.data();
  const uint8_t properties = tables_.properties[chunk];
  if ((properties & kRelays) != 0)
    relayed_.ran(memory, copy, chunk, [&](const ChunkBits& waking) { wakeChunks(memory, waking); });
  const bool hasTimers = (properties & kHasTimers) != 0;
  const uint64_t moved = hasTimers ? timers_.take(memory, copy, chunk) : 0;
  const uint32_t first = tables_.firstWritten[chunk];
  const std::span<const uint32_t> lines = tables_.writtenLines.subspan(first, tables_.firstWritten[chunk + 1] - first);
  comparing_ += kChunkCost + lines.size() * kWrittenLineCost;
  Vector different{};
  for (const uint32_t line : lines) different |= difference<1>(memory + line, copy + line);
  if (!isZero(different)) {
    for (const uint32_t line : lines)
      if (!same<1>(memory + line, copy + line)) takeLine(memory, line);
    return;
  }
  if ((properties & kMayRest) == 0 || (hasTimers && !timers_.settle(memory, chunk, moved))) return;
  if (moved != 0 && looked_ == 1) learns_ = true;
  tables_.rests[chunk] = {next, weight};
  const std::span<uint64_t> bits = next == chunk + 1 ? tables_.passed : tables_.turned;
  const auto [word, bit] = bitOf(chunk);
  bits[word] |= bit;
}

void Activity::end(uint8_t* memory, bool completed) noexcept {
  const uint32_t end = completed ? UINT32_MAX : passed_;
  if (copied_) relayed_.end(memory, tables_.copy.data(), end);
  passed_ = 0; // what is woken from now on has been moved on
  comparing_ += kMoveCost * timers_.end(memory, tables_.copy.data(), end,
                                        [&](const ChunkBits& chunk) { wakeChunks(memory, chunk); });
  if (!learns_ || !copied_) {
    const uint64_t cost = comparing_ + waking_;
    const auto gain = static_cast<int64_t>(left_ * tables_.meanWeight - cost);
    gained_ = std::min(gained_ + gain, static_cast<int64_t>(kMostGained * cost));
  }
  if (gained_ >= 0) return;
  gained_ = 0;
  wakeAll(memory);
  without_ = pause_;
  pause_ = std::min(2 * pause_ + 1, kLongestPause);
}

void Activity::stop(uint8_t* memory, uint32_t chunk) noexcept {
  pass(chunk);
  end(memory, false);
}

} // namespace rung::rt

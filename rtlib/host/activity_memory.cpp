// From spans of chunks to lines and watchers (see activity_memory.h).
#include "rtlib/host/activity_memory.h"

#include <algorithm>
#include <numeric>
#include <span>

namespace rung::host {
namespace {

using rt::kActivityLine;

std::span<const rung_span> touched(const rung_program& program, uint32_t chunk) {
  const rung_activity& activity = program.activity[chunk];
  return {program.activity_spans + activity.touched_first, activity.touched_count};
}

std::span<const rung_span> written(const rung_program& program, uint32_t chunk) {
  const rung_activity& activity = program.activity[chunk];
  return {program.activity_spans + activity.written_first, activity.written_count};
}

template <class Visit>
void forLines(std::span<const rung_span> spans, Visit visit) {
  uint32_t done = 0; // lines below it; two spans may lie in one line
  for (const rung_span& span : spans) {
    const uint32_t end = (span.offset + span.size + kActivityLine - 1) / kActivityLine;
    for (uint32_t line = std::max(done, span.offset / kActivityLine); line < end; ++line) visit(line);
    done = std::max(done, end);
  }
}

} // namespace

// Lines of the block are numbered from its beginning, lines that are watched as they come.
ActivityMemory::ActivityMemory(const rung_program& program) {
  if (program.activity_count == 0) return;
  task_ = program.main_task;
  std::vector<bool> lines(program.memory_size / kActivityLine);
  for (uint32_t chunk = 0; chunk < program.chunk_count; ++chunk)
    forLines(touched(program, chunk), [&](uint32_t line) { lines[line] = true; });
  findLines(lines);
  std::vector<uint32_t> lineAt(lines.size(), RUNG_NONE);
  for (uint32_t line = 0; line < lineOffsets_.size(); ++line) lineAt[lineOffsets_[line] / kActivityLine] = line;
  findWatchers(program, lineAt);
  findWritten(program, lineAt);
  for (uint32_t chunk = 0; chunk < program.chunk_count; ++chunk)
    mayRest_.push_back(program.activity[chunk].touched_count != 0 ? 1 : 0);
  rests_.resize(program.chunk_count);
  copy_.resize(lineOffsets_.size() * kActivityLine);
}

void ActivityMemory::findLines(const std::vector<bool>& lines) {
  for (uint32_t line = 0; line < lines.size(); ++line) {
    if (!lines[line]) continue;
    const auto number = static_cast<uint32_t>(lineOffsets_.size());
    if (line == 0 || !lines[line - 1]) stretches_.push_back({line * kActivityLine, number, 0});
    ++stretches_.back().lineCount;
    lineOffsets_.push_back(line * kActivityLine);
  }
}

void ActivityMemory::findWatchers(const rung_program& program, const std::vector<uint32_t>& lineAt) {
  const auto forBytes = [&](uint32_t chunk, const auto& visit) {
    for (const rung_span& span : touched(program, chunk))
      for (uint32_t at = span.offset; at < span.offset + span.size; ++at)
        visit(lineAt[at / kActivityLine] * kActivityLine + at % kActivityLine);
  };
  firstWatcher_.assign(lineOffsets_.size() * kActivityLine + 1, 0);
  for (uint32_t chunk = 0; chunk < program.chunk_count; ++chunk)
    forBytes(chunk, [&](uint32_t byte) { ++firstWatcher_[byte + 1]; });
  std::partial_sum(firstWatcher_.begin(), firstWatcher_.end(), firstWatcher_.begin());
  watchers_.resize(firstWatcher_.back());
  std::vector<uint32_t> next(firstWatcher_.begin(), firstWatcher_.end() - 1);
  for (uint32_t chunk = 0; chunk < program.chunk_count; ++chunk)
    forBytes(chunk, [&](uint32_t byte) { watchers_[next[byte]++] = chunk; });
}

void ActivityMemory::findWritten(const rung_program& program, const std::vector<uint32_t>& lineAt) {
  firstWritten_.push_back(0);
  for (uint32_t chunk = 0; chunk < program.chunk_count; ++chunk) {
    forLines(written(program, chunk), [&](uint32_t line) {
      if (lineAt[line] != RUNG_NONE) writtenLines_.push_back(lineAt[line]);
    });
    firstWritten_.push_back(static_cast<uint32_t>(writtenLines_.size()));
  }
}

rt::Activity ActivityMemory::make() noexcept {
  if (rests_.empty()) return {};
  return rt::Activity({.task = task_,
                       .stretches = stretches_,
                       .lineOffsets = lineOffsets_,
                       .firstWatcher = firstWatcher_,
                       .watchers = watchers_,
                       .firstWritten = firstWritten_,
                       .writtenLines = writtenLines_,
                       .mayRest = mayRest_,
                       .rests = rests_,
                       .copy = copy_});
}

} // namespace rung::host

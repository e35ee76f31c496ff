// From spans of chunks to lines and watchers (see activity_memory.h).
#include "rtlib/host/activity_memory.h"

#include <algorithm>

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

// Turns the number of entries of each list into the index where it begins, in one array that holds all lists; gives
// their sum.
uint32_t begins(std::span<uint32_t> first) {
  uint32_t sum = 0;
  for (uint32_t& entry : first) {
    const uint32_t count = entry;
    entry = sum;
    sum += count;
  }
  return sum;
}

} // namespace

ActivityMemory::ActivityMemory(const rung_program& program) {
  if (program.activity_count == 0) return;
  task_ = program.main_task;
  findLines(program);
  findWatchers(program);
  findWritten(program);
  mayRest_.make(program.chunk_count);
  for (uint32_t chunk = 0; chunk < program.chunk_count; ++chunk)
    mayRest_[chunk] = program.activity[chunk].touched_count != 0 ? 1 : 0;
  rests_.make(program.chunk_count);
  copy_.make(lineOffsets_.size * kActivityLine);
}

void ActivityMemory::findLines(const rung_program& program) {
  lineAt_.make(program.memory_size / kActivityLine);
  std::ranges::fill(lineAt_.all(), RUNG_NONE);
  uint32_t count = 0;
  for (uint32_t chunk = 0; chunk < program.chunk_count; ++chunk)
    forLines(touched(program, chunk), [&](uint32_t line) {
      if (lineAt_[line] == RUNG_NONE) ++count;
      lineAt_[line] = 0;
    });
  lineOffsets_.make(count);
  stretches_.make(count); // at most
  stretches_.size = 0;
  uint32_t number = 0;
  for (uint32_t line = 0; line < lineAt_.size; ++line) {
    if (lineAt_[line] == RUNG_NONE) continue;
    if (line == 0 || lineAt_[line - 1] == RUNG_NONE) stretches_[stretches_.size++] = {line * kActivityLine, number, 0};
    ++stretches_[stretches_.size - 1].lineCount;
    lineOffsets_[number] = line * kActivityLine;
    lineAt_[line] = number++;
  }
}

void ActivityMemory::findWatchers(const rung_program& program) {
  const auto forBytes = [&](uint32_t chunk, const auto& visit) {
    for (const rung_span& span : touched(program, chunk))
      for (uint32_t at = span.offset; at < span.offset + span.size; ++at)
        visit(lineAt_[at / kActivityLine] * kActivityLine + at % kActivityLine);
  };
  const uint32_t bytes = lineOffsets_.size * kActivityLine;
  firstWatcher_.make(bytes + 1);
  for (uint32_t chunk = 0; chunk < program.chunk_count; ++chunk)
    forBytes(chunk, [&](uint32_t byte) { ++firstWatcher_[byte]; });
  watchers_.make(begins(firstWatcher_.all()));
  Numbers next;
  next.make(bytes);
  std::ranges::copy(firstWatcher_.all().first(bytes), next.items.get());
  for (uint32_t chunk = 0; chunk < program.chunk_count; ++chunk)
    forBytes(chunk, [&](uint32_t byte) { watchers_[next[byte]++] = chunk; });
}

void ActivityMemory::findWritten(const rung_program& program) {
  firstWritten_.make(program.chunk_count + 1);
  for (uint32_t chunk = 0; chunk < program.chunk_count; ++chunk)
    forLines(written(program, chunk),
             [&](uint32_t line) { firstWritten_[chunk] += lineAt_[line] != RUNG_NONE ? 1 : 0; });
  writtenLines_.make(begins(firstWritten_.all()));
  uint32_t next = 0;
  for (uint32_t chunk = 0; chunk < program.chunk_count; ++chunk)
    forLines(written(program, chunk), [&](uint32_t line) {
      if (lineAt_[line] != RUNG_NONE) writtenLines_[next++] = lineAt_[line];
    });
}

rt::Activity ActivityMemory::make() noexcept {
  if (rests_.size == 0) return {};
  return rt::Activity({.task = task_,
                       .stretches = stretches_.all(),
                       .lineOffsets = lineOffsets_.all(),
                       .firstWatcher = firstWatcher_.all(),
                       .watchers = watchers_.all(),
                       .firstWritten = firstWritten_.all(),
                       .writtenLines = writtenLines_.all(),
                       .mayRest = mayRest_.all(),
                       .rests = rests_.all(),
                       .copy = copy_.all()});
}

} // namespace rung::host

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

// What a chunk must be awake for: nothing where it always runs.
std::span<const rung_span> watched(const rung_program& program, uint32_t chunk) {
  return program.activity[chunk].may_rest != 0 ? touched(program, chunk) : std::span<const rung_span>{};
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

template <class Visit>
void forEachByte(std::span<const rung_span> spans, Visit visit) {
  for (const rung_span& span : spans)
    for (uint32_t at = span.offset; at < span.offset + span.size; ++at) visit(at);
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
  findRelayed(program);
  findLines(program);
  findWatchers(program);
  findWritten(program);
  findTimers(program);
  findProperties(program);
  rests_.make(program.chunk_count);
  passed_.make(program.chunk_count / rt::kChunkBits + 1);
  turned_.make(program.chunk_count / rt::kChunkBits + 1);
  for (uint32_t chunk = 0; chunk < program.chunk_count; ++chunk) weights_ += program.chunks[chunk].weight;
  copy_.make(program.memory_size);
}

// Those that several chunks write, where each run comes to all that may touch them exactly once. Not those that go back
// where they are marked: who writes such a byte has to run, for its mark, when somebody else has written it. And not
// what computed addresses reach, which is too much to follow.
void ActivityMemory::findRelayed(const rung_program& program) {
  constexpr uint32_t kMostRelayed = 64;    // each costs a little in every run; the others keep their chunks awake
  constexpr uint32_t kMostTogether = 1024; // bytes side by side that one chunk touches
  relayedAt_.make(program.memory_size);
  std::ranges::fill(relayedAt_.all(), RUNG_NONE);
  firstOfChunk_.make(program.chunk_count + 1);
  const std::span<const rung_activity> chunks(program.activity, program.activity_count);
  if (std::ranges::any_of(chunks, [](const rung_activity& a) { return a.asks_host != 0 && a.once == 0; })) return;

  Array<uint8_t> writers; // by byte: 0, 1, more
  Array<uint8_t> excluded;
  writers.make(program.memory_size);
  excluded.make(program.memory_size);
  const auto exclude = [&](std::span<const rung_span> spans) {
    forEachByte(spans, [&](uint32_t at) { excluded[at] = 1; });
  };
  for (uint32_t chunk = 0; chunk < program.chunk_count; ++chunk) {
    forEachByte(written(program, chunk), [&](uint32_t at) { writers[at] = writers[at] == 0 ? 1 : 2; });
    if (chunks[chunk].once == 0) exclude(touched(program, chunk));
    for (const rung_span& span : touched(program, chunk))
      if (span.size > kMostTogether) exclude({&span, 1});
  }
  for (const rung_copy& copy : std::span(program.copies, program.copy_count)) {
    const rung_span from{copy.from, copy.size};
    if (copy.kind == RUNG_COPY_MASKED) exclude({&from, 1});
  }
  relayedBytes_.make(kMostRelayed);
  relayedBytes_.size = 0;
  for (uint32_t at = 0; at < program.memory_size && relayedBytes_.size < kMostRelayed; ++at) {
    if (writers[at] < 2 || excluded[at] != 0) continue;
    relayedAt_[at] = relayedBytes_.size;
    relayedBytes_[relayedBytes_.size++].offset = at;
  }

  // Whoever asks the host touches all of them.
  const auto forMembers = [&](uint32_t chunk, const auto& visit) {
    if (chunks[chunk].asks_host != 0) {
      for (uint32_t byte = 0; byte < relayedBytes_.size; ++byte) visit(byte);
    } else {
      forEachByte(touched(program, chunk), [&](uint32_t at) {
        if (isRelayed(at)) visit(relayedAt_[at]);
      });
    }
  };
  for (uint32_t chunk = 0; chunk < program.chunk_count; ++chunk)
    forMembers(chunk, [&](uint32_t byte) {
      ++relayedBytes_[byte].endMember;
      ++firstOfChunk_[chunk];
    });
  ofChunk_.make(begins(firstOfChunk_.all()));
  members_.make(ofChunk_.size);
  uint32_t first = 0;
  for (rt::RelayedByte& byte : relayedBytes_.all()) {
    const uint32_t count = byte.endMember;
    byte.firstMember = byte.endMember = first;
    first += count;
  }
  uint32_t next = 0;
  for (uint32_t chunk = 0; chunk < program.chunk_count; ++chunk)
    forMembers(chunk, [&](uint32_t byte) {
      ofChunk_[next++] = relayedBytes_[byte].endMember;
      members_[relayedBytes_[byte].endMember++] = {.chunk = chunk, .byte = byte};
    });
}

// Short gaps between lines are compared, too: nobody watches them.
void ActivityMemory::findLines(const rung_program& program) {
  constexpr uint32_t kGap = 8; // lines
  lineNumbers_.make(program.memory_size / kActivityLine);
  std::ranges::fill(lineNumbers_.all(), RUNG_NONE);
  for (uint32_t chunk = 0; chunk < program.chunk_count; ++chunk)
    forLines(watched(program, chunk), [&](uint32_t line) { lineNumbers_[line] = 0; });
  stretches_.make(lineNumbers_.size); // at most
  stretches_.size = 0;
  uint32_t end = 0; // of the last stretch
  for (uint32_t line = 0; line < lineNumbers_.size; ++line) {
    if (lineNumbers_[line] == RUNG_NONE) continue;
    if (stretches_.size == 0 || line > end + kGap)
      stretches_[stretches_.size++] = {line * kActivityLine, 0};
    else
      for (; end < line; ++end) lineNumbers_[end] = lineCount_++;
    lineNumbers_[line] = lineCount_++;
    end = line + 1;
    rt::ActivityStretch& stretch = stretches_[stretches_.size - 1];
    stretch.size = end * kActivityLine - stretch.offset;
  }
}

// Chunks come in ascending order, so those of one word follow one another.
void ActivityMemory::findWatchers(const rung_program& program) {
  const auto forBytes = [&](uint32_t chunk, const auto& visit) {
    forEachByte(watched(program, chunk), [&](uint32_t at) {
      if (!isRelayed(at)) visit(lineNumbers_[at / kActivityLine] * kActivityLine + at % kActivityLine);
    });
  };
  const uint32_t bytes = lineCount_ * kActivityLine;
  Numbers lastWord;
  lastWord.make(bytes);
  std::ranges::fill(lastWord.all(), RUNG_NONE);
  firstWatcher_.make(bytes + 1);
  for (uint32_t chunk = 0; chunk < program.chunk_count; ++chunk)
    forBytes(chunk, [&](uint32_t byte) {
      const uint32_t word = chunk / rt::kChunkBits;
      if (lastWord[byte] != word) ++firstWatcher_[byte];
      lastWord[byte] = word;
    });
  watchers_.make(begins(firstWatcher_.all()));
  Numbers next;
  next.make(bytes);
  std::ranges::copy(firstWatcher_.all().first(bytes), next.items.get());
  for (uint32_t chunk = 0; chunk < program.chunk_count; ++chunk)
    forBytes(chunk, [&](uint32_t byte) {
      const uint32_t word = chunk / rt::kChunkBits;
      const bool isNew = next[byte] == firstWatcher_[byte] || watchers_[next[byte] - 1].word != word;
      if (isNew) watchers_[next[byte]++] = {word, 0};
      watchers_[next[byte] - 1].bits |= uint64_t{1} << chunk % rt::kChunkBits;
    });
}

void ActivityMemory::findWritten(const rung_program& program) {
  firstWritten_.make(program.chunk_count + 1);
  for (uint32_t chunk = 0; chunk < program.chunk_count; ++chunk)
    forLines(written(program, chunk),
             [&](uint32_t line) { firstWritten_[chunk] += lineNumbers_[line] != RUNG_NONE ? 1 : 0; });
  writtenLines_.make(begins(firstWritten_.all()));
  uint32_t next = 0;
  for (uint32_t chunk = 0; chunk < program.chunk_count; ++chunk)
    forLines(written(program, chunk), [&](uint32_t line) {
      if (lineNumbers_[line] != RUNG_NONE) writtenLines_[next++] = line * kActivityLine;
    });
}

void ActivityMemory::findTimers(const rung_program& program) {
  const uint32_t words = program.chunk_count / rt::kChunkBits + 1;
  numbers_.make(program.timer_count);
  chunkTimers_.make(program.chunk_count);
  onlyMoved_.make(words);
  moving_.make(words);
  starting_.make(words);
  timers_ = {.chunks = {program.activity, program.activity_count},
             .timers = {program.timers, program.timer_count},
             .numbers = numbers_.all(),
             .states = chunkTimers_.all(),
             .onlyMoved = onlyMoved_.all(),
             .moving = moving_.all(),
             .starting = starting_.all()};
}

// The chunks of a routine follow one another. Timers matter of chunks that may rest.
void ActivityMemory::findProperties(const rung_program& program) {
  properties_.make(program.chunk_count);
  for (uint32_t chunk = 0; chunk < program.chunk_count; ++chunk) {
    const rung_activity& activity = program.activity[chunk];
    const bool rests = activity.may_rest != 0;
    const bool relays = firstOfChunk_[chunk + 1] != firstOfChunk_[chunk];
    properties_[chunk] = static_cast<uint8_t>((rests ? rt::kMayRest : 0) | (relays ? rt::kRelays : 0) |
                                              (rests && activity.timer_count != 0 ? rt::kHasTimers : 0));
    if (activity.of_entry == 0) continue;
    if (endOfEntry_ == 0) firstOfEntry_ = chunk;
    endOfEntry_ = chunk + 1;
  }
}

rt::Activity ActivityMemory::make() noexcept {
  if (rests_.size == 0) return {};
  constexpr uint64_t kWakingPart = 8; // of what the chunks do, which waking may cost
  return rt::Activity({.task = task_,
                       .stretches = stretches_.all(),
                       .lineNumbers = lineNumbers_.all(),
                       .firstWatcher = firstWatcher_.all(),
                       .watchers = watchers_.all(),
                       .firstWritten = firstWritten_.all(),
                       .writtenLines = writtenLines_.all(),
                       .properties = properties_.all(),
                       .meanWeight = weights_ / rests_.size,
                       .mostWaking = weights_ / kWakingPart,
                       .rests = rests_.all(),
                       .passed = passed_.all(),
                       .turned = turned_.all(),
                       .copy = copy_.all(),
                       .firstOfEntry = firstOfEntry_,
                       .endOfEntry = endOfEntry_,
                       .relayed = {relayedBytes_.all(), members_.all(), firstOfChunk_.all(), ofChunk_.all()},
                       .timers = timers_});
}

} // namespace rung::host

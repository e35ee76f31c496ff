// Determines the footprint of a program, and reads it (see footprint.h).
#include "rtlib/run/footprint.h"

#include <algorithm>
#include <link.h>

#include "rtlib/run/realtime.h"

namespace rung::runtime {
namespace {

// ---- the memory block ----

struct Part {
  uint32_t first;
  uint32_t end; // one past the last
};

// Parts of a block of `size` bytes.
class Parts {
public:
  explicit Parts(uint32_t size) : size_(size) {}
  void add(uint32_t offset, uint32_t bytes) {
    if (bytes == 0 || offset >= size_) return;
    const uint32_t last = std::min(bytes, size_ - offset) - 1 + offset;
    parts_.push_back({offset / Footprint::kLine, last / Footprint::kLine + 1});
  }
  std::vector<rung_span> joined() {
    std::ranges::sort(parts_, {}, &Part::first);
    std::vector<rung_span> spans;
    for (const Part& part : parts_) {
      const uint32_t first = part.first * Footprint::kLine;
      const uint32_t end = std::min<uint64_t>(uint64_t{part.end} * Footprint::kLine, size_);
      if (spans.empty() || first > spans.back().offset + spans.back().size)
        spans.push_back({first, end - first});
      else
        spans.back().size = std::max(spans.back().size, end - spans.back().offset);
    }
    return spans;
  }

private:
  uint32_t size_;
  std::vector<Part> parts_; // in lines
};

// Bytes outside all spaces belong to the compiler: states of instructions, registers.
void addOwnState(const rung_program& program, Parts& parts) {
  std::vector<Part> ranges;
  for (const rung_space& space : std::span(program.spaces, program.space_count))
    for (const rung_range& range : std::span(space.ranges, space.range_count)) {
      const uint32_t width = range.repr == RUNG_REPR_BYTE_PER_BIT ? 8 : 1;
      ranges.push_back({range.offset, range.offset + range.byte_count * width});
    }
  std::ranges::sort(ranges, {}, &Part::first);
  uint32_t end = 0;
  for (const Part& range : ranges) {
    if (range.first > end) parts.add(end, range.first - end);
    end = std::max(end, range.end);
  }
  if (end < program.memory_size) parts.add(end, program.memory_size - end);
}

void addCopies(const rung_program& program, Parts& parts) {
  for (const rung_copy& copy : std::span(program.copies, program.copy_count)) {
    parts.add(copy.from, copy.size);
    parts.add(copy.to, copy.size);
    if (copy.kind == RUNG_COPY_MASKED) parts.add(copy.mask, copy.size);
  }
}

std::vector<rung_span> memoryOf(const rung_program& program) {
  Parts parts(program.memory_size);
  for (const rung_span& read : std::span(program.reads, program.read_count)) parts.add(read.offset, read.size);
  for (const rung_written& written : std::span(program.writes, program.write_count))
    parts.add(written.offset, written.size);
  addCopies(program, parts);
  addOwnState(program, parts);
  return parts.joined();
}

// ---- tables and code ----

template <class Row>
std::span<const uint8_t> table(const Row* rows, uint32_t count) {
  return {reinterpret_cast<const uint8_t*>(rows), sizeof(Row) * count};
}

std::vector<std::span<const uint8_t>> tablesOf(const rung_program& program) {
  return {table(&program, 1),
          table(program.scan, program.scan_count),
          table(program.slices, program.slice_count),
          table(program.tasks, program.task_count),
          table(program.copies, program.copy_count),
          table(program.part_ends, program.part_end_count),
          table(program.changes, program.change_count),
          table(program.chunks, program.chunk_count),
          table(program.chunk_fns, program.chunk_count)};
}

struct Sought {
  uintptr_t address = 0;
  uintptr_t end = 0; // end of the segment that contains it; 0: none
};

int findSegment(dl_phdr_info* object, size_t, void* data) {
  auto& sought = *static_cast<Sought*>(data);
  for (const ElfW(Phdr) & segment : std::span(object->dlpi_phdr, object->dlpi_phnum)) {
    const uintptr_t first = object->dlpi_addr + segment.p_vaddr;
    const bool isCode = segment.p_type == PT_LOAD && (segment.p_flags & PF_X) != 0 && (segment.p_flags & PF_R) != 0;
    if (isCode && sought.address >= first && sought.address - first < segment.p_memsz)
      sought.end = first + segment.p_memsz;
  }
  return sought.end != 0 ? 1 : 0;
}

// The code of a shared object that contains only the program's code.
std::span<const uint8_t> codeOf(const rung_program& program) {
  if (program.chunk_count == 0) return {};
  const auto addressOf = [](rung_chunk_fn function) { return reinterpret_cast<uintptr_t>(function); };
  Sought sought{.address = addressOf(
                    *std::ranges::min_element(std::span(program.chunk_fns, program.chunk_count), {}, addressOf))};
  if (dl_iterate_phdr(&findSegment, &sought) == 0) return {};
  return {reinterpret_cast<const uint8_t*>(sought.address), sought.end - sought.address};
}

// ---- prefetching ----

class Prefetcher {
public:
  explicit Prefetcher(int64_t untilNs) noexcept : untilNs_(untilNs) {}
  // False: the time has run out.
  bool prefetch(std::span<const uint8_t> bytes) noexcept {
    const auto begin = reinterpret_cast<uintptr_t>(bytes.data());
    for (size_t at = 0; at < bytes.size(); at += Footprint::kLine - (begin + at) % Footprint::kLine) {
      if (lines_++ % kLinesALook == 0 && monotonicNs() >= untilNs_) return false;
      [[maybe_unused]] const uint8_t read = *static_cast<const volatile uint8_t*>(&bytes[at]);
    }
    return true;
  }

private:
  // Lines per clock reading, because processors complete all loads before they read the clock.
  static constexpr uint32_t kLinesALook = 32;
  int64_t untilNs_;
  uint32_t lines_ = 0;
};

} // namespace

Footprint::Footprint(const rung_program& program, bool inFile)
    : tables_(tablesOf(program)), memory_(memoryOf(program)) {
  if (inFile) code_ = codeOf(program);
}

// Reads in the order in which a scan needs the parts.
void Footprint::prefetch(const uint8_t* memory, int64_t untilNs) const noexcept {
  Prefetcher prefetcher(untilNs);
  for (const std::span<const uint8_t> table : tables_)
    if (!prefetcher.prefetch(table)) return;
  for (const rung_span& part : memory_)
    if (!prefetcher.prefetch({memory + part.offset, part.size})) return;
  prefetcher.prefetch(code_);
}

} // namespace rung::runtime

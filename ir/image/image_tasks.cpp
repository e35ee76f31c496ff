// Tasks, their copies, chunks and the schedule in a program's tables (see image_tables.h).
#include "ir/image/image_tables.h"

#include <algorithm>
#include <span>

#include "ir/analysis/longest_path.h"
#include "ir/shape/accesses.h"
#include "ir/support/check.h"
#include "rung/types.hpp"

namespace rung::ir {
namespace {

class TaskTables {
public:
  TaskTables(ImageTables& tables, const Layout& layout) : tables_(tables), layout_(layout), module_(layout.module()) {}

  void run() {
    addTasks();
    addChunks();
    addSteps(module_.scan, tables_.scan);
    addSteps(module_.fast, tables_.fast);
    addSteps(module_.slices, tables_.slices);
  }

private:
  void addTasks() {
    for (uint32_t i = 0; i < module_.tasks.size(); ++i) {
      const Task& task = module_.tasks[i];
      rung_task out{};
      out.name = tables_.text(task.name);
      out.entry = layout_.partition().entry(task.entry);
      out.period_us = task.periodUs;
      out.budget = task.budget;
      out.budget_fault = task.budgetFault.index;
      out.begin_first = static_cast<uint32_t>(tables_.copies.size());
      addCopies(task.begin);
      out.begin_count = static_cast<uint32_t>(tables_.copies.size()) - out.begin_first;
      out.end_first = static_cast<uint32_t>(tables_.copies.size());
      addCopies(task.end);
      out.end_count = static_cast<uint32_t>(tables_.copies.size()) - out.end_first;
      out.part_first = static_cast<uint32_t>(tables_.partEnds.size());
      const std::vector<uint32_t>& ends = layout_.partition().partEnds(TaskId{i});
      tables_.partEnds.insert(tables_.partEnds.end(), ends.begin(), ends.end());
      // A short program gives fewer borders than parts: the parts after the last border are empty.
      tables_.partEnds.insert(tables_.partEnds.end(), task.parts - ends.size(), RUNG_PC_DONE);
      out.part_count = task.parts;
      const LongestRun longest = longestRun(layout_.shape(), TaskId{i});
      out.longest = longest.weight;
      out.loops = longest.loops ? 1 : 0;
      out.loop_free_chunk = longest.straight.chunk;
      out.loop_free_weight = longest.straight.weight;
      append(readBytes(layout_.memory(), TaskId{i}), tables_.reads, out.read_first, out.read_count);
      if (!module_.instrumented) // what is measured changes its counters, too
        append(changedWords(layout_.memory(), TaskId{i}), tables_.changes, out.change_first, out.change_count);
      tables_.tasks.push_back(out);
    }
  }

  template <class T>
  static void append(const std::vector<T>& these, std::vector<T>& all, uint32_t& first, uint32_t& count) {
    first = static_cast<uint32_t>(all.size());
    count = static_cast<uint32_t>(these.size());
    all.insert(all.end(), these.begin(), these.end());
  }

  void addChunks() {
    for (const Chunk& chunk : layout_.partition().chunks())
      tables_.chunks.push_back(
          {layout_.partition().rungNumber(chunk.routine, chunk.firstRung), chunk.rungCount, chunk.weight});
  }

  void addSteps(const std::vector<Step>& steps, std::vector<rung_step>& out) {
    for (const Step& step : steps) out.push_back({step.op, step.task.index, step.arg});
  }

  void addCopies(const std::vector<Copy>& copies) {
    const size_t first = tables_.copies.size();
    for (const Copy& copy : copies) addCopy(copy);
    const std::span added(tables_.copies.begin() + static_cast<ptrdiff_t>(first), tables_.copies.end());
    if (!mayGoInAnyOrder(added)) return;
    std::ranges::sort(added, {}, &rung_copy::from);
    std::vector<rung_copy> joined;
    for (const rung_copy& copy : added) {
      rung_copy* last = joined.empty() ? nullptr : &joined.back();
      if (last != nullptr && last->from + last->size == copy.from && last->to + last->size == copy.to)
        last->size += copy.size;
      else
        joined.push_back(copy);
    }
    tables_.copies.resize(first);
    tables_.copies.insert(tables_.copies.end(), joined.begin(), joined.end());
  }

  // None writes what one reads, or another one writes.
  static bool mayGoInAnyOrder(std::span<const rung_copy> copies) {
    if (!std::ranges::all_of(copies, [](const rung_copy& copy) { return copy.kind == RUNG_COPY_ALL; })) return false;
    struct Range {
      uint32_t first;
      uint32_t end;
      bool isWritten;
    };
    std::vector<Range> ranges;
    for (const rung_copy& copy : copies) {
      ranges.push_back({copy.from, copy.from + copy.size, false});
      ranges.push_back({copy.to, copy.to + copy.size, true});
    }
    std::ranges::sort(ranges, {}, &Range::first);
    uint32_t end = 0, writtenEnd = 0; // of the ranges so far
    for (const Range& range : ranges) {
      if (range.first < (range.isWritten ? end : writtenEnd)) return false;
      end = std::max(end, range.end);
      if (range.isWritten) writtenEnd = std::max(writtenEnd, range.end);
    }
    return true;
  }

  // Connected bytes have one representation, but their ranges may be cut at different places.
  void addCopy(const Copy& copy) {
    for (uint32_t done = 0; done < copy.from.size;) {
      const uint32_t rest = copy.from.size - done;
      Piece from = piece(copy.from.space, copy.from.byte + done, rest);
      Piece to = piece(copy.to, copy.toByte + done, from.bytes);
      Piece mask = copy.masked ? piece(copy.mask, copy.maskByte + done, to.bytes) : to;
      RUNG_CHECK(from.scale == to.scale && to.scale == mask.scale, "a copy connects bytes of two representations");
      tables_.copies.push_back({copy.masked ? uint32_t{RUNG_COPY_MASKED} : uint32_t{RUNG_COPY_ALL}, from.offset,
                                to.offset, copy.masked ? mask.offset : 0, mask.bytes * mask.scale});
      done += mask.bytes;
    }
  }

  // As many logical bytes from `byte`, at most `size`, as lie together.
  struct Piece {
    uint32_t offset;
    uint32_t bytes;
    uint32_t scale;
  };
  Piece piece(SpaceId space, uint32_t byte, uint32_t size) {
    for (const rung_range& range : layout_.memory().space(space).ranges) {
      if (byte < range.first_byte || byte - range.first_byte >= range.byte_count) continue;
      const uint32_t scale = bytesPerByte(range.repr);
      const uint32_t into = byte - range.first_byte;
      return {range.offset + into * scale, std::min(size, range.byte_count - into), scale};
    }
    RUNG_CHECK(false, "copy outside its space");
    return {};
  }

  ImageTables& tables_;
  const Layout& layout_;
  const Module& module_;
};

} // namespace

void fillTaskTables(ImageTables& tables, const Layout& layout) { TaskTables(tables, layout).run(); }

} // namespace rung::ir

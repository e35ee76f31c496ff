// Hand-made programs: tables in vectors, chunk functions as captureless lambdas. link() makes the rung_program.
#pragma once
#include <algorithm>
#include <cstring>
#include <deque>
#include <string>
#include <string_view>
#include <vector>

#include "rung/program.h"

namespace rung::test {

// Return to the caller, as generated code does it.
inline uint32_t popChunk(rung_ctx* ctx) { return ctx->stack[--ctx->sp]; }
inline uint32_t callChunk(rung_ctx* ctx, uint32_t callee, uint32_t back) {
  ctx->stack[ctx->sp++] = back;
  return callee;
}

struct TestProgram {
  std::string dialect = "test";
  uint32_t memorySize = 256;
  std::vector<std::vector<rung_range>> ranges; // one list a space
  std::vector<rung_space> spaces;
  std::vector<rung_symbol> symbols;
  std::vector<rung_slot> slots;
  std::deque<std::vector<const char*>> points; // one list a continuation
  std::vector<rung_continuation> continuations;
  std::vector<rung_timer> timers;
  std::vector<rung_init> inits;
  std::vector<rung_span> retains;
  std::vector<rung_span> safeSpans;
  std::vector<rung_written> writes;
  std::vector<rung_span> reads;
  std::vector<uint32_t> changes;
  std::vector<rung_copy> copies;
  std::vector<rung_chunk_fn> functions;
  std::vector<uint32_t> weights; // of chunks; 1 where it is shorter
  std::vector<rung_task> tasks;
  std::vector<uint32_t> partEnds;
  std::vector<rung_step> scan;
  std::vector<rung_step> fast, slices;
  bool instrumented = false;
  std::vector<const char*> faults = {"dead-loop", "division by zero"};
  std::vector<const char*> services = {"WINDR", "WINDW"};
  std::vector<rung_message_text> texts = {{20, 0, "Mount tool"}, {23, 0, "LUBRICATION"}};
  std::vector<const char*> files = {"main.pmc"};
  std::vector<const char*> routines = {"MAIN"};
  std::vector<rung_chunk> chunks;
  std::vector<rung_info> rungs; // one a chunk, line 10 * number, where link() has to make them
  rung_program program{};

  // A space with the given ranges, which must cover it.
  uint32_t addSpace(const char* name, uint32_t unitBytes, std::vector<rung_range> list, uint32_t flags = 0) {
    uint32_t bytes = 0;
    for (const rung_range& r : list) bytes += r.byte_count;
    ranges.push_back(std::move(list));
    spaces.push_back({name, unitBytes, bytes, flags, 0, nullptr});
    return static_cast<uint32_t>(spaces.size() - 1);
  }
  uint32_t addPacked(const char* name, uint32_t unitBytes, uint32_t bytes, uint32_t offset) {
    return addSpace(name, unitBytes, {{0, bytes, offset, RUNG_REPR_PACKED}});
  }
  void addSymbol(const char* name, uint32_t space, uint32_t byte, uint32_t type, uint32_t bit = 0, uint32_t count = 1) {
    symbols.push_back({name, "", space, byte, bit, type, count, 0, 0});
  }
  void addSlot(const char* key, uint32_t offset, uint32_t type) { slots.push_back({key, offset, type, RUNG_NONE, 0}); }
  void addContinuation(const char* key, uint32_t offset, std::vector<const char*> list) {
    points.push_back(std::move(list));
    continuations.push_back({key, offset, static_cast<uint32_t>(points.back().size()), points.back().data()});
  }
  // Its time is the slot at `offset`, its preset a constant in microseconds.
  void addTimer(const char* name, uint32_t offset, int64_t preset) {
    static constexpr uint32_t kMicrosecond[] = {1};
    timers.push_back({.name = name,
                      .preset = preset,
                      .units = kMicrosecond,
                      .unit_count = 1,
                      .rung = RUNG_NONE,
                      .time_us = 1,
                      .time_type = RUNG_TYPE_I64,
                      .time_space = RUNG_NONE,
                      .time_at = offset,
                      .running_at = RUNG_NONE});
  }
  void addConstant(const char* name, int64_t value) {
    symbols.push_back({name, "", RUNG_NONE, 0, 0, RUNG_TYPE_I64, 1, RUNG_SYMBOL_CONST, value});
  }
  uint32_t addChunk(rung_chunk_fn function, uint32_t weight = 1) {
    functions.push_back(function);
    weights.push_back(weight);
    return static_cast<uint32_t>(functions.size() - 1);
  }
  uint32_t addTask(const char* name, uint32_t entry, uint32_t budget = 1000,
                   std::vector<uint32_t> ends = {RUNG_PC_DONE}) {
    rung_task task{};
    task.name = name;
    task.entry = entry;
    task.period_us = 8000;
    task.budget = budget;
    task.longest = budget; // so that it is counted
    task.loop_free_chunk = RUNG_PC_DONE;
    task.part_first = static_cast<uint32_t>(partEnds.size());
    task.part_count = static_cast<uint32_t>(ends.size());
    partEnds.insert(partEnds.end(), ends.begin(), ends.end());
    tasks.push_back(task);
    return static_cast<uint32_t>(tasks.size() - 1);
  }
  // What the task may read; all of one task after the other.
  void addReads(uint32_t task, std::vector<rung_span> spans) {
    tasks[task].read_first = static_cast<uint32_t>(reads.size());
    tasks[task].read_count = static_cast<uint32_t>(spans.size());
    reads.insert(reads.end(), spans.begin(), spans.end());
  }
  // What holds all that the task may change; all of one task after the other.
  void addChanges(uint32_t task, std::vector<uint32_t> words) {
    tasks[task].change_first = static_cast<uint32_t>(changes.size());
    tasks[task].change_count = static_cast<uint32_t>(words.size());
    changes.insert(changes.end(), words.begin(), words.end());
  }
  void addBeginCopy(uint32_t task, rung_copy copy) { addCopy(copy, tasks[task].begin_first, tasks[task].begin_count); }
  void addEndCopy(uint32_t task, rung_copy copy) { addCopy(copy, tasks[task].end_first, tasks[task].end_count); }

  const rung_program& link() {
    for (size_t i = 0; i < spaces.size(); ++i) {
      spaces[i].ranges = ranges[i].data();
      spaces[i].range_count = static_cast<uint32_t>(ranges[i].size());
    }
    std::sort(symbols.begin(), symbols.end(),
              [](const rung_symbol& a, const rung_symbol& b) { return std::strcmp(a.name, b.name) < 0; });
    std::ranges::sort(slots, {}, [](const rung_slot& slot) { return std::string_view(slot.key); });
    chunks.clear();
    for (uint32_t i = 0; i < functions.size(); ++i) {
      chunks.push_back({i, 1, weights[i]});
      if (rungs.size() <= i) rungs.push_back({i == 3 ? "title" : "", 0, 10 * (i + 1), 10 * (i + 1), 0, i, i + 1, 0});
    }
    program.size = sizeof program;
    program.abi_version = RUNG_ABI_VERSION;
    program.name = "test";
    program.dialect = dialect.c_str();
    program.compiler = "hand";
    program.memory_size = memorySize;
    program.memory_align = 16;
    program.instrumented = instrumented ? 1 : 0;
    program.fast_task = RUNG_NONE;
    point(spaces, program.spaces, program.space_count);
    point(symbols, program.symbols, program.symbol_count);
    point(slots, program.slots, program.slot_count);
    point(continuations, program.continuations, program.continuation_count);
    point(timers, program.timers, program.timer_count);
    point(inits, program.inits, program.init_count);
    point(retains, program.retains, program.retain_count);
    point(safeSpans, program.safe_spans, program.safe_count);
    point(copies, program.copies, program.copy_count);
    point(chunks, program.chunks, program.chunk_count);
    point(rungs, program.rungs, program.rung_count);
    point(tasks, program.tasks, program.task_count);
    point(partEnds, program.part_ends, program.part_end_count);
    point(scan, program.scan, program.scan_count);
    point(fast, program.fast, program.fast_count);
    point(slices, program.slices, program.slice_count);
    point(faults, program.faults, program.fault_count);
    point(services, program.services, program.service_count);
    point(texts, program.texts, program.text_count);
    point(writes, program.writes, program.write_count);
    point(reads, program.reads, program.read_count);
    point(changes, program.changes, program.change_count);
    point(files, program.files, program.file_count);
    point(routines, program.routines, program.routine_count);
    program.chunk_fns = functions.data();
    program.main_task = tasks.empty() ? RUNG_NONE : 0;
    return program;
  }

private:
  template <class T, class P>
  static void point(const std::vector<T>& from, P& to, uint32_t& count) {
    to = from.data();
    count = static_cast<uint32_t>(from.size());
  }
  void addCopy(const rung_copy& copy, uint32_t& first, uint32_t& count) {
    if (count == 0) first = static_cast<uint32_t>(copies.size());
    copies.push_back(copy);
    ++count;
  }
};

} // namespace rung::test

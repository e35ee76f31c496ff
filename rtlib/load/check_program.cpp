// The check of a program's tables (see program_info.h): everything in rung/program.h on which the runtime relies, in
// the order of that file. Enums are closed sets: the meaning of other values, which a newer compiler may use, is
// unknown here, so the program is refused. Each table is scanned once, with a search of the ranges for each reference
// to memory.
#include <algorithm>
#include <concepts>
#include <cstring>
#include <initializer_list>
#include <span>
#include <vector>

#include "rtlib/core/memory.h"
#include "rtlib/load/file.h"
#include "rtlib/load/program_info.h"
#include "rung/types.hpp"

namespace rung::runtime {

namespace {

constexpr uint32_t kMaxAlign = 4096;
constexpr uint32_t kMostMemory = 64u << 20; // bytes
constexpr uint32_t kMostBudget = 1u << 26;  // steps; compilers use a million, or in proportion to the program
constexpr uint32_t kMostTimes = 1000;       // runs of a task by one step of the schedule
constexpr uint64_t kMostRuns = 100'000;     // runs of tasks in a scan
constexpr uint64_t kLongestPassUs = 3'600'000'000;
constexpr uint32_t kSpaceFlags = RUNG_SPACE_INPUT | RUNG_SPACE_OUTPUT | RUNG_SPACE_HIDDEN | RUNG_SPACE_ALLOCATED;
constexpr uint32_t kTimerFlags = RUNG_TIMER_DOWN | RUNG_TIMER_RUNS;
constexpr uint32_t kSymbolFlags = RUNG_SYMBOL_READONLY | RUNG_SYMBOL_HIDDEN | RUNG_SYMBOL_CONST | RUNG_SYMBOL_AREA;

// A word or a number of a message. One function composes all messages, because code for each would be half the size of
// this file's code.
struct Part {
  explicit Part(const char* word) : text(word) {}
  template <std::unsigned_integral T>
  explicit Part(T value) : number(value) {}
  const char* text = nullptr; // null: the number
  uint64_t number = 0;
};

std::string textOf(std::initializer_list<Part> parts) {
  std::string text;
  for (const Part& part : parts) text += part.text != nullptr ? std::string(part.text) : std::to_string(part.number);
  return text;
}

uint32_t scaleOf(uint32_t repr) { return repr == RUNG_REPR_BYTE_PER_BIT ? 8 : 1; }

bool overlap(uint32_t a, uint32_t b, uint32_t size) { return a < uint64_t{b} + size && b < uint64_t{a} + size; }

class Checker {
public:
  Checker(const rung_program& program, const MappedFile* file) : p_(program), file_(file) {}

  std::string run() {
    for (void (Checker::*check)() :
         {&Checker::checkHead, &Checker::checkPresence, &Checker::checkSpaces, &Checker::checkSymbols,
          &Checker::checkSlots, &Checker::checkContinuations, &Checker::checkTimers, &Checker::checkMemory,
          &Checker::checkCopies, &Checker::checkCode, &Checker::checkTasks, &Checker::checkSchedule,
          &Checker::checkTexts}) {
      (this->*check)();
      if (!error_.empty()) break; // later checks rely on it
    }
    return error_;
  }

private:
  // Records an error; the first one stays.
  template <class... Parts>
  void fail(const Parts&... parts) {
    if (error_.empty()) error_ = textOf({Part(parts)...});
  }
  // Records an error in an entry of a table.
  template <class... Parts>
  void failAt(const char* table, uint32_t number, const Parts&... parts) {
    if (error_.empty()) error_ = textOf({Part(table), Part(" "), Part(number), Part(" "), Part(parts)...});
  }
  void index(const char* table, uint32_t number, const char* field, uint32_t value, uint32_t count) {
    if (value >= count) failAt(table, number, "has ", field, " ", value, ", there are ", count);
  }
  void piece(const char* table, uint32_t number, const char* field, uint32_t first, uint32_t count, uint32_t all) {
    if (first > all || count > all - first)
      failAt(table, number, "has ", field, " ", first, " + ", count, ", there are ", all);
  }
  void inBlock(const char* table, uint32_t number, uint32_t offset, uint64_t size) {
    if (offset > p_.memory_size || size > p_.memory_size - offset)
      failAt(table, number, "lies outside the memory block of ", p_.memory_size, " bytes");
  }
  void named(const char* table, uint32_t number, const char* name) {
    if (name == nullptr) return failAt(table, number, "has no name");
    readable(table, number, name);
  }
  // Checks a text that is not null.
  void readable(const char* table, uint32_t number, const char* text) {
    if (file_ != nullptr && !file_->holdsText(text)) failAt(table, number, "has a text that is not in the file");
  }
  // Whether the file has these entries, where entries of their type may lie.
  template <class T>
  bool holds(const T* entries, uint64_t count) const {
    if (file_ == nullptr) return true;
    return reinterpret_cast<uintptr_t>(entries) % alignof(T) == 0 && file_->holds(entries, count * sizeof(T));
  }
  // Checks the location of entries outside the program's own table.
  template <class T>
  void held(const char* table, uint32_t number, const T* entries, uint64_t count) {
    if (!holds(entries, count)) failAt(table, number, "has entries that are not in the file");
  }

  // ---- head --------------------------------------------------------------------------------------------------------

  void checkHead() {
    if (!holds(&p_, 1)) return fail("the program's description is not whole");
    if (p_.abi_version != RUNG_ABI_VERSION)
      return fail("the program has ABI version ", p_.abi_version, ", this runtime has ", RUNG_ABI_VERSION);
    if (p_.size < sizeof(rung_program))
      return fail("the program's description has ", p_.size, " bytes, this runtime needs ",
                  static_cast<uint32_t>(sizeof(rung_program)));
    if (p_.name == nullptr || p_.dialect == nullptr || p_.compiler == nullptr)
      return fail("the program's name, dialect or compiler is missing");
    for (const char* text : {p_.name, p_.dialect, p_.compiler})
      if (file_ != nullptr && !file_->holdsText(text))
        return fail("the program's name, dialect or compiler is not in the file");
    if (p_.memory_size > kMostMemory)
      fail("the memory block has ", p_.memory_size, " bytes, expected at most ", kMostMemory);
    if (p_.memory_align == 0 || (p_.memory_align & (p_.memory_align - 1)) != 0 || p_.memory_align > kMaxAlign)
      fail("the memory block has alignment ", p_.memory_align, ", expected a power of two up to ", kMaxAlign);
    if (p_.instrumented > 1) fail("`instrumented` is ", p_.instrumented, ", expected 0 or 1");
    if (p_.chunk_count > RUNG_PC_FAULT) fail("there are too many chunks: ", p_.chunk_count);
    if (p_.chunk_count != 0 && p_.chunk_fns == nullptr) fail("the program has no code");
  }

  template <class T>
  void present(const char* what, uint32_t count, const T* table) {
    if (count == 0) return;
    if (table == nullptr) return fail("the table of ", what, " is missing, it has ", count, " entries");
    if (!holds(table, count)) fail("the table of ", what, " is not in the file, it has ", count, " entries");
  }

  void checkPresence() {
    present("spaces", p_.space_count, p_.spaces);
    present("symbols", p_.symbol_count, p_.symbols);
    present("slots", p_.slot_count, p_.slots);
    present("continuations", p_.continuation_count, p_.continuations);
    present("timers", p_.timer_count, p_.timers);
    present("initial contents", p_.init_count, p_.inits);
    present("retained spans", p_.retain_count, p_.retains);
    present("safe spans", p_.safe_count, p_.safe_spans);
    present("copies", p_.copy_count, p_.copies);
    present("chunks", p_.chunk_count, p_.chunks);
    present("code", p_.chunk_count, p_.chunk_fns);
    present("rungs", p_.rung_count, p_.rungs);
    present("routines", p_.routine_count, p_.routines);
    present("files", p_.file_count, p_.files);
    present("tasks", p_.task_count, p_.tasks);
    present("parts", p_.part_end_count, p_.part_ends);
    present("scan steps", p_.scan_count, p_.scan);
    present("fast steps", p_.fast_count, p_.fast);
    present("slice steps", p_.slice_count, p_.slices);
    present("faults", p_.fault_count, p_.faults);
    present("services", p_.service_count, p_.services);
    present("texts", p_.text_count, p_.texts);
    present("written spans", p_.write_count, p_.writes);
    present("read spans", p_.read_count, p_.reads);
    present("changes", p_.change_count, p_.changes);
  }

  // ---- memory ------------------------------------------------------------------------------------------------------

  // A range of a space, by its place in the memory block.
  struct Stretch {
    uint32_t offset;
    uint32_t end;
    uint32_t repr;
  };

  void checkSpaces() {
    for (uint32_t i = 0; i < p_.space_count; ++i) checkSpace(i);
    const auto byOffset = [](const Stretch& a, const Stretch& b) { return a.offset < b.offset; };
    std::sort(stretches_.begin(), stretches_.end(), byOffset);
    for (size_t i = 1; i < stretches_.size(); ++i)
      if (stretches_[i].offset < stretches_[i - 1].end)
        fail("two ranges of spaces lie at offset ", stretches_[i].offset, " of the memory block");
  }

  void checkSpace(uint32_t number) {
    const rung_space& s = p_.spaces[number];
    named("space", number, s.name);
    if (s.unit_bytes != 1 && s.unit_bytes != 2 && s.unit_bytes != 4 && s.unit_bytes != 8)
      return failAt("space", number, "has units of ", s.unit_bytes, " bytes, expected 1, 2, 4 or 8");
    if (s.byte_count % s.unit_bytes != 0) failAt("space", number, "has ", s.byte_count, " bytes, part of a unit");
    if ((s.flags & ~kSpaceFlags) != 0) failAt("space", number, "has unknown flags ", s.flags);
    if (s.range_count != 0 && s.ranges == nullptr) return failAt("space", number, "has no table of ranges");
    held("space", number, s.ranges, s.range_count);
    if (!error_.empty()) return;
    uint64_t next = 0;
    for (uint32_t r = 0; r < s.range_count && error_.empty(); ++r) {
      const rung_range& range = s.ranges[r];
      if (range.repr > RUNG_REPR_BYTE_PER_BIT)
        return failAt("space", number, "has a range of unknown representation ", range.repr);
      if (range.first_byte != next || range.byte_count == 0)
        return failAt("space", number, "has ranges that do not cover it: byte ", range.first_byte);
      next += range.byte_count;
      const uint64_t size = uint64_t{range.byte_count} * scaleOf(range.repr);
      inBlock("space", number, range.offset, size);
      stretches_.push_back({range.offset, static_cast<uint32_t>(range.offset + size), range.repr});
    }
    if (next != s.byte_count) failAt("space", number, "has ranges that do not cover its ", s.byte_count, " bytes");
  }

  // The stretch that contains all these bytes; null if they are in none, or in several.
  const Stretch* stretchOf(uint32_t offset, uint32_t size) const {
    const auto after = firstAfter(offset);
    if (after == stretches_.begin()) return nullptr;
    const Stretch& found = *std::prev(after);
    return offset < found.end && size <= found.end - offset ? &found : nullptr;
  }
  std::vector<Stretch>::const_iterator firstAfter(uint32_t offset) const {
    return std::upper_bound(stretches_.begin(), stretches_.end(), offset,
                            [](uint32_t at, const Stretch& stretch) { return at < stretch.offset; });
  }

  void checkSymbols() {
    for (uint32_t i = 0; i < p_.symbol_count && error_.empty(); ++i) {
      const rung_symbol& s = p_.symbols[i];
      named("symbol", i, s.name);
      if (s.comment == nullptr) return failAt("symbol", i, "has no comment, not even \"\"");
      readable("symbol", i, s.comment);
      if (!error_.empty()) return;
      if (i > 0 && std::strcmp(p_.symbols[i - 1].name, s.name) > 0) failAt("symbol", i, "is not sorted by its name");
      checkSymbol(i, s);
    }
  }

  void checkSymbol(uint32_t number, const rung_symbol& s) {
    const uint32_t bits = elementBits(s.type);
    if (bits == 0) return failAt("symbol", number, "has the unknown type ", s.type);
    if ((s.flags & ~kSymbolFlags) != 0) return failAt("symbol", number, "has unknown flags ", s.flags);
    if ((s.flags & RUNG_SYMBOL_CONST) != 0) return;
    if (s.bit > 7 || (s.bit != 0 && s.type != RUNG_TYPE_BIT)) failAt("symbol", number, "begins at bit ", s.bit);
    if (s.count == 0) failAt("symbol", number, "has no elements");
    index("symbol", number, "space", s.space, p_.space_count);
    if (!error_.empty()) return;
    const uint64_t bytes = (s.bit + uint64_t{bits} * s.count + 7) / 8;
    if (s.byte + bytes > p_.spaces[s.space].byte_count) failAt("symbol", number, "lies outside space ", s.space);
  }

  // Ensures that a new program finds exactly the state of an old one.
  void checkSlots() {
    std::vector<rung_span> taken;
    for (uint32_t i = 0; i < p_.slot_count && error_.empty(); ++i) {
      const rung_slot& s = p_.slots[i];
      named("slot", i, s.key);
      if (!error_.empty()) return;
      if (i > 0 && std::strcmp(p_.slots[i - 1].key, s.key) >= 0) failAt("slot", i, "is not sorted by its key");
      const uint32_t bits = s.type == RUNG_TYPE_TEXT ? 0 : elementBits(s.type);
      if (bits == 0) return failAt("slot", i, "has the unknown type ", s.type);
      taken.push_back({s.offset, std::max(1u, bits / 8)}); // a bit has a byte
      inBlock("slot", i, s.offset, taken.back().size);
      if (s.rung != RUNG_NONE) index("slot", i, "rung", s.rung, p_.rung_count);
      if (error_.empty() && touchesSpace(taken.back())) failAt("slot", i, "lies in a space");
    }
    std::ranges::sort(taken, {}, &rung_span::offset);
    for (size_t i = 1; i < taken.size() && error_.empty(); ++i)
      if (taken[i].offset < taken[i - 1].offset + taken[i - 1].size)
        fail("two slots lie at offset ", taken[i].offset, " of the memory block");
  }

  void checkContinuations() {
    for (uint32_t i = 0; i < p_.continuation_count && error_.empty(); ++i) {
      const rung_continuation& c = p_.continuations[i];
      named("continuation", i, c.key);
      if (!error_.empty()) return;
      if (i > 0 && std::strcmp(p_.continuations[i - 1].key, c.key) >= 0)
        failAt("continuation", i, "is not sorted by its key");
      inBlock("continuation", i, c.offset, 4);
      if (c.point_count == 0 || c.points == nullptr) return failAt("continuation", i, "has no points");
      held("continuation", i, c.points, c.point_count);
      for (uint32_t k = 0; error_.empty() && k < c.point_count; ++k) {
        if (c.points[k] == nullptr) return failAt("continuation", i, "has a point without a key");
        readable("continuation", i, c.points[k]);
      }
    }
  }

  void checkTimers() {
    for (uint32_t i = 0; i < p_.timer_count && error_.empty(); ++i) {
      const rung_timer& t = p_.timers[i];
      named("timer", i, t.name);
      if ((t.flags & ~kTimerFlags) != 0) failAt("timer", i, "has unknown flags ", t.flags);
      if (t.rung != RUNG_NONE) index("timer", i, "rung", t.rung, p_.rung_count);
      if (t.unit_count == 0 || t.units == nullptr) return failAt("timer", i, "has no units");
      held("timer", i, t.units, t.unit_count);
      if (t.time_type == 0) failAt("timer", i, "has no time");
      checkTimerCell(i, t.time_type, t.time_space, t.time_at);
      checkTimerCell(i, t.preset_type, t.preset_space, t.preset_at);
      checkTimerCell(i, t.unit_type, t.unit_space, t.unit_at);
      if (t.running_at != RUNG_NONE) inBlock("timer", i, t.running_at, 1);
    }
  }

  void checkTimerCell(uint32_t number, uint32_t type, uint32_t space, uint32_t at) {
    if (type == 0 || !error_.empty()) return;
    if (type < RUNG_TYPE_I8 || type > RUNG_TYPE_I64) return failAt("timer", number, "has a cell of type ", type);
    const uint32_t bytes = elementBits(type) / 8;
    if (space == RUNG_NONE) return inBlock("timer", number, at, bytes);
    index("timer", number, "space", space, p_.space_count);
    if (error_.empty() && uint64_t{at} + bytes > p_.spaces[space].byte_count)
      failAt("timer", number, "has a cell outside space ", space);
  }

  bool touchesSpace(const rung_span& span) const {
    const auto after = firstAfter(span.offset + span.size - 1);
    return after != stretches_.begin() && std::prev(after)->end > span.offset;
  }

  void checkMemory() {
    for (uint32_t i = 0; i < p_.init_count && error_.empty(); ++i) checkInit(i);
    uint64_t kept = 0;
    for (uint32_t i = 0; i < p_.retain_count; ++i) {
      const rung_span& span = p_.retains[i];
      inBlock("retained span", i, span.offset, span.size);
      checkRetained(i, span);
      kept += span.size;
    }
    if (kept > UINT32_MAX) fail("the retained spans have more than 4 GB together");
    for (uint32_t i = 0; i < p_.safe_count; ++i)
      inBlock("safe span", i, p_.safe_spans[i].offset, p_.safe_spans[i].size);
    for (uint32_t i = 0; i < p_.read_count; ++i) inBlock("read span", i, p_.reads[i].offset, p_.reads[i].size);
    const uint32_t block = std::max(p_.memory_size, core::Memory::kLeastBlock);
    for (uint32_t i = 0; i < p_.change_count; ++i)
      if (p_.changes[i] > block - sizeof(uint64_t)) failAt("change", i, "lies outside the memory block");
    for (uint32_t i = 0; i < p_.write_count; ++i) {
      inBlock("written span", i, p_.writes[i].offset, p_.writes[i].size);
      if (i > 0 && p_.writes[i].offset < uint64_t{p_.writes[i - 1].offset} + p_.writes[i - 1].size)
        failAt("written span", i, "does not lie above the one before it");
      const uint32_t mask = p_.writes[i].mask;
      if (mask == 0 || mask > 255 || (mask != 255 && p_.writes[i].size != 1))
        failAt("written span", i, "has a mask that is wrong");
    }
  }

  // Code assumes that the byte of an expanded bit is 0 or 1.
  void checkInit(uint32_t number) {
    const rung_init& init = p_.inits[number];
    inBlock("initial contents", number, init.offset, init.size);
    if (init.data == nullptr) return failAt("initial contents", number, "has no data");
    held("initial contents", number, init.data, init.size);
    if (!error_.empty()) return;
    const uint32_t end = init.offset + init.size;
    auto stretch = firstAfter(init.offset);
    if (stretch != stretches_.begin()) --stretch;
    for (; stretch != stretches_.end() && stretch->offset < end; ++stretch) {
      if (stretch->repr != RUNG_REPR_BYTE_PER_BIT) continue;
      for (uint32_t at = std::max(init.offset, stretch->offset); at < std::min(end, stretch->end); ++at)
        if (init.data[at - init.offset] > 1)
          return failAt("initial contents", number, "has ", init.data[at - init.offset], " for a bit");
    }
  }

  // Retained spans are stored by addresses of the dialect, so they must consist of whole logical bytes of spaces. A
  // span may extend over several ranges.
  void checkRetained(uint32_t number, const rung_span& span) {
    for (uint32_t done = 0; done < span.size && error_.empty();) {
      const Stretch* stretch = stretchOf(span.offset + done, 1);
      if (stretch == nullptr) return failAt("retained span", number, "lies outside the spaces");
      const uint32_t scale = scaleOf(stretch->repr);
      const uint32_t size = std::min(span.size - done, stretch->end - (span.offset + done));
      if ((span.offset + done - stretch->offset) % scale != 0 || size % scale != 0)
        failAt("retained span", number, "begins or ends within a byte of its space");
      done += size;
    }
  }

  void checkCopies() {
    for (uint32_t i = 0; i < p_.copy_count && error_.empty(); ++i) {
      const rung_copy& c = p_.copies[i];
      if (c.kind > RUNG_COPY_MASKED) return failAt("copy", i, "has the unknown kind ", c.kind);
      const bool masked = c.kind == RUNG_COPY_MASKED;
      const uint32_t repr = checkEnd(i, "from", c.from, c.size);
      if (checkEnd(i, "to", c.to, c.size) != repr || (masked && checkEnd(i, "mask", c.mask, c.size) != repr))
        failAt("copy", i, "is between different representations");
      if (overlap(c.from, c.to, c.size) ||
          (masked && (overlap(c.mask, c.to, c.size) || overlap(c.mask, c.from, c.size))))
        failAt("copy", i, "overlaps itself");
    }
  }
  // Checks an end of a copy, which may extend over several ranges, and returns its representation.
  uint32_t checkEnd(uint32_t number, const char* end, uint32_t offset, uint32_t size) {
    const Stretch* first = stretchOf(offset, 1);
    for (const Stretch* at = first; at != nullptr && at->repr == first->repr; at = stretchOf(at->end, 1))
      if (size <= at->end - offset) return first->repr;
    failAt("copy", number, "has a `", end, "` that does not lie in ranges of one representation: ", offset, " + ",
           size);
    return 0;
  }

  // ---- code --------------------------------------------------------------------------------------------------------

  void checkCode() {
    for (uint32_t i = 0; i < p_.chunk_count; ++i) {
      const rung_chunk& c = p_.chunks[i];
      index("chunk", i, "first rung", c.first_rung, p_.rung_count);
      if (c.rung_count > p_.rung_count) failAt("chunk", i, "has ", c.rung_count, " rungs, there are ", p_.rung_count);
      if (c.rung_count == 0) failAt("chunk", i, "has no rungs");
      if (c.weight == 0) failAt("chunk", i, "has weight 0, expected at least 1");
      if (p_.chunk_fns[i] == nullptr) return failAt("chunk", i, "has no code");
      if (file_ != nullptr && !file_->holdsCode(reinterpret_cast<const void*>(p_.chunk_fns[i])))
        return failAt("chunk", i, "has code that is not in the file");
    }
    for (uint32_t i = 0; error_.empty() && i < p_.rung_count; ++i) {
      const rung_info& r = p_.rungs[i];
      if (r.title == nullptr) return failAt("rung", i, "has no title, not even \"\"");
      readable("rung", i, r.title);
      if (r.file != RUNG_NONE) index("rung", i, "file", r.file, p_.file_count);
      if (r.first_line > r.last_line) failAt("rung", i, "ends before it begins, in line ", r.last_line);
      index("rung", i, "routine", r.routine, p_.routine_count);
    }
  }

  void checkReads(uint32_t task) {
    const rung_task& t = p_.tasks[task];
    for (uint32_t i = t.read_first + 1; error_.empty() && i < t.read_first + t.read_count; ++i)
      if (p_.reads[i].offset <= uint64_t{p_.reads[i - 1].offset} + p_.reads[i - 1].size)
        failAt("read span", i, "does not lie above the one before it");
  }

  void checkTasks() {
    for (uint32_t i = 0; i < p_.task_count; ++i) {
      const rung_task& t = p_.tasks[i];
      named("task", i, t.name);
      index("task", i, "entry", t.entry, p_.chunk_count);
      index("task", i, "budget fault", t.budget_fault, p_.fault_count);
      if (t.budget > kMostBudget) failAt("task", i, "has too large a budget: ", t.budget);
      piece("task", i, "begin copies", t.begin_first, t.begin_count, p_.copy_count);
      piece("task", i, "end copies", t.end_first, t.end_count, p_.copy_count);
      piece("task", i, "parts", t.part_first, t.part_count, p_.part_end_count);
      piece("task", i, "read spans", t.read_first, t.read_count, p_.read_count);
      checkReads(i);
      piece("task", i, "changes", t.change_first, t.change_count, p_.change_count);
      if (t.change_count > RUNG_MOST_CHANGES) failAt("task", i, "has too many changes");
      if (t.loop_free_chunk != RUNG_PC_DONE) index("task", i, "loop-free chunk", t.loop_free_chunk, p_.chunk_count);
      if (t.part_count == 0) failAt("task", i, "has no parts, expected at least 1");
      if (error_.empty()) checkParts(i, t);
    }
    if (p_.main_task != RUNG_NONE && p_.main_task >= p_.task_count)
      fail("the main task is ", p_.main_task, ", there are ", p_.task_count);
    if (p_.fast_task != RUNG_NONE && p_.fast_task >= p_.task_count)
      fail("the fast task is ", p_.fast_task, ", there are ", p_.task_count);
  }

  void checkParts(uint32_t number, const rung_task& task) {
    uint32_t before = 0;
    for (uint32_t k = 0; k < task.part_count; ++k) {
      const uint32_t end = p_.part_ends[task.part_first + k];
      if (end != RUNG_PC_DONE) index("task", number, "a part that ends before chunk", end, p_.chunk_count);
      if (end < before) failAt("task", number, "has parts that are not in order: chunk ", end);
      before = end;
    }
    if (before != RUNG_PC_DONE) failAt("task", number, "has a last part that does not end with the run");
  }

  void checkSchedule() {
    for (uint32_t i = 0; i < p_.scan_count; ++i) checkStep("scan step", i, p_.scan[i]);
    for (uint32_t i = 0; i < p_.fast_count; ++i) checkStep("fast step", i, p_.fast[i]);
    for (uint32_t i = 0; i < p_.slice_count; ++i) checkStep("slice step", i, p_.slices[i]);
    const uint64_t scan = advanceUs({p_.scan, p_.scan_count});
    const uint64_t slices = advanceUs({p_.slices, p_.slice_count});
    if (p_.slice_count != 0 && slices != scan) fail("the slices take ", slices, " us, a scan ", scan);
    checkTimes("scan", {p_.scan, p_.scan_count});
    checkTimes("fast", {p_.fast, p_.fast_count});
    checkTimes("slice", {p_.slices, p_.slice_count});
    if (error_.empty() && scanPeriodUs(p_) > kLongestPassUs)
      fail("a scan takes ", scanPeriodUs(p_), " us, expected an hour at most");
    if (scanPeriodUs(p_) == 0)
      fail("the scan list takes no time: it has no step that advances the clock, and the main task has no period");
  }
  // Checks the number of runs in one scan.
  void checkTimes(const char* list, std::span<const rung_step> steps) {
    uint64_t runs = 0;
    for (const rung_step& step : steps)
      if (step.op == RUNG_STEP_RUN || step.op == RUNG_STEP_PART) runs += std::max(step.arg, 1u);
    if (runs > kMostRuns) fail("the ", list, " list runs tasks ", runs, " times, expected at most ", kMostRuns);
  }
  void checkStep(const char* table, uint32_t number, const rung_step& step) {
    if (step.op == RUNG_STEP_RUN && step.arg > kMostTimes)
      failAt(table, number, "runs its task ", step.arg, " times, expected at most ", kMostTimes);
    if (step.op > RUNG_STEP_SLOT) failAt(table, number, "has the unknown operation ", step.op);
    if (step.op == RUNG_STEP_RUN || step.op == RUNG_STEP_PART) index(table, number, "task", step.task, p_.task_count);
  }

  // ---- texts -------------------------------------------------------------------------------------------------------

  void checkTexts() {
    checkList("routine", p_.routine_count, p_.routines);
    checkList("file", p_.file_count, p_.files);
    checkList("fault", p_.fault_count, p_.faults);
    checkList("service", p_.service_count, p_.services);
    for (uint32_t i = 0; error_.empty() && i < p_.text_count; ++i)
      if (p_.texts[i].text == nullptr)
        failAt("text", i, "is missing");
      else
        readable("text", i, p_.texts[i].text);
  }
  void checkList(const char* table, uint32_t count, const char* const* list) {
    for (uint32_t i = 0; error_.empty() && i < count; ++i)
      if (list[i] == nullptr)
        failAt(table, i, "is missing");
      else
        readable(table, i, list[i]);
  }

  const rung_program& p_;
  const MappedFile* file_;         // the file that contains the tables; null: unknown
  std::vector<Stretch> stretches_; // by offset
  std::string error_;
};

} // namespace

std::string checkProgram(const rung_program& program, const MappedFile* file) { return Checker(program, file).run(); }

} // namespace rung::runtime

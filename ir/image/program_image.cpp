// Fills and joins the tables of a program.
#include "ir/image/program_image.h"

#include <algorithm>
#include <map>
#include <span>
#include <string_view>
#include <tuple>

#include "ir/analysis/longest_path.h"
#include "ir/core/op_info.h"
#include "ir/core/ops.h"
#include "ir/shape/accesses.h"
#include "ir/support/check.h"
#include "rtlib/text/version.h"
#include "rung/types.hpp"

namespace rung::ir {
namespace {

// Spaces, names, state and contents in a program's tables.

class MemoryTables {
public:
  MemoryTables(ImageTables& tables, const Layout& layout)
      : tables_(tables), layout_(layout), module_(layout.module()) {}

  void run() {
    const Places places = reachedPlaces();
    const std::vector<uint32_t> rungs = firstRungsOfSlots();
    addSpaces();
    addSymbols(places);
    addSlots(rungs);
    addContinuations();
    addTimers(rungs, places);
    addInits();
    addSpans(module_.retains, tables_.retains);
    addSpans(module_.safeSpans, tables_.safeSpans);
    tables_.writes = writtenBits(layout_.memory());
  }

private:
  void addSpaces() {
    for (uint32_t i = 0; i < module_.spaces.size(); ++i) {
      const Space& space = module_.spaces[i];
      const std::vector<rung_range>& ranges = tables_.ranges.emplace_back(layout_.memory().space(SpaceId{i}).ranges);
      tables_.spaces.push_back({tables_.text(space.name), space.unitBytes, space.units * space.unitBytes, space.flags,
                                static_cast<uint32_t>(ranges.size()), ranges.data()});
    }
  }

  // How far operations reach from a byte of a space, in bytes, and the first rung with an operation there.
  struct Reached {
    uint32_t bytes = 0;
    uint32_t rung = RUNG_NONE;
  };
  using Places = std::map<std::pair<uint32_t, uint32_t>, Reached>; // by space and byte

  Places reachedPlaces() const {
    Places places;
    for (const Symbol& s : module_.symbols)
      if (s.space.valid()) places[{s.space.index, s.byte}];
    for (const Timer& timer : module_.timers)
      if (!timer.time.slot.valid()) places[{timer.time.space.index, timer.time.byte}];
    for (uint32_t r = 0; r < module_.routines.size(); ++r)
      for (uint32_t i = 0; i < module_.routines[r].rungs.size(); ++i)
        for (const Op& op : module_.routines[r].rungs[i].ops) {
          const Attr attr = opInfo(op.code).attr;
          if (attr != Attr::Place && attr != Attr::Window) continue;
          const auto place = places.find({op.ref, static_cast<uint32_t>(op.imm / 8)});
          if (place == places.end()) continue;
          place->second.rung = std::min(place->second.rung, layout_.partition().rungNumber(RoutineId{r}, i));
          if (attr == Attr::Place) place->second.bytes = std::max(place->second.bytes, byteWidth(op.type));
        }
    return places;
  }

  void addSymbols(const Places& places) {
    for (const Symbol& s : module_.symbols) {
      const bool hasPlace = s.space.valid();
      const Reached reached = hasPlace ? places.at({s.space.index, s.byte}) : Reached{};
      const uint32_t own = (s.bit + elementBits(s.type) * s.count + 7) / 8;
      const uint32_t reach = s.bit != 0 || s.type == RUNG_TYPE_BIT ? own : std::max(own, reached.bytes);
      tables_.symbols.push_back({tables_.text(s.name), tables_.text(s.comment), s.space.index, s.byte, s.bit, s.type,
                                 s.count, s.flags, s.value, hasPlace ? reach : 0,
                                 (s.flags & RUNG_SYMBOL_HIDDEN) != 0 ? reached.rung : RUNG_NONE});
    }
    std::sort(tables_.symbols.begin(), tables_.symbols.end(), [](const rung_symbol& a, const rung_symbol& b) {
      const int order = std::string_view(a.name).compare(b.name);
      return order != 0 ? order < 0 : a.byte < b.byte;
    });
  }

  // In program order, the first operation of each rung counts.
  std::vector<uint32_t> firstRungsOfSlots() const {
    std::vector<uint32_t> first(module_.slots.size(), RUNG_NONE);
    for (uint32_t r = 0; r < module_.routines.size(); ++r)
      for (uint32_t i = 0; i < module_.routines[r].rungs.size(); ++i)
        for (const Op& op : module_.routines[r].rungs[i].ops)
          if (op.code == OpCode::SlotLoad || op.code == OpCode::SlotStore)
            first[op.ref] = std::min(first[op.ref], layout_.partition().rungNumber(RoutineId{r}, i));
    return first;
  }

  void addSlots(const std::vector<uint32_t>& rungs) {
    for (uint32_t i = 0; i < module_.slots.size(); ++i) {
      const Slot& slot = module_.slots[i];
      if (!slot.transient)
        tables_.slots.push_back(
            {tables_.text(slot.key), layout_.memory().slot(SlotId{i}), abiType(slot.type), rungs[i], 0});
    }
    std::ranges::sort(tables_.slots, {}, [](const rung_slot& slot) { return std::string_view(slot.key); });
  }

  void addContinuations() {
    for (const Continuation& c : module_.continuations) {
      std::vector<const char*>& points = tables_.points.emplace_back();
      for (const std::string& point : c.points) points.push_back(tables_.text(point));
      tables_.continuations.push_back(
          {tables_.text(c.key), c.slot.valid() ? layout_.memory().slot(c.slot) : layout_.memory().byte(c.space, c.byte),
           static_cast<uint32_t>(points.size()), points.data()});
    }
    std::ranges::sort(tables_.continuations, {}, [](const rung_continuation& c) { return std::string_view(c.key); });
  }

  // Type, space, and byte or offset of a cell.
  std::tuple<uint32_t, uint32_t, uint32_t> cellOf(const TimerCell& cell) const {
    if (cell.type == Type::None) return {0, RUNG_NONE, 0};
    if (cell.slot.valid()) return {abiType(cell.type), RUNG_NONE, layout_.memory().slot(cell.slot)};
    return {abiType(cell.type), cell.space.index, cell.byte};
  }

  void addTimers(const std::vector<uint32_t>& rungs, const Places& places) {
    for (const Timer& timer : module_.timers) {
      const std::vector<uint32_t>& units = tables_.units.emplace_back(timer.unitsUs);
      rung_timer out{.name = tables_.text(timer.name),
                     .preset = timer.preset.type == Type::None ? timer.constant : 0,
                     .units = units.data(),
                     .unit_count = static_cast<uint32_t>(units.size()),
                     .flags = timer.flags,
                     .rung = rungOf(timer, rungs, places),
                     .time_us = timer.timeUs,
                     .running_at = timer.running.valid() ? layout_.memory().slot(timer.running) : RUNG_NONE};
      std::tie(out.time_type, out.time_space, out.time_at) = cellOf(timer.time);
      std::tie(out.preset_type, out.preset_space, out.preset_at) = cellOf(timer.preset);
      std::tie(out.unit_type, out.unit_space, out.unit_at) = cellOf(timer.unit);
      tables_.timers.push_back(out);
    }
    std::ranges::stable_sort(tables_.timers, {}, &rung_timer::rung);
  }

  // `slots`: firstRungsOfSlots.
  static uint32_t rungOf(const Timer& timer, const std::vector<uint32_t>& slots, const Places& places) {
    if (timer.time.slot.valid()) return slots[timer.time.slot.index];
    if (timer.running.valid()) return slots[timer.running.index];
    return places.at({timer.time.space.index, timer.time.byte}).rung;
  }

  void addInits() {
    for (const Init& init : module_.inits) addInit(layout_.memory().byte(init.space, init.byte), init.data);
    for (uint32_t i = 0; i < module_.slots.size(); ++i) {
      const Slot& slot = module_.slots[i];
      if (slot.init == 0) continue;
      std::vector<uint8_t> bytes(std::max(1u, byteWidth(slot.type)));
      for (size_t b = 0; b < bytes.size(); ++b)
        bytes[b] = static_cast<uint8_t>(static_cast<uint64_t>(slot.init) >> (8 * b));
      addInit(layout_.memory().slot(SlotId{i}), bytes);
    }
  }

  void addInit(uint32_t offset, const std::vector<uint8_t>& bytes) {
    if (bytes.empty()) return;
    const std::vector<uint8_t>& kept = tables_.initData.emplace_back(bytes);
    tables_.inits.push_back({offset, static_cast<uint32_t>(kept.size()), kept.data()});
  }

  void addSpans(const std::vector<SpaceSpan>& spans, std::vector<rung_span>& out) {
    for (const SpaceSpan& span : spans) {
      const std::vector<rung_span> pieces = layout_.memory().pieces(span);
      out.insert(out.end(), pieces.begin(), pieces.end());
    }
  }

  ImageTables& tables_;
  const Layout& layout_;
  const Module& module_;
};

// Tasks, their copies, chunks and the schedule in a program's tables.

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
      // A short program has fewer borders than parts: the parts after the last border are empty.
      tables_.partEnds.insert(tables_.partEnds.end(), task.parts - ends.size(), RUNG_PC_DONE);
      out.part_count = task.parts;
      const LongestRun longest = longestRun(layout_.shape(), TaskId{i});
      out.longest = longest.weight;
      out.loops = longest.loops ? 1 : 0;
      out.loop_free_chunk = longest.loopFree.chunk;
      out.loop_free_weight = longest.loopFree.weight;
      append(readBytes(layout_.memory(), TaskId{i}), tables_.reads, out.read_first, out.read_count);
      if (!module_.instrumented) // an instrumented run also changes its counters
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

  // Whether no copy writes what another one reads or writes.
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

  // Connected bytes have the same representation, but their ranges may be divided at different places.
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

  // The logical bytes from `byte`, at most `size`, that are contiguous in memory.
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

// Rungs and texts in a program's tables.

class RungTables {
public:
  RungTables(ImageTables& tables, const Layout& layout) : tables_(tables), layout_(layout), module_(layout.module()) {}

  void run() {
    addRungs();
    addTexts();
  }

private:
  void addRungs() {
    tables_.rungs.resize(layout_.partition().rungCount());
    std::vector<const std::string*> homes(layout_.partition().rungCount());
    for (uint32_t r = 0; r < module_.routines.size(); ++r) {
      for (uint32_t i = 0; i < module_.routines[r].rungs.size(); ++i) {
        const Rung& rung = module_.routines[r].rungs[i];
        const uint32_t number = layout_.partition().rungNumber(RoutineId{r}, i);
        homes[number] = &homeOf(module_.routines[r], rung);
        tables_.rungs[number] = {rung.title.empty() ? "" : tables_.text(rung.title),
                                 rung.begin.file.index,
                                 rung.begin.line,
                                 std::max(rung.begin.line, rung.lastLine),
                                 RUNG_NONE,
                                 rung.key,
                                 rung.number,
                                 rung.copy};
      }
    }
    nameRoutines(homes);
  }

  // `homes`: the routine of each rung.
  void nameRoutines(const std::vector<const std::string*>& homes) {
    std::map<std::string_view, uint32_t> known;
    for (size_t i = 0; i < homes.size(); ++i) {
      const auto [at, isNew] = known.try_emplace(*homes[i], static_cast<uint32_t>(known.size()));
      if (isNew) tables_.routines.push_back(tables_.text(*homes[i]));
      tables_.rungs[i].routine = at->second;
    }
  }

  void addTexts() {
    for (const std::string& s : module_.files) tables_.files.push_back(tables_.text(s));
    for (const std::string& s : module_.faults) tables_.faults.push_back(tables_.text(s));
    for (const std::string& s : module_.services) tables_.services.push_back(tables_.text(s));
    std::vector<MessageText> messages = module_.messages;
    std::ranges::stable_sort(messages, {}, &MessageText::number);
    for (const MessageText& m : messages) {
      tables_.texts.push_back({m.number, 0, tables_.text(m.text)});
    }
  }

  ImageTables& tables_;
  const Layout& layout_;
  const Module& module_;
};

// Joins the tables.

template <class T>
void point(const std::vector<T>& from, const T*& to, uint32_t& count) {
  to = from.empty() ? nullptr : from.data();
  count = static_cast<uint32_t>(from.size());
}
void pointTexts(const std::vector<const char*>& from, const char* const*& to, uint32_t& count) {
  to = from.empty() ? nullptr : from.data();
  count = static_cast<uint32_t>(from.size());
}

void link(rung_program& p, const ImageTables& tables) {
  point(tables.spaces, p.spaces, p.space_count);
  point(tables.symbols, p.symbols, p.symbol_count);
  point(tables.slots, p.slots, p.slot_count);
  point(tables.continuations, p.continuations, p.continuation_count);
  point(tables.timers, p.timers, p.timer_count);
  point(tables.inits, p.inits, p.init_count);
  point(tables.retains, p.retains, p.retain_count);
  point(tables.safeSpans, p.safe_spans, p.safe_count);
  point(tables.copies, p.copies, p.copy_count);
  point(tables.chunks, p.chunks, p.chunk_count);
  point(tables.rungs, p.rungs, p.rung_count);
  point(tables.tasks, p.tasks, p.task_count);
  point(tables.partEnds, p.part_ends, p.part_end_count);
  point(tables.scan, p.scan, p.scan_count);
  point(tables.fast, p.fast, p.fast_count);
  point(tables.slices, p.slices, p.slice_count);
  pointTexts(tables.routines, p.routines, p.routine_count);
  pointTexts(tables.files, p.files, p.file_count);
  pointTexts(tables.faults, p.faults, p.fault_count);
  pointTexts(tables.services, p.services, p.service_count);
  point(tables.texts, p.texts, p.text_count);
  point(tables.writes, p.writes, p.write_count);
  point(tables.reads, p.reads, p.read_count);
  point(tables.changes, p.changes, p.change_count);
}

} // namespace

ProgramImage::ProgramImage(const Layout& layout, uint64_t codeHash) {
  const Module& module = layout.module();
  rung_program& p = program_;
  p.size = sizeof(rung_program); // on this computer; FieldKind::OwnSize
  p.abi_version = RUNG_ABI_VERSION;
  p.name = tables_.text(module.name);
  p.dialect = tables_.text(module.dialect);
  p.compiler = text::compilerName();
  p.layout_hash = layout.memory().hash();
  p.code_hash = codeHash;
  p.memory_size = layout.memory().size();
  p.memory_align = kBlockAlign;
  p.instrumented = module.instrumented ? 1 : 0;
  p.main_task = module.mainTask.index;
  p.fast_task = module.fastTask.index;
  MemoryTables(tables_, layout).run();
  TaskTables(tables_, layout).run();
  RungTables(tables_, layout).run();
  link(p, tables_);
}

} // namespace rung::ir

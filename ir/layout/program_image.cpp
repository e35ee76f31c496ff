// Fills the tables of a rung_program (see program_image.h).
#include "ir/layout/program_image.h"

#include <algorithm>
#include <map>
#include <string_view>

#include "ir/chunks/heaviest.h"
#include "ir/core/op_info.h"
#include "ir/core/ops.h"
#include "ir/layout/accesses.h"
#include "ir/support/check.h"
#include "ir/support/version.h"
#include "rung/types.hpp"

namespace rung::ir {

class ImageBuilder {
public:
  ImageBuilder(ProgramImage& image, const Layout& layout) : image_(image), layout_(layout), module_(layout.module()) {}

  void run(uint64_t codeHash) {
    rung_program& p = image_.program_;
    p.size = sizeof(rung_program); // here; FieldKind::OwnSize
    p.abi_version = RUNG_ABI_VERSION;
    p.name = text(module_.name);
    p.dialect = text(module_.dialect);
    p.compiler = compilerName();
    p.layout_hash = layout_.memory().hash();
    p.code_hash = codeHash;
    p.memory_size = layout_.memory().size();
    p.memory_align = kBlockAlign;
    p.instrumented = module_.instrumented ? 1 : 0;
    p.main_task = module_.mainTask.index;
    p.fast_task = module_.fastTask.index;
    addSpaces();
    addSymbols();
    addSlots();
    addContinuations();
    addInits();
    addSpans(module_.retains, image_.retains_);
    addSpans(module_.safeSpans, image_.safeSpans_);
    addTasks();
    addChunks();
    addRungs();
    addSteps(module_.scan, image_.scan_);
    addSteps(module_.fast, image_.fast_);
    addSteps(module_.slices, image_.slices_);
    addTexts();
    image_.writes_ = writtenBits(layout_.memory());
    link();
  }

private:
  const char* text(const std::string& s) { return image_.strings_.emplace_back(s).c_str(); }

  void addSpaces() {
    for (uint32_t i = 0; i < module_.spaces.size(); ++i) {
      const Space& space = module_.spaces[i];
      const std::vector<rung_range>& ranges = image_.ranges_.emplace_back(layout_.memory().space(SpaceId{i}).ranges);
      image_.spaces_.push_back({text(space.name), space.unitBytes, space.units * space.unitBytes, space.flags,
                                static_cast<uint32_t>(ranges.size()), ranges.data()});
    }
  }

  // How far operations reach from a byte of a space, in bytes, and the first rung that has one there.
  struct Reached {
    uint32_t bytes = 0;
    uint32_t rung = RUNG_NONE;
  };
  using Places = std::map<std::pair<uint32_t, uint32_t>, Reached>; // by space and byte

  Places reachedPlaces() const {
    Places places;
    for (const Symbol& s : module_.symbols)
      if (s.space.valid()) places[{s.space.index, s.byte}];
    for (uint32_t r = 0; r < module_.routines.size(); ++r)
      for (uint32_t i = 0; i < module_.routines[r].rungs.size(); ++i)
        for (const Op& op : module_.routines[r].rungs[i].ops) {
          const Attr attr = opInfo(op.code).attr;
          if (attr != Attr::Place && attr != Attr::Window) continue;
          const auto place = places.find({op.ref, static_cast<uint32_t>(op.imm / 8)});
          if (place == places.end()) continue;
          place->second.rung = std::min(place->second.rung, layout_.cut().rungNumber(RoutineId{r}, i));
          if (attr == Attr::Place) place->second.bytes = std::max(place->second.bytes, byteWidth(op.type));
        }
    return places;
  }

  void addSymbols() {
    const Places places = reachedPlaces();
    for (const Symbol& s : module_.symbols) {
      const bool hasPlace = s.space.valid();
      const Reached reached = hasPlace ? places.at({s.space.index, s.byte}) : Reached{};
      const uint32_t own = (s.bit + elementBits(s.type) * s.count + 7) / 8;
      const uint32_t reach = s.bit != 0 || s.type == RUNG_TYPE_BIT ? own : std::max(own, reached.bytes);
      image_.symbols_.push_back({text(s.name), text(s.comment), s.space.index, s.byte, s.bit, s.type, s.count, s.flags,
                                 s.value, hasPlace ? reach : 0,
                                 (s.flags & RUNG_SYMBOL_HIDDEN) != 0 ? reached.rung : RUNG_NONE});
    }
    std::sort(image_.symbols_.begin(), image_.symbols_.end(), [](const rung_symbol& a, const rung_symbol& b) {
      const int order = std::string_view(a.name).compare(b.name);
      return order != 0 ? order < 0 : a.byte < b.byte;
    });
  }

  // In the order of the program, each rung's first operation counts.
  std::vector<uint32_t> firstRungsOfSlots() const {
    std::vector<uint32_t> first(module_.slots.size(), RUNG_NONE);
    for (uint32_t r = 0; r < module_.routines.size(); ++r)
      for (uint32_t i = 0; i < module_.routines[r].rungs.size(); ++i)
        for (const Op& op : module_.routines[r].rungs[i].ops)
          if (op.code == OpCode::SlotLoad || op.code == OpCode::SlotStore)
            first[op.ref] = std::min(first[op.ref], layout_.cut().rungNumber(RoutineId{r}, i));
    return first;
  }

  void addSlots() {
    const std::vector<uint32_t> rungs = firstRungsOfSlots();
    for (uint32_t i = 0; i < module_.slots.size(); ++i) {
      const Slot& slot = module_.slots[i];
      if (!slot.transient)
        image_.slots_.push_back({text(slot.key), layout_.memory().slot(SlotId{i}), abiType(slot.type), rungs[i], 0});
    }
    std::ranges::sort(image_.slots_, {}, [](const rung_slot& slot) { return std::string_view(slot.key); });
  }

  void addContinuations() {
    for (const Continuation& c : module_.continuations) {
      std::vector<const char*>& points = image_.points_.emplace_back();
      for (const std::string& point : c.points) points.push_back(text(point));
      image_.continuations_.push_back(
          {text(c.key), c.slot.valid() ? layout_.memory().slot(c.slot) : layout_.memory().byte(c.space, c.byte),
           static_cast<uint32_t>(points.size()), points.data()});
    }
    std::ranges::sort(image_.continuations_, {}, [](const rung_continuation& c) { return std::string_view(c.key); });
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
    const std::vector<uint8_t>& kept = image_.initData_.emplace_back(bytes);
    image_.inits_.push_back({offset, static_cast<uint32_t>(kept.size()), kept.data()});
  }

  void addSpans(const std::vector<SpaceSpan>& spans, std::vector<rung_span>& out) {
    for (const SpaceSpan& span : spans) {
      const std::vector<rung_span> pieces = layout_.memory().pieces(span);
      out.insert(out.end(), pieces.begin(), pieces.end());
    }
  }

  void addCopies(const std::vector<Copy>& copies) {
    const size_t first = image_.copies_.size();
    for (const Copy& copy : copies) addCopy(copy);
    const std::span added(image_.copies_.begin() + static_cast<ptrdiff_t>(first), image_.copies_.end());
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
    image_.copies_.resize(first);
    image_.copies_.insert(image_.copies_.end(), joined.begin(), joined.end());
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
      image_.copies_.push_back({copy.masked ? uint32_t{RUNG_COPY_MASKED} : uint32_t{RUNG_COPY_ALL}, from.offset,
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

  void addTasks() {
    for (uint32_t i = 0; i < module_.tasks.size(); ++i) {
      const Task& task = module_.tasks[i];
      rung_task out{};
      out.name = text(task.name);
      out.entry = layout_.cut().entry(task.entry);
      out.period_us = task.periodUs;
      out.budget = task.budget;
      out.budget_fault = task.budgetFault.index;
      out.begin_first = static_cast<uint32_t>(image_.copies_.size());
      addCopies(task.begin);
      out.begin_count = static_cast<uint32_t>(image_.copies_.size()) - out.begin_first;
      out.end_first = static_cast<uint32_t>(image_.copies_.size());
      addCopies(task.end);
      out.end_count = static_cast<uint32_t>(image_.copies_.size()) - out.end_first;
      out.part_first = static_cast<uint32_t>(image_.partEnds_.size());
      const std::vector<uint32_t>& ends = layout_.cut().partEnds(TaskId{i});
      image_.partEnds_.insert(image_.partEnds_.end(), ends.begin(), ends.end());
      // A short program gives fewer borders than parts: the parts after the last border are empty.
      image_.partEnds_.insert(image_.partEnds_.end(), task.parts - ends.size(), RUNG_PC_DONE);
      out.part_count = task.parts;
      const HeaviestRun heaviest = heaviestRun(layout_.shape(), TaskId{i});
      out.heaviest = heaviest.weight;
      out.circles = heaviest.circles ? 1 : 0;
      out.straight_chunk = heaviest.straight.chunk;
      out.straight_weight = heaviest.straight.weight;
      append(readBytes(layout_.memory(), TaskId{i}), image_.reads_, out.read_first, out.read_count);
      if (!module_.instrumented) // what is measured changes its counters, too
        append(changedWords(layout_.memory(), TaskId{i}), image_.changes_, out.change_first, out.change_count);
      image_.tasks_.push_back(out);
    }
  }

  template <class T>
  static void append(const std::vector<T>& these, std::vector<T>& all, uint32_t& first, uint32_t& count) {
    first = static_cast<uint32_t>(all.size());
    count = static_cast<uint32_t>(these.size());
    all.insert(all.end(), these.begin(), these.end());
  }

  void addChunks() {
    for (const Chunk& chunk : layout_.cut().chunks())
      image_.chunks_.push_back(
          {layout_.cut().rungNumber(chunk.routine, chunk.firstRung), chunk.rungCount, chunk.weight});
  }

  void addRungs() {
    image_.rungs_.resize(layout_.cut().rungCount());
    std::vector<const std::string*> homes(layout_.cut().rungCount());
    for (uint32_t r = 0; r < module_.routines.size(); ++r) {
      for (uint32_t i = 0; i < module_.routines[r].rungs.size(); ++i) {
        const Rung& rung = module_.routines[r].rungs[i];
        const uint32_t number = layout_.cut().rungNumber(RoutineId{r}, i);
        homes[number] = &homeOf(module_.routines[r], rung);
        image_.rungs_[number] = {rung.title.empty() ? "" : text(rung.title),
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

  // Of each rung.
  void nameRoutines(const std::vector<const std::string*>& homes) {
    std::map<std::string_view, uint32_t> known;
    for (size_t i = 0; i < homes.size(); ++i) {
      const auto [at, isNew] = known.try_emplace(*homes[i], static_cast<uint32_t>(known.size()));
      if (isNew) image_.routines_.push_back(text(*homes[i]));
      image_.rungs_[i].routine = at->second;
    }
  }

  void addSteps(const std::vector<Step>& steps, std::vector<rung_step>& out) {
    for (const Step& step : steps) out.push_back({step.op, step.task.index, step.arg});
  }

  void addTexts() {
    for (const std::string& s : module_.files) image_.files_.push_back(text(s));
    for (const std::string& s : module_.faults) image_.faults_.push_back(text(s));
    for (const std::string& s : module_.services) image_.services_.push_back(text(s));
    std::vector<MessageText> messages = module_.messages;
    std::ranges::stable_sort(messages, {}, &MessageText::number);
    for (const MessageText& m : messages) {
      image_.texts_.push_back({m.number, 0, text(m.text)});
    }
  }

  template <class T>
  static void point(const std::vector<T>& from, const T*& to, uint32_t& count) {
    to = from.empty() ? nullptr : from.data();
    count = static_cast<uint32_t>(from.size());
  }

  void link() {
    rung_program& p = image_.program_;
    point(image_.spaces_, p.spaces, p.space_count);
    point(image_.symbols_, p.symbols, p.symbol_count);
    point(image_.slots_, p.slots, p.slot_count);
    point(image_.continuations_, p.continuations, p.continuation_count);
    point(image_.inits_, p.inits, p.init_count);
    point(image_.retains_, p.retains, p.retain_count);
    point(image_.safeSpans_, p.safe_spans, p.safe_count);
    point(image_.copies_, p.copies, p.copy_count);
    point(image_.chunks_, p.chunks, p.chunk_count);
    point(image_.rungs_, p.rungs, p.rung_count);
    point(image_.tasks_, p.tasks, p.task_count);
    point(image_.partEnds_, p.part_ends, p.part_end_count);
    point(image_.scan_, p.scan, p.scan_count);
    point(image_.fast_, p.fast, p.fast_count);
    point(image_.slices_, p.slices, p.slice_count);
    pointTexts(image_.routines_, p.routines, p.routine_count);
    pointTexts(image_.files_, p.files, p.file_count);
    pointTexts(image_.faults_, p.faults, p.fault_count);
    pointTexts(image_.services_, p.services, p.service_count);
    point(image_.texts_, p.texts, p.text_count);
    point(image_.writes_, p.writes, p.write_count);
    point(image_.reads_, p.reads, p.read_count);
    point(image_.changes_, p.changes, p.change_count);
  }

  static void pointTexts(const std::vector<const char*>& from, const char* const*& to, uint32_t& count) {
    to = from.empty() ? nullptr : from.data();
    count = static_cast<uint32_t>(from.size());
  }

  ProgramImage& image_;
  const Layout& layout_;
  const Module& module_;
};

ProgramImage::ProgramImage(const Layout& layout, uint64_t codeHash) { ImageBuilder(*this, layout).run(codeHash); }

} // namespace rung::ir

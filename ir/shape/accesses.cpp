// Maps the operations of rungs to bytes of the memory block (see accesses.h).
#include "ir/shape/accesses.h"

#include <algorithm>
#include <optional>

#include "ir/core/memory_use.h"
#include "ir/core/op_info.h"

namespace rung::ir {
namespace {

constexpr uint32_t kAllBits = 255;

SpaceSpan bytesOf(const BitRange& place) {
  const uint32_t first = place.first / 8;
  return {place.space, first, (place.first + place.count + 7) / 8 - first};
}

bool isOneBit(const Use& use) { return use.type == Type::Bit && !use.computed; }

// Adds the used bytes of the memory block.
void addBytes(const MemoryLayout& layout, const Use& use, std::vector<rung_span>& spans) {
  if (isOneBit(use)) return spans.push_back({layout.bit(use.place.space, use.place.first).offset, 1});
  const std::vector<rung_span> pieces = layout.pieces(bytesOf(use.place));
  spans.insert(spans.end(), pieces.begin(), pieces.end());
}

// ---- writing -----------------------------------------------------------------------------------------------------

class WrittenSpans {
public:
  void add(const rung_written& written) { all_.push_back(written); }

  std::vector<rung_written> joined() {
    // Whole bytes before single bits of them.
    std::ranges::sort(all_, {}, [](const rung_written& w) { return std::pair(w.offset, w.mask != kAllBits); });
    for (const rung_written& written : all_) join(written);
    return std::move(out_);
  }

private:
  // Merged with the last one, if they overlap or are adjacent.
  void join(const rung_written& written) {
    if (out_.empty()) return out_.push_back(written);
    rung_written& last = out_.back();
    const uint32_t end = last.offset + last.size;
    if (last.mask == kAllBits && written.mask == kAllBits && written.offset <= end) {
      last.size = std::max(last.size, written.offset + written.size - last.offset);
    } else if (last.offset == written.offset && last.mask != kAllBits) {
      last.mask |= written.mask;
      if (last.mask == kAllBits) joinLast();
    } else if (written.offset >= end) {
      out_.push_back(written);
    }
  }
  // Called when the last one has become a whole byte.
  void joinLast() {
    const rung_written last = out_.back();
    out_.pop_back();
    join(last);
  }

  std::vector<rung_written> all_;
  std::vector<rung_written> out_;
};

// ---- reading -----------------------------------------------------------------------------------------------------

std::vector<rung_span> joined(std::vector<rung_span> spans) {
  std::ranges::sort(spans, {}, &rung_span::offset);
  std::vector<rung_span> out;
  for (const rung_span& span : spans) {
    if (out.empty() || span.offset > out.back().offset + out.back().size)
      out.push_back(span);
    else
      out.back().size = std::max(out.back().size, span.offset + span.size - out.back().offset);
  }
  return out;
}

// Adds what an operation reads or writes in the memory block.
void addTouched(const MemoryLayout& layout, const Op& op, std::vector<rung_span>& spans) {
  if (opInfo(op.code).attr == Attr::Slot)
    return spans.push_back({layout.slot(SlotId{op.ref}), std::max(1u, byteWidth(op.type))});
  if (const std::optional<Use> use = useOf(layout.module(), op)) addBytes(layout, *use, spans);
}

} // namespace

std::vector<rung_written> writtenBits(const MemoryLayout& layout) {
  const Module& module = layout.module();
  WrittenSpans spans;
  for (const Routine& routine : module.routines)
    forUses(module, routine, [&](const Use& use) {
      if (!use.writes) return;
      if (isOneBit(use)) {
        const BitLocation bit = layout.bit(use.place.space, use.place.first);
        return spans.add({bit.offset, 1, bit.wholeByte ? kAllBits : 1u << bit.bit});
      }
      for (const rung_span& piece : layout.pieces(bytesOf(use.place))) spans.add({piece.offset, piece.size, kAllBits});
    });
  return spans.joined();
}

std::vector<rung_span> readBytes(const MemoryLayout& layout, TaskId id) {
  const Module& module = layout.module();
  const Task& task = module.tasks[id.index];
  std::vector<rung_span> spans;
  const auto addPieces = [&](const SpaceSpan& span) {
    const std::vector<rung_span> pieces = layout.pieces(span);
    spans.insert(spans.end(), pieces.begin(), pieces.end());
  };
  for (const Copy& copy : task.begin) addPieces(copy.from);
  for (const RoutineId routine : routinesFrom(module, task.entry))
    forUses(module, module.at(routine), [&](const Use& use) {
      if (!use.writes) addBytes(layout, use, spans);
    });
  return joined(std::move(spans));
}

// ---- changes -----------------------------------------------------------------------------------------------------

namespace {

bool does(const Op& op, uint8_t effects) { return (opInfo(op.code).effects & effects) != 0; }

// Whether the task runs more than once within a scan.
bool runsAgain(const Module& module, TaskId task) {
  uint32_t runs = 0;
  for (const Step& step : module.scan)
    if (step.op == RUNG_STEP_RUN && step.task.index == task.index) runs += step.arg;
  return runs > 1;
}

// Words that cover the spans.
std::vector<uint32_t> wordsOver(const std::vector<rung_span>& spans, uint32_t memorySize) {
  constexpr uint32_t kWord = 8;
  const uint32_t last = memorySize > kWord ? memorySize - kWord : 0; // a block has at least one word
  std::vector<uint32_t> words;
  uint32_t covered = 0;
  for (const rung_span& span : spans)
    for (uint32_t at = std::max(covered, span.offset); at < span.offset + span.size; at = covered) {
      words.push_back(std::min(at, last));
      covered = words.back() + kWord;
    }
  return words;
}

} // namespace

std::vector<uint32_t> changedWords(const MemoryLayout& layout, TaskId id) {
  const Module& module = layout.module();
  if (!runsAgain(module, id)) return {};
  std::vector<rung_span> spans;
  for (const RoutineId routine : routinesFrom(module, module.tasks[id.index].entry))
    for (const Rung& rung : module.at(routine).rungs)
      for (const Op& op : rung.ops) {
        if (does(op, kHost)) return {};
        const bool isTransient = opInfo(op.code).attr == Attr::Slot && module.slots[op.ref].transient;
        if (does(op, kWrites) && !isTransient) addTouched(layout, op, spans);
      }
  std::vector<uint32_t> words = wordsOver(joined(std::move(spans)), layout.size());
  return words.size() <= RUNG_MOST_CHANGES ? words : std::vector<uint32_t>{};
}

} // namespace rung::ir

// Spaces, names, state and contents in a program's tables (see image_tables.h).
#include "ir/image/image_tables.h"

#include <algorithm>
#include <map>
#include <string_view>

#include "ir/core/op_info.h"
#include "ir/core/ops.h"
#include "ir/shape/accesses.h"
#include "rung/types.hpp"

namespace rung::ir {
namespace {

class MemoryTables {
public:
  MemoryTables(ImageTables& tables, const Layout& layout)
      : tables_(tables), layout_(layout), module_(layout.module()) {}

  void run() {
    addSpaces();
    addSymbols();
    addSlots();
    addContinuations();
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
          place->second.rung = std::min(place->second.rung, layout_.partition().rungNumber(RoutineId{r}, i));
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
      tables_.symbols.push_back({tables_.text(s.name), tables_.text(s.comment), s.space.index, s.byte, s.bit, s.type,
                                 s.count, s.flags, s.value, hasPlace ? reach : 0,
                                 (s.flags & RUNG_SYMBOL_HIDDEN) != 0 ? reached.rung : RUNG_NONE});
    }
    std::sort(tables_.symbols.begin(), tables_.symbols.end(), [](const rung_symbol& a, const rung_symbol& b) {
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
            first[op.ref] = std::min(first[op.ref], layout_.partition().rungNumber(RoutineId{r}, i));
    return first;
  }

  void addSlots() {
    const std::vector<uint32_t> rungs = firstRungsOfSlots();
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

} // namespace

void fillMemoryTables(ImageTables& tables, const Layout& layout) { MemoryTables(tables, layout).run(); }

} // namespace rung::ir

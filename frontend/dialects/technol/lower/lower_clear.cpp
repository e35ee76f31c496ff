// CLEAR (man. ch. 3.15).
#include <algorithm>
#include <cstdio>

#include "frontend/dialects/technol/lower/areas.h"
#include "frontend/dialects/technol/lower/lower.h"
#include "ir/support/hash.h"

namespace rung::frontend::technol {

constexpr uint32_t kMostCleared = 1u << 20; // bytes in one rung

namespace {

void clearRange(Lowering& l, ir::SpaceId space, uint32_t first, uint32_t end) {
  for (; first < end; first += std::min(end - first, kMostCleared)) {
    clear(l, fixedArea(l, space, l.bytesOf(space), first), fixedCount(l, std::min(end - first, kMostCleared)));
    l.out().cut();
  }
}

} // namespace

// From the first address up to the second, which is not cleared.
void lowerClear(Lowering& l, std::span<const Operand> o, int) {
  if (o[0].form == Operand::Form::Keyword) return l.clearAll(o[0].value == 0);
  l.out().cut();
  const Area begin = areaOf(l, o[0]), end = areaOf(l, o[1]);
  ir::RungBuilder& b = l.b();
  if (begin.fixed && end.fixed) {
    clearRange(l, begin.space, begin.first, end.first);
  } else {
    l.protect(b.ltU(end.at, begin.at));
    clear(l, begin, {.fixed = false, .most = begin.bytes, .value = b.sub(end.at, begin.at)});
  }
  l.out().cut();
}

// ---- CLEAR GLOBAL, CLEAR INTERNAL
// ------------------------------------------------------------------------------------

void Lowering::clearAll(bool global) {
  ir::RoutineId& routine = clears_[global ? 0 : 1];
  if (!routine.valid()) routine = newRoutine(global ? "@CLEAR GLOBAL" : "@CLEAR INTERNAL");
  out_->call(routine);
}

// What lies together is cleared together.
void Lowering::clearData(bool local) {
  uint32_t first = 0, end = 0;
  for (const DataItem& item : program_.items) {
    if (item.local != local || item.bytes == 0) continue;
    if (item.byte != end) {
      clearRange(*this, kDataSpace, first, end);
      first = item.byte;
    }
    end = item.byte + item.bytes;
  }
  clearRange(*this, kDataSpace, first, end);
}

// Texts and structures get the contents again that they have when the machine is switched on (man. l.1533-1536).
void Lowering::fillData() {
  size_t item = 0;
  for (const ir::Init& init : program_.inits) {
    if (init.space != kDataSpace) continue;
    while (item + 1 < program_.items.size() && program_.items[item].byte + program_.items[item].bytes <= init.byte)
      ++item;
    if (program_.items[item].local) continue;
    const std::string_view bytes(reinterpret_cast<const char*>(init.data.data()), init.data.size());
    for (size_t at = 0; at < bytes.size(); at += kMostCleared) {
      const std::string_view part = bytes.substr(at, kMostCleared);
      const auto size = static_cast<uint32_t>(part.size());
      copy(*this, fixedArea(*this, kDataSpace, program_.dataBytes, init.byte + static_cast<uint32_t>(at)),
           fixedArea(*this, constantBytes(part), size, 0), fixedCount(*this, size));
      out_->cut();
    }
  }
}

void Lowering::clearSlots(std::span<const ir::SlotId> slots) {
  constexpr size_t kStoresPerRung = 64;
  for (size_t i = 0; i < slots.size(); ++i) {
    if (i % kStoresPerRung == 0) out_->cut();
    b().slotStore(slots[i], b().constant(module_.at(slots[i]).type, 0));
  }
}

// GLOBAL: the data of all files, mechanisms and timers. INTERNAL: the data of DATA_LOCAL and the cells that
// instructions made for themselves (man. l.1533-1539).
void Lowering::makeClears() {
  for (const bool global : {true, false}) {
    if (!clears_[global ? 0 : 1].valid()) continue;
    out_ = newBuilder(clears_[global ? 0 : 1]);
    clearData(!global);
    if (global) {
      fillData();
      for (uint32_t i = 0; i < program_.mechanisms.size(); ++i) {
        initMechanism(i);
        if (i % 16 == 15) out_->cut();
      }
    }
    clearSlots(global ? timers_ : automatic_);
    out_->finish();
  }
}

// A hidden space of its own, named by its contents, so that a program that is exchanged while it runs finds its own.
ir::SpaceId Lowering::constantBytes(std::string_view bytes) {
  char number[17];
  std::snprintf(number, sizeof number, "%016llx", static_cast<unsigned long long>(hashBytes(bytes)));
  const std::string name = "@T" + std::string(number) + "." + std::to_string(bytes.size());
  const auto [at, isNew] = constants_.emplace(name, ir::SpaceId{static_cast<uint32_t>(module_.spaces.size())});
  if (isNew) {
    module_.spaces.push_back(
        {.name = name, .unitBytes = 1, .units = static_cast<uint32_t>(bytes.size()), .flags = RUNG_SPACE_HIDDEN});
    module_.inits.push_back({.space = at->second, .byte = 0, .data = {bytes.begin(), bytes.end()}});
  }
  return at->second;
}

} // namespace rung::frontend::technol

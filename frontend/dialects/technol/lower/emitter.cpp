// The module and its open routine (see emitter.h).
#include "frontend/dialects/technol/lower/emitter.h"

#include <algorithm>

#include <fmt/format.h>

#include "ir/support/hash.h"
#include "rtlib/nc/faults.h"
#include "rtlib/nc/technol/licences.h"

namespace rung::frontend::technol {

using ir::Type;

namespace {

constexpr HostCellInfo kHostCellInfos[kHostCells] = {
    {"@DR", Type::I64, 0},
    {"@RLO", Type::Bit, 8},
    {"@BLOCK_INIT.CONT", Type::I32, 12},
    {"@BLOCK_INIT.DONE", Type::Bit, 16},
    {"@BLOCK_DONE.CONT", Type::I32, 20},
    {"@BLOCK_DONE.DONE", Type::Bit, 24},
    {"@INIT.PENDING", Type::I64, 32},
    {"@DONE.PENDING", Type::I64, 40},
    {nc::kLicenceCell, Type::I32, 28},
};

} // namespace

const HostCellInfo& hostCell(HostCell cell) { return kHostCellInfos[static_cast<size_t>(cell)]; }

ir::RoutineId Emitter::newRoutine(std::string name) {
  module_.routines.push_back({.name = std::move(name)});
  return {static_cast<uint32_t>(module_.routines.size()) - 1};
}

void Emitter::open(ir::RoutineId routine) {
  open_.push_back(std::make_unique<RoutineBuilder>(module_, routine, registers_));
}

uint64_t Emitter::close() {
  out().finish();
  const uint64_t weight = out().weight();
  open_.pop_back();
  return weight;
}

ir::SlotId Emitter::newSlot(Type type, std::string key, bool transient) {
  module_.slots.push_back({.type = type, .transient = transient, .key = std::move(key)});
  return {static_cast<uint32_t>(module_.slots.size()) - 1};
}

void Emitter::clearSlots(std::span<const ir::SlotId> slots) {
  constexpr size_t kStoresPerRung = 64;
  for (size_t i = 0; i < slots.size(); ++i) {
    if (i % kStoresPerRung == 0) out().cut();
    b().slotStore(slots[i], b().constant(module_.at(slots[i]).type, 0));
  }
}

ir::FaultId Emitter::fault(std::string_view text) {
  const auto [entry, isNew] = faults_.emplace(text, ir::FaultId{static_cast<uint32_t>(module_.faults.size())});
  if (isNew) module_.faults.emplace_back(text);
  return entry->second;
}

ir::ServiceId Emitter::service(std::string_view signature) {
  const auto found = std::ranges::find(module_.services, signature);
  const auto index = static_cast<uint32_t>(found - module_.services.begin());
  if (found == module_.services.end()) module_.services.emplace_back(signature);
  return {index};
}

// A space of its own, named by its contents, so that a program that is exchanged while it runs finds its own.
ir::SpaceId Emitter::constantBytes(std::string_view bytes) {
  const std::string name = fmt::format("@T{:016x}.{}", hashBytes(bytes), bytes.size());
  const auto [at, isNew] = constants_.emplace(name, ir::SpaceId{static_cast<uint32_t>(module_.spaces.size())});
  if (isNew) {
    module_.spaces.push_back(
        {.name = name, .unitBytes = 1, .units = static_cast<uint32_t>(bytes.size()), .flags = RUNG_SPACE_HIDDEN});
    module_.inits.push_back({.space = at->second, .byte = 0, .data = {bytes.begin(), bytes.end()}});
  }
  return at->second;
}

void Emitter::protect(ir::ValueId bad) { b().trap(bad, fault(nc::kTechnolProtection)); }

} // namespace rung::frontend::technol

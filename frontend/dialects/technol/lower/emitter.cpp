// The module and its open routine (see emitter.h).
#include "frontend/dialects/technol/lower/emitter.h"

#include "rtlib/nc/faults.h"
#include "rtlib/nc/technol/services.h"

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
    {"@ANALOG.PORT", Type::I32, 48},
    {"@POS.CONTROL", Type::I64, 64, 16},
};

} // namespace

const HostCellInfo& hostCell(HostCell cell) { return kHostCellInfos[static_cast<size_t>(cell)]; }

void Emitter::open(ir::RoutineId routine) {
  open_.push_back(std::make_unique<RoutineBuilder>(module_, routine, registers_));
}

uint64_t Emitter::close() {
  out().finish();
  const uint64_t weight = out().weight();
  open_.pop_back();
  return weight;
}

void Emitter::clearSlots(std::span<const ir::SlotId> slots) {
  constexpr size_t kStoresPerRung = 64;
  for (size_t i = 0; i < slots.size(); ++i) {
    if (i % kStoresPerRung == 0) out().cut();
    b().slotStore(slots[i], b().constant(module_.at(slots[i]).type, 0));
  }
}

ir::ValueId Emitter::given(Type type, int64_t value, ir::GivenNumber number) {
  number.value = b().constant(type, value);
  if (given_ != nullptr) given_->add(out().routine(), out().openRung(), number);
  return number.value;
}

ir::ValueId Emitter::address(Type type, int64_t value, ir::Place begin, int64_t distance) {
  return given(type, value,
               {.value = {}, .space = begin.space, .byte = begin.byte, .distance = distance, .bit = begin.bit});
}

ir::ValueId Emitter::routine(Type type, int64_t value, ir::RoutineId routine) {
  return given(type, value, {.value = {}, .space = {}, .routine = routine});
}

void Emitter::protect(ir::ValueId bad) { b().trap(bad, fault(nc::kTechnolProtection)); }

} // namespace rung::frontend::technol

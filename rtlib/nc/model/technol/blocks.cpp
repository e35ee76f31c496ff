// The supervisor of part-program blocks (see blocks.h).
#include "rtlib/nc/model/technol/blocks.h"

#include <algorithm>

#include "rtlib/nc/model/technol/cells.h"
#include "rtlib/nc/technol/signals.h"

namespace rung::nc::technol {
namespace {

// STATUS_RESTART (man. l.6626-6632).
enum : uint64_t { kIdle = 0, kInit = 1, kMove = 2, kDone = 4 };

// Change pulses and dynamic functions last one block (man. l.6819, l.6852-6856, l.6958, l.6968).
bool lastsOneBlock(std::string_view name) { return name.starts_with("ZM") || name.ends_with("PID") || name == "M60PI"; }

// The mode and G00, G33 of a block stay until the next start (man. l.6752-6780).
constexpr std::string_view kUntilNextStart[] = {"AUTPI", "REFPI", "CAPI", "G00PI", "G33PI"};

} // namespace

void Blocks::reset(const host::Instance& instance) {
  phase_ = Phase::Idle;
  reached_ = first_ = false;
  lastOneBlock_.clear();
  motionBits_.clear();
  for (const Signal& signal : technolSignals()) {
    const std::string_view name = signal.symbol;
    if (std::string_view(signal.area) != "I" || signal.type != SignalType::Bit || signal.direction != Direction::In)
      continue;
    const auto place = placeOf(instance, signal);
    if (place && lastsOneBlock(name)) lastOneBlock_.push_back(*place);
    if (place && name.starts_with("PO_OS")) motionBits_.push_back(*place);
  }
}

std::string Blocks::start(host::Instance& instance, std::span<const NcArgument> cells) {
  if (phase_ != Phase::Idle) return "a block is under way already";
  for (const NcArgument& cell : cells) {
    if (cell.isText) return "'" + cell.key + "' is a number, not a text";
    const auto place = cellPlace(instance, cell.key);
    if (!place) return "unknown signal '" + cell.key + "'";
    if (place->kind == host::RefKind::Bit && (cell.isReal || (cell.integer != 0 && cell.integer != 1)))
      return "'" + cell.key + "' is a bit";
  }
  for (const std::string_view name : kUntilNextStart) writeCell(instance, name, 0);
  for (const NcArgument& cell : cells) {
    const host::Ref place = *cellPlace(instance, cell.key);
    if (cell.isReal || place.kind == host::RefKind::Real)
      instance.writeReal(place, cell.real);
    else
      instance.write(place, static_cast<uint64_t>(cell.integer));
  }
  writeCell(instance, "PO_POL", 0);
  phase_ = Phase::Starting;
  reached_ = false;
  return {};
}

std::string Blocks::reached(host::Instance& instance) {
  if (phase_ == Phase::Idle || phase_ == Phase::Done) return "no block is in motion";
  reached_ = true;
  if (phase_ == Phase::Motion) endMotion(instance);
  return {};
}

// Not before all initialisation is done (man. l.2571-2576), nor while the program forbids or delays it (man.
// l.6456-6467).
bool Blocks::mayStart(const host::Instance& instance) const {
  return readCell(instance, "@INIT.OWED") == 0 && readCell(instance, "START_DISABLE") == 0 &&
         readCell(instance, "START_SUSPEND") == 0;
}

void Blocks::enter(host::Instance& instance, Phase phase) {
  phase_ = phase;
  first_ = true;
  switch (phase) {
  case Phase::Idle: writeCell(instance, "STATUS_RESTART", kIdle); return;
  case Phase::Starting: return;
  case Phase::Init: writeCell(instance, "STATUS_RESTART", kInit); return;
  case Phase::Motion: writeCell(instance, "STATUS_RESTART", kMove); return;
  case Phase::Done: writeCell(instance, "STATUS_RESTART", kDone); return;
  }
}

void Blocks::supervise(host::Instance& instance) {
  if (phase_ == Phase::Starting && mayStart(instance)) {
    writeCell(instance, "PO_F", 1);
    enter(instance, Phase::Init);
  }
  if (phase_ == Phase::Init && pass(instance, "BLOCK_INIT")) {
    enter(instance, Phase::Motion);
    if (reached_) endMotion(instance);
  }
  if (phase_ == Phase::Motion && reached_) enter(instance, Phase::Done);
  if (phase_ == Phase::Done && pass(instance, "BLOCK_DONE")) finish(instance);
}

// True when the module ran through. It starts at its beginning with every block.
bool Blocks::pass(host::Instance& instance, std::string_view module) {
  const std::string cells = "@" + std::string(module);
  if (first_) {
    writeCell(instance, cells + ".CONT", 0);
    writeCell(instance, cells + ".DONE", 0);
  }
  first_ = false;
  return runWith(instance, module, 0, false) && readCell(instance, cells + ".DONE") != 0;
}

void Blocks::endMotion(host::Instance& instance) {
  writeCell(instance, "PO_POL", 1);
  for (const host::Ref& bit : motionBits_) instance.write(bit, 0);
}

void Blocks::finish(host::Instance& instance) {
  writeCell(instance, "PO_F", 0);
  for (const host::Ref& bit : lastOneBlock_) instance.write(bit, 0);
  const uint32_t queue = host::findSpace(instance.program(), "BLK");
  if (queue != RUNG_NONE)
    for (uint32_t byte = 0; byte < instance.program().spaces[queue].byte_count; ++byte)
      instance.write(host::intRef(queue, byte, 8), 0);
  enter(instance, Phase::Idle);
}

} // namespace rung::nc::technol

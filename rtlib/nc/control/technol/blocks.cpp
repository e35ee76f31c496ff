// The supervisor of part-program blocks (see blocks.h).
#include "rtlib/nc/control/technol/blocks.h"

#include "rtlib/load/program_info.h"
#include "rtlib/nc/control/technol/cells.h"
#include "rtlib/nc/technol/signals.h"

namespace rung::nc::technol {
namespace {

// STATUS_RESTART (man. l.6626-6632).
enum : uint64_t { kIdle = 0, kInit = 1, kMove = 2, kDone = 4 };

// Change pulses and dynamic functions last one block (man. l.6819, l.6852-6856, l.6958, l.6968).
bool lastsOneBlock(std::string_view name) { return name.starts_with("ZM") || name.ends_with("PID") || name == "M60PI"; }

// The mode, G00 and G33 of a block stay until the next start (man. l.6752-6780).
constexpr std::string_view kUntilNextStart[] = {"AUTPI", "REFPI", "CAPI", "G00PI", "G33PI"};

uint64_t get(const runtime::Instance& instance, const core::Place& place) { return instance.memory().read(place); }
void put(runtime::Instance& instance, const core::Place& place, uint64_t value) {
  instance.memory().write(place, value);
}

} // namespace

std::optional<runtime::Ref> commandCell(const runtime::Instance& instance, std::string_view name) {
  const std::optional<runtime::Ref> place = signalPlace(instance.program(), name);
  return place ? place : cellPlace(instance.program(), name);
}

void Blocks::reset() {
  phase_ = Phase::Idle;
  reached_ = first_ = false;
}

const Blocks::Places Blocks::kNothing{};

Blocks::Places::Places(const rung_program& program) {
  for (const std::string_view name : kUntilNextStart) untilNextStart.push_back(locateSignal(program, name));
  queue = runtime::findSpace(program, "BLK");
  const auto task = [&](std::string_view name) { return runtime::findTask(program, name); };
  init = {task("BLOCK_INIT"), locateCell(program, "@BLOCK_INIT.CONT"), locateCell(program, "@BLOCK_INIT.DONE")};
  done = {task("BLOCK_DONE"), locateCell(program, "@BLOCK_DONE.CONT"), locateCell(program, "@BLOCK_DONE.DONE")};
  initPending = locateCell(program, "@INIT.PENDING");
  startDisable = locateSignal(program, "START_DISABLE");
  startSuspend = locateSignal(program, "START_SUSPEND");
  statusRestart = locateSignal(program, "STATUS_RESTART");
  blockInProgress = locateSignal(program, "PO_F");
  positionReached = locateSignal(program, "PO_POL");
  stopDone = locateSignal(program, "PO_STOP");
  annulment = locateSignal(program, "CAPI");
  const core::Memory memory(program, nullptr); // for its places only
  for (const Signal& signal : technolSignals()) {
    const std::string_view name = signal.symbol;
    if (std::string_view(signal.area) != "I" || signal.type != SignalType::Bit || signal.direction != Direction::In)
      continue;
    const auto place = placeOf(program, signal);
    if (!place) continue;
    if (lastsOneBlock(name)) lastOneBlock.push_back(runtime::locate(memory, *place));
    if (name.starts_with("PO_OS")) motionBits.push_back(runtime::locate(memory, *place));
  }
}

bool Blocks::start(runtime::Instance& instance, std::span<const CommandValue> values) {
  if (busy()) return false;
  for (const core::Place& place : places_->untilNextStart) put(instance, place, 0);
  for (const CommandValue& value : values) {
    if (value.isReal)
      instance.memory().writeReal(value.place, value.real);
    else
      put(instance, value.place, static_cast<uint64_t>(value.integer));
  }
  put(instance, places_->positionReached, 0);
  phase_ = Phase::Starting;
  reached_ = false;
  return true;
}

bool Blocks::reached(runtime::Instance& instance) {
  if (phase_ == Phase::Idle || phase_ == Phase::Done) return false;
  reached_ = true;
  if (phase_ == Phase::Motion) endMotion(instance);
  return true;
}

void Blocks::annul(runtime::Instance& instance) {
  if (busy()) finish(instance);
  put(instance, places_->stopDone, 0);
  const CommandValue mode[] = {{.place = places_->annulment, .integer = 1}};
  start(instance, mode);
  reached(instance);
}

// A block may not start before all initialisation is done (man. l.2571-2576), nor while the program forbids or delays
// it (man. l.6456-6467).
bool Blocks::mayStart(const runtime::Instance& instance) const {
  return get(instance, places_->initPending) == 0 && get(instance, places_->startDisable) == 0 &&
         get(instance, places_->startSuspend) == 0;
}

void Blocks::enter(runtime::Instance& instance, Phase phase) {
  phase_ = phase;
  first_ = true;
  switch (phase) {
  case Phase::Idle: put(instance, places_->statusRestart, kIdle); return;
  case Phase::Starting: return;
  case Phase::Init: put(instance, places_->statusRestart, kInit); return;
  case Phase::Motion: put(instance, places_->statusRestart, kMove); return;
  case Phase::Done: put(instance, places_->statusRestart, kDone); return;
  }
}

void Blocks::supervise(runtime::Instance& instance) {
  if (phase_ == Phase::Starting && mayStart(instance)) {
    put(instance, places_->blockInProgress, 1);
    enter(instance, Phase::Init);
  }
  if (phase_ == Phase::Init && pass(instance, places_->init)) {
    enter(instance, Phase::Motion);
    if (reached_) endMotion(instance);
  }
  if (phase_ == Phase::Motion && reached_) enter(instance, Phase::Done);
  if (phase_ == Phase::Done && pass(instance, places_->done)) finish(instance);
}

// Runs a module, from its beginning in every block. True: it has finished.
bool Blocks::pass(runtime::Instance& instance, const Module& module) {
  if (first_) {
    put(instance, module.cont, 0);
    put(instance, module.done, 0);
  }
  first_ = false;
  return instance.runTask(module.task) && get(instance, module.done) != 0;
}

void Blocks::endMotion(runtime::Instance& instance) {
  put(instance, places_->positionReached, 1);
  for (const core::Place& bit : places_->motionBits) put(instance, bit, 0);
}

void Blocks::finish(runtime::Instance& instance) {
  put(instance, places_->blockInProgress, 0);
  for (const core::Place& bit : places_->lastOneBlock) put(instance, bit, 0);
  if (places_->queue != RUNG_NONE)
    for (uint32_t byte = 0; byte < instance.program().spaces[places_->queue].byte_count; ++byte)
      instance.memory().writeByte(places_->queue, byte, 0);
  enter(instance, Phase::Idle);
}

} // namespace rung::nc::technol

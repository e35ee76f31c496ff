// Helpers for the lowering of functions.
#include "frontend/network/lower/lower_function.h"

#include <fmt/format.h>

#include <algorithm>

#include "frontend/network/lower/lower_module.h"

namespace rung::frontend::network {

ir::ValueId isIn(ir::RungBuilder& b, ir::ValueId number, uint64_t set) {
  const ir::ValueId bits = b.constant(ir::Type::I64, static_cast<int64_t>(set));
  const ir::ValueId shifted = b.shrU(bits, b.zextOrTrunc(ir::Type::I32, number));
  return b.trunc(ir::Type::Bit, shifted);
}

Lowering::Lowering(ModuleLowering& module, RoutineContext& routine, ir::RungBuilder& builder, const Network& net,
                   std::span<const ir::ValueId> conditions, std::string_view slotPrefix)
    : b(builder), network(net), function(net.function), module_(module), routine_(routine), conditions_(conditions),
      slotPrefix_(slotPrefix) {}

ir::ValueId Lowering::load(ir::Type type, const Address& address) {
  routine_.level->use(address, std::max(ir::byteWidth(type), 1u));
  return b.load(type, routine_.level->placeOf(address));
}

void Lowering::store(const Address& address, ir::ValueId value) {
  routine_.level->use(address, std::max(ir::byteWidth(b.typeOf(value)), 1u));
  b.store(routine_.level->placeOf(address), value);
}

ir::Window Lowering::window(const Address& address, uint32_t bytes, uint32_t legal) const {
  routine_.level->use(address, bytes);
  return {routine_.level->spaceOf(address), address.byte, legal};
}

const Language& Lowering::language() const { return module_.language(); }

std::optional<bool> Lowering::constantOf(size_t condition) const {
  if (module_.execution().constants.empty()) return std::nullopt;
  return constantCondition(language(), network, condition);
}

Address Lowering::result(uint32_t offset) const { return plus(module_.execution().results, offset); }

uint32_t Lowering::room(const Address& address) const { return language().at(address.area).room(address.byte); }

ir::ValueId Lowering::operand(size_t i, ir::Type type) {
  return param(i).isAddress ? load(type, param(i).address) : b.constant(type, param(i).value);
}

ir::SlotId Lowering::slot(std::string_view role, ir::Type type, int64_t init) {
  return module_.slot(fmt::format("{}{}", slotPrefix_, role), type, init, false);
}

ir::TimerCell Lowering::wordCell(const Address& address) const {
  const ir::Place place = routine_.level->placeOf(address);
  return {.type = ir::Type::I16, .slot = {}, .space = place.space, .byte = place.byte};
}

void Lowering::addTimer(ir::Timer timer) {
  std::vector<ir::Timer>& timers = module_.module().timers;
  const auto isSame = [&](const ir::Timer& other) { return other.time.slot == timer.time.slot; };
  if (std::ranges::any_of(timers, isSame)) return;
  const std::string_view instruction = slotPrefix_.substr(slotPrefix_.find('/') + 1);
  timer.name = frontend::Numbering::withoutNumber(std::string(instruction.substr(0, instruction.size() - 1)));
  timers.push_back(std::move(timer));
}

ir::ValueId Lowering::scanTime() { return b.slotLoad(routine_.level->scanTime); }

bool Lowering::onceEachRun() const { return routine_.level->straight && routine_.unit == routine_.level->level; }

ir::ValueId Lowering::sinceLastRun() { return b.add(b.sub(b.now(), b.slotLoad(routine_.level->clock)), scanTime()); }

ir::SlotId Lowering::shared(const std::string& key, ir::Type type) { return module_.slot(key, type, 0, false); }

// Stores the current run count of each level. A unit that several levels run shares its state, but each level has its
// own count. A level that runs later in the same slot belongs to the same scan.
void Lowering::markRun() {
  for (const LevelState& level : module_.levels()) {
    if (!level.routines[routine_.unit].valid()) continue;
    const ir::ValueId runs = b.slotLoad(level.runs);
    b.slotStore(runMark(level), level.level > routine_.level->level ? b.add(runs, b.i32(1)) : runs);
  }
}

ir::SlotId Lowering::runMark(const LevelState& level) {
  return slot(fmt::format("mark{}", level.level + 1), ir::Type::I32);
}

ir::ValueId Lowering::runsSinceMark() {
  return b.sub(b.slotLoad(routine_.level->runs), b.slotLoad(runMark(*routine_.level)));
}

ir::ServiceId Lowering::service(const nc::ServiceRow& row) { return module_.service(row); }

ir::Window Lowering::hidden(const std::string& name, uint32_t bytes, uint32_t legal) {
  return {module_.hiddenSpace(name, bytes), 0, legal};
}

ir::Window Lowering::constants(std::string_view bytes, uint32_t legal) {
  return {module_.constantSpace(bytes), 0, legal};
}

ir::ValueId Lowering::oldOutput() { return b.slotLoad(slot("W", ir::Type::Bit)); }

void Lowering::latchedOutput(ir::ValueId execute, ir::ValueId reset, const std::function<ir::ValueId()>& body) {
  ir::ValueId keep = oldOutput();
  if (reset.valid()) {
    const ir::ValueId free = b.not_(reset);
    keep = b.and_(keep, free);
    execute = b.and_(execute, free);
  }
  output_ = b.choose(execute, body, [&] { return keep; });
  b.slotStore(slot("W", ir::Type::Bit), output_);
}

void Lowering::resettable(const std::function<ir::ValueId()>& body) {
  latchedOutput(act(), conditions_[conditions_.size() - 2], body);
}

uint32_t Lowering::targetRung() const { return routine_.rungOf[network.target]; }
ir::RoutineId Lowering::callee() const { return routine_.level->routines[network.callee]; }
ir::SlotId Lowering::commonLine() { return module_.slot(fmt::format("{}com", slotPrefix_), ir::Type::Bit, 0, true); }
ir::SlotId Lowering::leaveTarget() { return module_.leaveTarget(); }

// Ends, jumps, calls and the common line (§7.1, §7.16-7.18).

// JMPE, COME and LBL only mark a place.
void lowerMark(Lowering&) {}

// END1, END2 and SPE return to the caller; a level ends.
void lowerEnd(Lowering& f) { f.b.ret(); }

// JMP and JMPB.
void lowerJump(Lowering& f) { f.b.gotoRung(f.targetRung(), f.act()); }

// CALL has a condition; CALLU is unconditional.
void lowerCall(Lowering& f) {
  f.b.call(f.callee(), f.function.row->control == Control::Call ? f.act() : ir::ValueId{});
}

// JMPC: every caller up to the main program checks the slot (P43).
void lowerLeave(Lowering& f) {
  f.b.when(f.act(), [&] { f.b.slotStore(f.leaveTarget(), f.b.i32(f.network.target + 1)); });
  f.b.ret(f.act());
}

void lowerCommonLine(Lowering& f) { f.b.slotStore(f.commonLine(), f.act()); }

} // namespace rung::frontend::network

// All units of the control (see units.h).
#include "machine/io/can/units.h"

namespace rung::io {
namespace {

bool isItem(InoutsItem item) {
  const bool width = item.bytes == 1 || item.bytes == 2 || item.bytes == 4;
  return width && item.offset < inouts::kBytes && item.offset + item.bytes <= inouts::kBytes;
}

} // namespace

void CanUnits::configure(uint32_t group, uint32_t units) {
  std::erase_if(units_, [&](const CanUnit& unit) { return unit.group() == group; });
  const auto after =
      std::find_if(units_.begin(), units_.end(), [&](const CanUnit& unit) { return unit.group() > group; });
  const auto place = units_.insert(after, units, CanUnit(group, 1));
  for (uint32_t i = 0; i < units; ++i) place[i] = CanUnit(group, i + 1);
  numbers_ = {};
  for (size_t i = 0; i < units_.size(); ++i) numbers_[units_[i].node()] = static_cast<uint8_t>(i + 1);
}

void CanUnits::setControl(uint32_t group, uint32_t board, uint8_t control) {
  if (const uint32_t number = numberOf(group, board)) units_[number - 1].setControl(control);
}

uint32_t CanUnits::count(uint32_t group) const {
  return static_cast<uint32_t>(
      std::count_if(units_.begin(), units_.end(), [&](const CanUnit& unit) { return unit.group() == group; }));
}

void CanUnits::reset() {
  for (CanUnit& unit : units_) unit.power();
  messages_.clear();
  display_ = {};
  sinceSync_ = 0;
  started_ = false;
}

// Other nodes of the channel are the program's: they are started, and then left alone.
void CanUnits::prepare(CanPort& port) {
  if (units_.empty()) return;
  if (!started_) started_ = port.transmit(nodeCommand(kStartNode, kAllNodes));
  for (CanUnit& unit : units_) unit.tick(port, messages_);
}

bool CanUnits::areStarted() const { return std::ranges::all_of(units_, &CanUnit::isStarted); }

void CanUnits::tick(const UnitOrders& orders, UnitStates& states, CanPort& port) {
  if (units_.empty()) return;
  prepare(port);
  output(orders, states);
  if (++sinceSync_ >= syncPeriod_) synchronize(orders, port);
  states.groups = {};
  for (const CanUnit& unit : units_) show(unit, states);
}

void CanUnits::output(const UnitOrders& orders, UnitStates& states) {
  states.zeroed = std::any_of(units_.begin(), units_.end(), [](const CanUnit& unit) { return unit.zeroesAll(); });
  for (CanUnit& unit : units_) {
    if (unit.group() != kInOut08) continue;
    const uint32_t first = kUnitOutputs * (unit.board() - 1);
    for (uint32_t i = 0; i < kUnitOutputs; ++i)
      unit.output(i, orders.out[first + i], states.errors[first + i], states.zeroed);
  }
}

// The packets of outputs come before SYNC, on which the units take them over and answer with their inputs.
void CanUnits::synchronize(const UnitOrders& orders, CanPort& port) {
  sinceSync_ = 0;
  for (uint32_t i = 0; i < kHandwheels; ++i)
    if (!orders.displayBusy[i]) display_[i] = orders.display[i];
  for (CanUnit& unit : units_)
    if (unit.isStarted()) port.transmit(unit.outputPacket(display_[(unit.board() - 1) % kHandwheels]));
  port.transmit(packetOf(kSync, {}));
}

void CanUnits::show(const CanUnit& unit, UnitStates& states) {
  const Inouts& data = unit.data();
  const uint32_t number = unit.board() - 1;
  if (unit.group() == kInOut08)
    std::copy_n(&data.at(inouts::kIn), kUnitInputs, &states.in[size_t{kUnitInputs} * number]);
  if (unit.group() == kHandwheel) std::copy_n(&data.at(inouts::kIn), 2, states.keys[number].begin());
  GroupCodes& codes = states.groups[unit.group() - 1];
  const auto error = static_cast<uint8_t>(data.get(inouts::kError));
  const auto board = static_cast<uint8_t>(unit.board());
  if (error != 0 && codes.errorNumber == 0) codes.errorCode = error, codes.errorNumber = board;
  if (unit.hasTimedOut() && codes.timeoutNumber == 0) codes.timeoutCode = 1, codes.timeoutNumber = board;
}

bool CanUnits::take(const CanPacket& packet) {
  const uint32_t number = numbers_[packet.node()];
  return number != 0 && units_[number - 1].take(packet);
}

uint32_t CanUnits::numberOf(uint32_t group, uint32_t board) const {
  if (group < 1 || group > kUnitGroups || board < 1 || board > kMostUnits[group - 1]) return 0;
  return numbers_[nodeOf(group, board)];
}

const Inouts* CanUnits::find(uint32_t group, uint32_t board) const {
  const uint32_t number = numberOf(group, board);
  return number == 0 ? nullptr : &units_[number - 1].data();
}

bool CanUnits::read(uint32_t group, uint32_t board, InoutsItem item, uint32_t& value) const {
  const Inouts* data = find(group, board);
  if (data == nullptr || !isItem(item)) return false;
  value = data->get(item);
  return true;
}

bool CanUnits::write(uint32_t group, uint32_t board, InoutsItem item, uint32_t value) {
  const uint32_t number = numberOf(group, board);
  if (number == 0 || !isItem(item)) return false;
  units_[number - 1].write(item, value);
  return true;
}

} // namespace rung::io

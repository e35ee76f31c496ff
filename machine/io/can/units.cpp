// All units of the control.
#include "machine/io/can/units.h"

#include <bit>
#include <utility>

#include "machine/io/can/unit.h"

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

// Other nodes of the channel belong to the program: they are only started.
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

// Packets with outputs precede SYNC, on which the units apply them and answer with their inputs.
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

// The SDO requests to one unit, one at a time.

namespace {

using namespace inouts;

constexpr uint32_t kPatienceMs = 50; // time limit; after it the next request is sent, and this one is repeated later
constexpr uint32_t kScanningOutputs = 8;
constexpr uint8_t kCharacters = 4; // characters in TOC_DISPLS

enum class Kind : uint8_t { Item, Register, Value, Analogue, Matrix };

struct Request {
  sdo::Object object;
  Kind kind = Kind::Item;
  InoutsItem item;   // destination of the answer
  uint8_t value = 0; // value to write
};

// All requests except those of the mapping, whose bits lie between kWheelMode and kAnalogue.
constexpr Request kRequests[] = {
    {{kShortedOutput, 1}, Kind::Item, {kShort}},
    {{kShortedOutput, 2}, Kind::Item, {kShort + 1}},
    {{kShortedOutput, 3}, Kind::Item, {kShort + 2}},
    {sdo::kErrorRegister, Kind::Register, {}},
    {kWheelMode, Kind::Value, {}, 1},
    {kTpdo2Id, Kind::Analogue, {}},     // sent with each SYNC, which is the units' transmission type, or never
    {kMatrixOutputs, Kind::Matrix, {}}, // outputs that scan the matrix (man. l.4578-4587)
    {{kDisplay, kDisplayInitialise}, Kind::Value, {}, 1},
    {{kDisplay, kDisplayEnable}, Kind::Value, {}, 1},
    {{kDisplay, kDisplayMask}, Kind::Value, {}, 0xFF},
    {{kDisplay, kDisplayCount}, Kind::Value, {}, kCharacters},
    {sdo::kVendor, Kind::Item, kVendor},
    {sdo::kName, Kind::Item, kDeviceName},
    {sdo::kHardwareVersion, Kind::Item, kHardwareVersion},
    {sdo::kSoftwareVersion, Kind::Item, kSoftwareVersion},
};
constexpr uint32_t kMappings = 2 * kPdoFields;
static_assert(std::size(kRequests) + kMappings == std::bit_width(requests::kIdentity));

const Request& rowOf(uint32_t bit) {
  const auto number = static_cast<uint32_t>(std::countr_zero(bit));
  return kRequests[number < requests::kMappingAt ? number : number - kMappings];
}

// Number of a mapping request, 0 to 15.
uint32_t mappingNumber(uint32_t bit) { return static_cast<uint32_t>(std::countr_zero(bit)) - requests::kMappingAt; }

sdo::Object objectOf(uint32_t bit) {
  if ((bit & requests::kMapping) == 0) return rowOf(bit).object;
  const uint32_t number = mappingNumber(bit);
  return {number < kPdoFields ? kRpdoMapping : kTpdoMapping, static_cast<uint8_t>(number % kPdoFields + 1)};
}

sdo::Object fieldOf(uint32_t bit, uint32_t group) {
  const uint32_t number = mappingNumber(bit);
  if (number < kPdoFields) return (group == kHandwheel ? kWheelOutputFields : kOutputFields)[number];
  return (group == kHandwheel ? kWheelInputFields : kInputFields)[number - kPdoFields];
}

CanPacket packetOf(const Request& request, uint32_t node, uint8_t mode) {
  switch (request.kind) {
  case Kind::Value: return sdo::write(node, request.object, 1, request.value);
  case Kind::Analogue:
    return sdo::write(node, request.object, 4, kTpdo2 + node + (mode == kModeAnalogue ? 0 : kNotValid));
  case Kind::Matrix: return sdo::write(node, request.object, 2, mode == kModeMatrix ? kScanningOutputs : 0);
  default: return sdo::read(node, request.object);
  }
}

uint32_t lowest(uint32_t bits) { return bits & (~bits + 1); }

} // namespace

bool CanUnit::isPending(uint32_t requests) const { return ((waiting_ | late_ | underWay_) & requests) != 0; }

// A unit from which no packets are received is sent a request only from time to time.
void CanUnit::ask(CanPort& port, UnitMessages& messages) {
  data_.set(kShortRequest, isPending(requests::kShorts) ? 1 : 0);
  if (segment_ == Segment::Due && port.transmit(sdo::packet(kSdoRequest + node(), sdo::kReadSegment, {}, 0)))
    segment_ = Segment::Asked;
  if (underWay_ != 0 && ++askedMs_ < kPatienceMs) return;
  if (underWay_ != 0) giveUp(messages);
  const uint32_t next = lowest(waiting_ != 0 ? waiting_ : late_);
  if (next == 0 || (unheardMs_ > kUnitTimeoutMs && unheardMs_ % kUnitTimeoutMs != 0)) return;
  const bool isMapping = (next & requests::kMapping) != 0;
  const CanPacket request = isMapping ? sdo::write(node(), objectOf(next), 4, mappingOf(fieldOf(next, group_)))
                                      : packetOf(rowOf(next), node(), mode_);
  if (!port.transmit(request)) return;
  waiting_ &= ~next; // cleared now, because a new reason for the request may occur from now on
  late_ &= ~next;
  underWay_ = next;
  askedMs_ = 0;
}

void CanUnit::giveUp(UnitMessages& messages) {
  const bool isHeard = data_.get(kPresent) != 0 && unheardMs_ < kUnitTimeoutMs;
  if (isHeard && !saidSdoSilent_)
    report(messages, {.kind = UnitMessage::Kind::SilentSdo, .object = objectOf(underWay_)});
  saidSdoSilent_ = saidSdoSilent_ || isHeard;
  isSdoSilent_ = isSdoSilent_ || isHeard;
  late_ |= underWay_;
  underWay_ = 0;
  segment_ = Segment::None;
}

// SEND_REQ: sends the packet SEND to this unit; its answer is RESP (man. l.4105-4106).
void CanUnit::sendRequested(CanPort& port) {
  if (data_.get(kSendRequest) == 0) return;
  CanPacket packet{.id = static_cast<uint16_t>(kSdoRequest + node()), .length = kCanDataBytes};
  std::copy_n(&data_.at(kSend + 4), kCanDataBytes, packet.data);
  if (port.transmit(packet)) data_.set(kSendRequest, 0);
}

// An answer that the control has not requested is for the program, or for SEND_REQ. All answers have eight bytes (CiA
// 301).
bool CanUnit::takeAnswer(const CanPacket& packet) {
  const bool isSegment = segment_ == Segment::Asked && (sdo::command(packet) & 0xE0) == 0;
  const bool isWhole = packet.length == kCanDataBytes;
  if (underWay_ != 0 && isWhole && (isSegment || sdo::object(packet) == objectOf(underWay_)))
    return finish(packet), true;
  putNumber(&data_.at(kAnswer), 2, packet.id);
  data_.at(kAnswer + 3) = packet.length;
  std::copy_n(packet.data, kCanDataBytes, &data_.at(kAnswer + 4));
  data_.count(kAnswerCount);
  return false;
}

// Rejected requests are not repeated. Of a segmented text, the first segment is enough.
void CanUnit::finish(const CanPacket& answer) {
  isSdoSilent_ = saidSdoSilent_ = false;
  if (segment_ == Segment::None && sdo::command(answer) == sdo::kSegmented) {
    segment_ = Segment::Due;
    askedMs_ = 0;
    return;
  }
  const uint32_t bit = std::exchange(underWay_, 0);
  const bool isText = std::exchange(segment_, Segment::None) == Segment::Asked;
  if (sdo::isAbort(answer)) return refuse(bit, sdo::value(answer));
  if ((bit & requests::kMapping) != 0) return;
  const Request& request = rowOf(bit);
  const uint32_t value = isText ? numberAt(answer.data + 1, 4) : sdo::value(answer);
  if (request.kind == Kind::Register) {
    registered_ = static_cast<uint8_t>(value);
    if ((value & kErrorShort) != 0) waiting_ |= requests::kShorts;
  }
  if (request.kind == Kind::Item) data_.set(request.item, value);
}

// Objects that are only read may be missing in a unit.
void CanUnit::refuse(uint32_t bit, uint32_t abort) {
  if ((bit & requests::kBeforeStart) == 0) return;
  refused_ |= bit;
  aborted_ = objectOf(bit);
  abort_ = abort;
}

} // namespace rung::io

// One unit: what is asked of it by SDO, one request at a time (see unit.h).
#include "machine/io/can/unit_requests.h"

#include <bit>
#include <utility>

#include "machine/io/can/unit.h"
#include "machine/io/can/unit_mapping.h"

namespace rung::io {
namespace {

using namespace inouts;

constexpr uint32_t kPatienceMs = 50; // then the next request is sent; this one comes again
constexpr uint32_t kScanningOutputs = 8;
constexpr uint8_t kCharacters = 4; // of TOC_DISPLS

enum class Kind : uint8_t { Item, Register, Value, Analogue, Matrix };

struct Request {
  sdo::Object object;
  Kind kind = Kind::Item;
  InoutsItem item;   // where the answer goes
  uint8_t value = 0; // what is written
};

// Without those of the mapping, which lie between the wheel's mode and TPDO2.
constexpr Request kRequests[] = {
    {{kShortedOutput, 1}, Kind::Item, {kShort}},
    {{kShortedOutput, 2}, Kind::Item, {kShort + 1}},
    {{kShortedOutput, 3}, Kind::Item, {kShort + 2}},
    {sdo::kErrorRegister, Kind::Register, {}},
    {kWheelMode, Kind::Value, {}, 1},
    {kTpdo2Id, Kind::Analogue, {}},     // with each SYNC, which is the type of a unit's transmissions, or never
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

// Of 0 to 15.
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

// A unit that is not heard is asked now and then, whatever is next.
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
  waiting_ &= ~next; // what makes it necessary again may happen from now on
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

// SEND_REQ: the packet SEND goes to this unit, its answer is RESP (man. l.4105-4106).
void CanUnit::sendRequested(CanPort& port) {
  if (data_.get(kSendRequest) == 0) return;
  CanPacket packet{.id = static_cast<uint16_t>(kSdoRequest + node()), .length = kCanDataBytes};
  std::copy_n(&data_.at(kSend + 4), kCanDataBytes, packet.data);
  if (port.transmit(packet)) data_.set(kSendRequest, 0);
}

// An answer that the control has not asked for is one for the program, or for SEND_REQ. All answers have eight bytes
// (CiA 301).
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

// What a unit does not have is not asked again. Of a text in segments the first one shows enough.
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

// A unit may lack what is read.
void CanUnit::refuse(uint32_t bit, uint32_t abort) {
  if ((bit & requests::kBeforeStart) == 0) return;
  refused_ |= bit;
  aborted_ = objectOf(bit);
  abort_ = abort;
}

} // namespace rung::io

// One unit: what is asked of it by SDO, one request at a time (see unit.h).
#include "tools/devices/can/unit_requests.h"

#include <bit>

#include "tools/devices/can/unit.h"

namespace rung::devices {
namespace {

using namespace inouts;

constexpr uint32_t kPatienceMs = 50; // then the next request is sent; this one comes again
constexpr uint32_t kMatrixOutputs = 8;

enum class Kind : uint8_t { Item, Register, Analogue, Matrix };

struct Request {
  sdo::Object object;
  Kind kind = Kind::Item;
  InoutsItem item; // where the answer goes
};

constexpr Request kRequests[] = {
    {{0x2101, 1}, Kind::Item, {kShort}},
    {{0x2101, 2}, Kind::Item, {kShort + 1}},
    {{0x2101, 3}, Kind::Item, {kShort + 2}},
    {{0x1001, 0}, Kind::Register, {}},
    {{0x1801, 2}, Kind::Analogue, {}}, // with each SYNC, or never
    {{0x2109, 0}, Kind::Matrix, {}},   // outputs that scan the matrix (man. l.4578-4587)
    {{0x1018, 1}, Kind::Item, kVendor},
    {{0x1008, 0}, Kind::Item, kDeviceName},
    {{0x1009, 0}, Kind::Item, kHardwareVersion},
    {{0x100A, 0}, Kind::Item, kSoftwareVersion},
};

const Request& rowOf(uint32_t bit) { return kRequests[std::countr_zero(bit)]; }

CanPacket packetOf(const Request& request, uint32_t node, uint8_t mode) {
  switch (request.kind) {
  case Kind::Analogue: return sdo::write(node, request.object, 1, mode == kModeAnalogue ? 1 : 0);
  case Kind::Matrix: return sdo::write(node, request.object, 2, mode == kModeMatrix ? kMatrixOutputs : 0);
  default: return sdo::read(node, request.object);
  }
}

} // namespace

bool CanUnit::isPending(uint32_t requests) const { return ((waiting_ | underWay_) & requests) != 0; }

void CanUnit::askNext(CanPort& port) {
  data_.set(kShortRequest, isPending(requests::kShorts) ? 1 : 0);
  if (segment_ == Segment::Due && port.transmit(sdo::packet(kSdoRequest + node(), sdo::kReadSegment, {}, 0)))
    segment_ = Segment::Asked;
  if (underWay_ != 0 && ++askedMs_ < kPatienceMs) return;
  waiting_ |= underWay_; // once more, after the others
  underWay_ = 0;
  segment_ = Segment::None;
  if (waiting_ == 0 || silentMs_ > kUnitTimeoutMs) return;
  const uint32_t next = waiting_ & (~waiting_ + 1);
  if (!port.transmit(packetOf(rowOf(next), node(), mode_))) return;
  waiting_ &= ~next; // what makes it necessary again may happen from now on
  underWay_ = next;
  askedMs_ = 0;
}

// SEND_REQ: the packet SEND goes to this unit, its answer is RESP (man. l.4105-4106).
void CanUnit::sendRequested(CanPort& port) {
  if (data_.get(kSendRequest) == 0) return;
  CanPacket packet{.id = static_cast<uint16_t>(kSdoRequest + node()), .length = kCanDataBytes};
  std::copy_n(&data_.at(kSend + 4), kCanDataBytes, packet.data);
  if (port.transmit(packet)) data_.set(kSendRequest, 0);
}

// An answer that the control has not asked for is one for the program, or for SEND_REQ.
bool CanUnit::takeAnswer(const CanPacket& packet) {
  const bool isSegment = segment_ == Segment::Asked && (sdo::command(packet) & 0xE0) == 0;
  if (underWay_ != 0 && (isSegment || sdo::object(packet) == rowOf(underWay_).object)) return finish(packet), true;
  putNumber(&data_.at(kAnswer), 2, packet.id);
  data_.at(kAnswer + 3) = packet.length;
  std::copy_n(packet.data, kCanDataBytes, &data_.at(kAnswer + 4));
  data_.count(kAnswerCount);
  return false;
}

// What a unit does not have is not asked again. Of a text in segments the first one shows enough.
void CanUnit::finish(const CanPacket& answer) {
  if (segment_ == Segment::None && sdo::command(answer) == sdo::kSegmented) {
    segment_ = Segment::Due;
    askedMs_ = 0;
    return;
  }
  const Request& request = rowOf(underWay_);
  const uint32_t value = segment_ == Segment::Asked ? numberAt(answer.data + 1, 4) : sdo::value(answer);
  if (request.kind == Kind::Register && !sdo::isAbort(answer)) registered_ = static_cast<uint8_t>(value);
  if (request.kind == Kind::Item && !sdo::isAbort(answer)) data_.set(request.item, value);
  underWay_ = 0;
  segment_ = Segment::None;
}

} // namespace rung::devices

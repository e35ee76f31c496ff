// Requests to the CAN bus (see can_requests.h).
#include "machine/io/can/can_requests.h"

#include <algorithm>
#include <span>

#include "rtlib/nc/technol/signals.h"
#include "rtlib/text/number.h"

namespace rung::io {

namespace {

bool isChannel(const DeviceCall& call) { return call.arg(0) == 1 || call.arg(0) == 2; }
uint32_t channelOf(const DeviceCall& call) { return static_cast<uint32_t>(call.arg(0)); }

// Widths of the items of INOUTS, by offset.
std::array<uint8_t, inouts::kBytes> itemWidths() {
  std::array<uint8_t, inouts::kBytes> widths{};
  widths.fill(1);
  for (const nc::Signal& signal : nc::technolSignals())
    if (std::string_view(signal.area) == "INOUTS" && signal.byteOffset < widths.size())
      widths[signal.byteOffset] = static_cast<uint8_t>(std::max(1u, nc::elementBytes(signal.type)));
  return widths;
}

// The place in another program of the bytes that an argument names; nothing: it does not have them.
std::optional<int64_t> movedBytes(const runtime::Relocation& relocation, int64_t argument) noexcept {
  const nc::technol::ArgumentBytes at = nc::technol::bytesOfArgument(argument);
  runtime::Ref bytes = runtime::intRef(at.space, at.first, 8);
  bytes.count = at.count;
  const auto moved = relocation.place(bytes);
  if (!moved) return std::nullopt;
  return nc::technol::bytesArgument(moved->space, at.count, moved->byte);
}

} // namespace

CanCalls::CanCalls(CanController& can) : can_(can), itemWidths_(itemWidths()) {}

void CanCalls::answer(DeviceCall& call) {
  switch (call.kind()) {
  case ServiceKind::CanSend: return send(call);
  case ServiceKind::CanReceive: return receive(call);
  case ServiceKind::CanOrder: return order(call);
  case ServiceKind::CanDeleteOrder:
  case ServiceKind::CanEndOrder: return endOrder(call);
  case ServiceKind::CanReadItem: return readItem(call);
  case ServiceKind::CanWriteItem: return writeItem(call);
  default: return sendToDrive(call);
  }
}

// can id rtr len data -> DR
void CanCalls::send(DeviceCall& call) {
  CanPacket packet{.id = static_cast<uint16_t>(call.arg(1)),
                   .remote = static_cast<uint8_t>(call.arg(2)),
                   .length = static_cast<uint8_t>(call.arg(3))};
  call.bytes(4, packet.data);
  const auto error = isChannel(call) ? can_.channel(channelOf(call)).send(packet) : CanError::SendQueueFull;
  call.set(0, static_cast<int64_t>(error));
}

// can -> DR id rtr data
void CanCalls::receive(DeviceCall& call) {
  CanPacket packet;
  const auto error = isChannel(call) ? can_.channel(channelOf(call)).receive(packet) : CanError::NothingReceived;
  call.set(0, static_cast<int64_t>(error));
  call.set(1, packet.id);
  call.set(2, packet.remote);
  call.setBytes(3, std::span(packet.data).first(packet.length));
}

// can objl objh idl idh proc pmsg -> RLO DR
void CanCalls::order(DeviceCall& call) {
  if (!isChannel(call)) return;
  const uint32_t handle = can_.channel(channelOf(call))
                              .order({.objectLow = call.number(1),
                                      .objectHigh = call.number(2),
                                      .nodeLow = call.number(3),
                                      .nodeHigh = call.number(4)});
  Order* free = std::ranges::find(orders_, 0u, &Order::handle);
  if (handle == 0 || free == orders_.end()) return;
  *free = {.handle = handle, .buffer = call.arg(6), .procedure = static_cast<uint64_t>(call.arg(5))};
  call.set(0, 1);
  call.set(1, handle);
}

// handle -> RLO
void CanCalls::endOrder(DeviceCall& call) {
  const bool known = can_.orders().remove(call.number(0));
  Order* order = std::ranges::find(orders_, call.number(0), &Order::handle);
  if (known && order != orders_.end()) *order = {};
  call.set(0, known ? 1 : 0);
}

void CanCalls::relocate(const CanPlaces& former, const CanPlaces& now, const runtime::Relocation& relocation) noexcept {
  for (Order& order : orders_) {
    if (order.handle == 0) continue;
    const auto buffer = movedBytes(relocation, order.buffer);
    const auto procedure = now.numberOf(former, order.procedure);
    if (buffer && procedure)
      order.buffer = *buffer, order.procedure = *procedure;
    else
      end(order, {.handle = order.handle, .lacksBuffer = !buffer, .lacksProcedure = !procedure});
  }
}

void CanCalls::end(Order& order, const EndedOrder& why) noexcept {
  can_.orders().remove(order.handle);
  order = {};
  ended_.push(why);
}

std::string textOf(const EndedOrder& order) {
  const char* const lacks = !order.lacksBuffer      ? "procedure"
                            : !order.lacksProcedure ? "buffer"
                                                    : "buffer and its procedure";
  return "CAN_RECV_REQ: the order with the handle " + std::to_string(order.handle) +
         " has ended, as the new program does not have its " + lacks;
}

// Programs name an item by the offset of the member.
InoutsItem CanCalls::itemAt(int64_t offset) const {
  const auto at = static_cast<uint32_t>(offset);
  return {.offset = at, .bytes = at < itemWidths_.size() ? itemWidths_[at] : 1u};
}

// can group board item -> RLO DR
void CanCalls::readItem(DeviceCall& call) {
  uint32_t value = 0;
  const bool known =
      isChannel(call) && can_.readItem(channelOf(call), call.number(1), call.number(2), itemAt(call.arg(3)), value);
  call.set(0, known ? 0 : 1);
  call.set(1, value);
}

// can group board item val -> RLO
void CanCalls::writeItem(DeviceCall& call) {
  const bool known = isChannel(call) && can_.writeItem(channelOf(call), call.number(1), call.number(2),
                                                       itemAt(call.arg(3)), static_cast<uint32_t>(call.arg(4)));
  call.set(0, known ? 0 : 1);
}

// axis data
void CanCalls::sendToDrive(DeviceCall& call) {
  if (call.number(0) < 1 || call.number(0) > kMostDrives) return;
  CanPacket packet{.length = kCanDataBytes};
  call.bytes(1, packet.data);
  can_.sendToDrive(call.number(0), packet);
  asksDrive_ = true;
}

void CanCalls::showDrive(const core::Memory& memory, const CanPlaces& places) {
  if (!asksDrive_ || can_.driveBusy() != 0) return;
  asksDrive_ = false;
  places.writeDriveAnswer(memory, can_.driveAnswer());
}

// Copies all twelve bytes to the buffer (inventory of the services, 9), then runs the procedure with the channel in DR
// (man. l.3834-3840).
void CanCalls::run(runtime::Instance& instance, const CanPlaces& places, uint32_t channel, const CanPacket& packet) {
  const CanMatches matches = can_.channel(channel).deliver(packet);
  for (const uint32_t handle : matches.all()) {
    const Order* order = std::ranges::find(orders_, handle, &Order::handle);
    if (order == orders_.end() || instance.stopped() || instance.faulted()) continue;
    const nc::technol::ArgumentBytes at = nc::technol::bytesOfArgument(order->buffer);
    const core::Memory memory = instance.memory();
    memory.write(at.space, at.first, 2, packet.id);
    memory.writeByte(at.space, at.first + 2, packet.remote);
    memory.writeByte(at.space, at.first + 3, packet.length);
    for (uint32_t i = 0; i < kCanDataBytes; ++i) memory.writeByte(at.space, at.first + 4 + i, packet.data[i]);
    if (const auto* procedure = places.procedure(order->procedure)) procedure->run(instance, channel, false);
  }
}

void CanCalls::deliver(runtime::Instance& instance, const CanPlaces& places) {
  CanPacket packet;
  for (uint32_t channel = 1; channel <= 2; ++channel)
    while (can_.takeReceived(channel, packet)) run(instance, places, channel, packet);
}

// ---- cells ---------------------------------------------------------------------------------------------------------

using nc::technol::locateElements;
using nc::technol::locateSignal;

CanPlaces::CanPlaces(const rung_program& program) {
  for (uint32_t i = 0; i < in_.size(); ++i) in_[i] = locateSignal(program, "P" + std::to_string(i + 1) + "IN");
  for (uint32_t i = 0; i < out_.size(); ++i) {
    out_[i] = locateSignal(program, "P" + std::to_string(i) + "OUT");
    errors_[i] = locateSignal(program, "ERRLI_P" + std::to_string(i) + "OUT");
  }
  locateElements(program, "CAN_DRIVE_CMD", command_);
  locateElements(program, "CAN_DRIVE_STAT", status_);
  locateElements(program, "CAN_DRIVE_MSTAT", manufacturer_);
  constexpr const char* kGroups[] = {"CAN_IO_", "CAN_MAT_", "CAN_TOC_"};
  constexpr const char* kCodes[] = {"ERROR_CODE", "ERROR_NUM", "TIMEOUT_CODE", "TIMEOUT_NUM"};
  for (uint32_t group = 0; group < std::size(kGroups) && group < codes_.size(); ++group)
    for (uint32_t i = 0; i < std::size(kCodes); ++i)
      codes_[group][i] = locateSignal(program, std::string(kGroups[group]) + kCodes[i]);
  for (uint32_t wheel = 0; wheel < kHandwheels; ++wheel) {
    const std::string number = std::to_string(wheel + 1);
    keys_[wheel] = {locateSignal(program, "PTLTOC_P" + number), locateSignal(program, "PTLTOC_P" + number + "_2")};
    displayBusy_[wheel] = locateSignal(program, "BUSY_DISPTOC" + number);
    if (const auto display = nc::technol::signalPlace(program, "DISPTOC" + number + ".TOC_ROW"))
      for (uint32_t i = 0; i < display_[wheel].size(); ++i)
        display_[wheel][i] = runtime::locate({program, nullptr}, runtime::intRef(display->space, display->byte + i, 8));
  }
  const std::string packet = "CAN_AX_RECV_PACKET.";
  answerId_ = locateSignal(program, packet + "CAN_ID");
  answerRemote_ = locateSignal(program, packet + "CAN_RTR");
  answerLength_ = locateSignal(program, packet + "CAN_LEN");
  for (uint32_t i = 0; i < answerData_.size(); ++i)
    answerData_[i] = locateSignal(program, packet + (i == 0 ? "CAN_DATA" : "CAN_DATA_" + std::to_string(i)));
  driveBusy_ = locateSignal(program, "CAN_AX_BUSY");
  locateProcedures(program);
}

// CAN_RECV_REQ.2.NAME
void CanPlaces::locateProcedures(const rung_program& program) {
  for (const rung_task& task : std::span(program.tasks, program.task_count)) {
    std::string_view name = task.name;
    if (!name.starts_with(nc::technol::kPacketTask)) continue;
    name.remove_prefix(nc::technol::kPacketTask.size());
    const size_t point = std::min(name.find('.'), name.size());
    const auto number = text::numberIn<uint32_t>(name.substr(0, point));
    if (!number) continue;
    if (*number >= procedures_.size()) procedures_.resize(*number + 1);
    procedures_[*number] = {std::string(name.substr(point)), nc::technol::Procedure(program, task.name)};
  }
}

std::optional<uint64_t> CanPlaces::numberOf(const CanPlaces& other, uint64_t number) const noexcept {
  if (number >= other.procedures_.size()) return std::nullopt;
  const auto found = std::ranges::find(procedures_, other.procedures_[number].name, &NamedProcedure::name);
  if (found == procedures_.end()) return std::nullopt;
  return static_cast<uint64_t>(found - procedures_.begin());
}

void CanPlaces::disableDrives(const core::Memory& memory) const {
  for (const core::Place& place : command_) memory.write(place, 0);
}

void CanPlaces::writeDriveAnswer(const core::Memory& memory, const CanPacket& answer) const {
  memory.write(answerId_, answer.id);
  memory.write(answerRemote_, answer.remote);
  memory.write(answerLength_, answer.length);
  for (uint32_t i = 0; i < answerData_.size(); ++i) memory.write(answerData_[i], answer.data[i]);
  memory.write(driveBusy_, 0);
}

void CanPlaces::readTerminals(const core::Memory& memory, const UnitStates& written,
                              std::array<uint8_t, kInputPorts>& terminals) const {
  for (uint32_t i = 0; i < in_.size(); ++i) {
    const auto now = static_cast<uint8_t>(memory.read(in_[i]));
    if (now != written.in[i]) terminals[i] = now;
  }
}

void CanPlaces::read(const core::Memory& memory, UnitOrders& unitOrders, DriveOrders& driveOrders,
                     std::array<uint8_t, kOutputPorts>& errors) const {
  for (uint32_t i = 0; i < out_.size(); ++i) {
    unitOrders.out[i] = static_cast<uint8_t>(memory.read(out_[i]));
    errors[i] = static_cast<uint8_t>(memory.read(errors_[i]));
  }
  for (uint32_t wheel = 0; wheel < kHandwheels; ++wheel) {
    for (uint32_t i = 0; i < display_[wheel].size(); ++i)
      unitOrders.display[wheel][i] = static_cast<uint8_t>(memory.read(display_[wheel][i]));
    unitOrders.displayBusy[wheel] = memory.read(displayBusy_[wheel]) != 0;
  }
  for (uint32_t i = 0; i < command_.size(); ++i)
    driveOrders.command[i] = static_cast<uint16_t>(memory.read(command_[i]));
}

void CanPlaces::write(const core::Memory& memory, const UnitStates& units, const DriveStates& drives,
                      const CanController& can) const {
  const uint32_t boards = can.units().count(kInOut08);
  for (uint32_t board = 1; board <= boards; ++board) {
    for (uint32_t i = (board - 1) * kUnitInputs; i < board * kUnitInputs && i < in_.size(); ++i)
      memory.write(in_[i], units.in[i]);
    for (uint32_t i = (board - 1) * kUnitOutputs; i < board * kUnitOutputs && i < errors_.size(); ++i)
      memory.write(errors_[i], units.errors[i]);
  }
  for (uint32_t group = 1; group <= codes_.size(); ++group) {
    if (can.units().count(group) == 0) continue;
    const GroupCodes& codes = units.groups[group - 1];
    const uint8_t values[] = {codes.errorCode, codes.errorNumber, codes.timeoutCode, codes.timeoutNumber};
    for (uint32_t i = 0; i < std::size(values); ++i) memory.write(codes_[group - 1][i], values[i]);
  }
  const uint32_t wheels = can.units().count(kHandwheel);
  for (uint32_t wheel = 0; wheel < wheels && wheel < keys_.size(); ++wheel)
    for (uint32_t i = 0; i < 2; ++i) memory.write(keys_[wheel][i], units.keys[wheel][i]);
  for (uint32_t i = 0; i < can.drives().count() && i < status_.size(); ++i) {
    memory.write(status_[i], drives.status[i]);
    memory.write(manufacturer_[i], drives.manufacturer[i]);
  }
}

} // namespace rung::io

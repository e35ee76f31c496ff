// A simulated unit (see can_unit.h).
#include "tools/sim/technol/devices/can_unit.h"

#include <algorithm>

namespace rung::sim::technol {
namespace {

using namespace devices;

constexpr uint32_t kDeviceType = 0x00030191; // inputs and outputs of CiA 401
constexpr uint32_t kMaker = 1;
constexpr std::string_view kNames[kUnitGroups] = {"INOUT08", "KLA50", "TOC"};
constexpr uint16_t kErrorRegister = 0x1001, kName = 0x1008, kShortedOutput = 0x2101, kMatrixOutputs = 0x2109,
                   kReadInput = 0x6000, kWriteOutput = 0x6200, kPotentiometer = 0x6404;
constexpr sdo::Object kTpdo2Type{0x1801, 2};
// Error codes of emergencies (CiA 301, CiA 401).
constexpr uint16_t kNoError = 0, kGenericError = 0x1000, kShortedOutputs = 0x2300;

} // namespace

SimulatedUnit::SimulatedUnit(uint32_t group, uint32_t board)
    : group_(group), board_(board), node_(static_cast<uint8_t>(kFirstNode[group - 1] + board - 1)) {
  if (group == kHandwheel) display_.resize(1);
  objects_.add({{0x1000, 0}, 4, kDeviceType});
  objects_.add({{kErrorRegister, 0}, 1});
  objects_.add({{0x1018, 1}, 4, kMaker});
  for (uint8_t i = 1; i <= kUnitOutputs; ++i) {
    objects_.add({{kShortedOutput, i}, 1});
    objects_.add({{kWriteOutput, i}, 1});
  }
  for (uint8_t i = 1; i <= kUnitInputs; ++i) objects_.add({{kReadInput, i}, 1});
  for (uint8_t i = 1; i <= 8; ++i) objects_.add({{kPotentiometer, i}, 1});
  objects_.add({kTpdo2Type, 1, 0, ObjectAccess::ReadWrite});
  objects_.add({{kMatrixOutputs, 0}, 2, 0, ObjectAccess::ReadWrite});
}

void SimulatedUnit::power() {
  wires_.error = 0;
  wires_.shorts = {};
  wires_.silent = false;
  operational_ = false;
  sendsAnalogue_ = false;
  received_ = {};
  outputs_ = {};
  reported_ = 0;
  reportedShorts_ = {};
  for (HandwheelDisplay& display : display_) display.clear();
  objects_.set(kTpdo2Type, 0);
  objects_.set({kMatrixOutputs, 0}, 0);
}

// The unit switches shorted outputs off by itself (man. l.4511-4517).
uint8_t SimulatedUnit::output(uint32_t port) const { return outputs_[port] & ~wires_.shorts[port]; }

uint8_t SimulatedUnit::errorRegister() const {
  const bool shorted = std::any_of(wires_.shorts.begin(), wires_.shorts.end(), [](uint8_t bits) { return bits != 0; });
  const auto error = static_cast<uint8_t>(wires_.error | (shorted ? kErrorShort : 0));
  return error == 0 ? 0 : error | kErrorAny;
}

void SimulatedUnit::tick(NodePackets& answers) {
  if (wires_.silent) return;
  const uint8_t now = errorRegister();
  if (now == reported_ && wires_.shorts == reportedShorts_) return;
  reported_ = now;
  reportedShorts_ = wires_.shorts;
  const uint16_t code = now == 0 ? kNoError : (now & kErrorShort) != 0 ? kShortedOutputs : kGenericError;
  CanPacket packet{.id = static_cast<uint16_t>(kEmergency + node_), .length = kCanDataBytes};
  putNumber(packet.data, 2, code);
  packet.data[2] = now;
  answers.push(packet);
}

void SimulatedUnit::receive(const CanPacket& packet, NodePackets& answers) {
  if (wires_.silent) return;
  if (packet.id == kNodeControl) {
    if (packet.data[1] == 0 || packet.data[1] == node_) operational_ = packet.data[0] == 1;
  } else if (packet.id == kSync) {
    if (!operational_) return;
    std::copy_n(received_.begin(), kUnitOutputs, outputs_.begin());
    for (HandwheelDisplay& display : display_) display.show(received_);
    sendInputs(answers);
  } else if (packet.id == kRpdo1 + node_) {
    std::copy_n(packet.data, received_.size(), received_.begin());
  } else if (packet.id == kSdoRequest + node_) {
    answer(packet, answers);
  }
}

void SimulatedUnit::sendInputs(NodePackets& answers) const {
  CanPacket inputs{.id = static_cast<uint16_t>(kTpdo1 + node_), .length = kCanDataBytes};
  if (group_ == kHandwheel) {
    std::copy_n(wires_.in.begin(), 2, inputs.data);
    for (uint32_t i = 0; i < 2; ++i) putNumber(inputs.data + 2 + 2 * i, 2, wires_.encoders[i]);
  } else {
    std::copy(wires_.in.begin(), wires_.in.end(), inputs.data);
    std::copy(wires_.keys.begin(), wires_.keys.end(), inputs.data + wires_.in.size());
  }
  answers.push(inputs);
  if (!sendsAnalogue_) return;
  CanPacket analogue{.id = static_cast<uint16_t>(kTpdo2 + node_), .length = kCanDataBytes};
  std::copy(wires_.analogue.begin(), wires_.analogue.end(), analogue.data);
  answers.push(analogue);
}

void SimulatedUnit::refresh() {
  objects_.set({kErrorRegister, 0}, errorRegister());
  for (uint8_t i = 0; i < kUnitOutputs; ++i) {
    const auto subindex = static_cast<uint8_t>(i + 1);
    objects_.set({kShortedOutput, subindex}, wires_.shorts[i]);
    objects_.set({kWriteOutput, subindex}, outputs_[i]);
  }
  for (uint8_t i = 0; i < kUnitInputs; ++i) objects_.set({kReadInput, static_cast<uint8_t>(i + 1)}, wires_.in[i]);
  for (uint8_t i = 0; i < 8; ++i) objects_.set({kPotentiometer, static_cast<uint8_t>(i + 1)}, wires_.analogue[i]);
}

// The name is longer than four bytes: its length comes first, then it comes in one segment.
void SimulatedUnit::answer(const CanPacket& request, NodePackets& answers) {
  const std::string_view name = kNames[group_ - 1];
  if ((sdo::command(request) & 0xEF) == sdo::kReadSegment) {
    CanPacket segment{.id = static_cast<uint16_t>(kSdoAnswer + node_), .length = kCanDataBytes};
    segment.data[0] = static_cast<uint8_t>((7 - name.size()) << 1 | 1);
    std::copy(name.begin(), name.end(), segment.data + 1);
    answers.push(segment);
    return;
  }
  if (sdo::command(request) == sdo::kRead && sdo::object(request) == sdo::Object{kName, 0}) {
    const auto length = static_cast<uint32_t>(name.size());
    answers.push(sdo::packet(kSdoAnswer + node_, sdo::kSegmented, {kName, 0}, length));
    return;
  }
  refresh();
  const CanObject* written = nullptr;
  answers.push(objects_.answer(node_, request, written));
  if (written != nullptr && written->place == kTpdo2Type) sendsAnalogue_ = written->value != 0;
}

} // namespace rung::sim::technol

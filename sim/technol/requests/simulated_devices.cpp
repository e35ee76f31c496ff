// The devices of a program (see simulated_devices.h).
#include "sim/technol/requests/simulated_devices.h"

#include <algorithm>
#include <cmath>

#include "machine/io/channel_file.h"
#include "machine/io/device_call.h"
#include "rtlib/load/program_info.h"
#include "rtlib/text/letters.h"
#include "rtlib/text/number.h"

namespace rung::sim::technol {

using namespace io;

namespace {

constexpr int64_t kUsPerTick = 1000;

// Packet orders are handled by the control even if a scenario answers all other requests (inventory of the services,
// 1.1).
bool isPacketOrder(ServiceKind kind) {
  return kind == ServiceKind::CanOrder || kind == ServiceKind::CanDeleteOrder || kind == ServiceKind::CanEndOrder;
}

} // namespace

std::optional<std::string> SimulatedDevices::configure(std::string_view key, std::string_view value,
                                                       const std::string& path) {
  if (text::equalsIgnoringCase(key, "nc")) {
    if (value != "simulated" && value != "scripted")
      return "nc is simulated or scripted, not '" + std::string(value) + "'";
    simulated_ = value == "simulated";
    return std::string();
  }
  if (const auto table = io::numberAfter(key, "PlcTableDef")) return files_.setDefinition(*table, path);
  if (const auto table = io::numberAfter(key, "PlcTable")) {
    hasTables_ = true;
    return files_.setTable(*table, path);
  }
  if (text::equalsIgnoringCase(key, "axes") || io::isAxisKey(key)) return axes_.configure(key, value);
  if (auto wired = inputs_.configure(key, value, axes_)) return wired;
  if (ComPorts::owns(key)) return com_.configure(key, value);
  if (EtherCat::owns(key)) return ethercat_.configure(key, value);
  if (EthercatServos::owns(key)) return servos_.configure(key, value);
  if (auto keyboard = keyboards_.configure(key, path)) return keyboard;
  return can_.configure(key, value);
}

std::string SimulatedDevices::define(std::span<const host::DeviceDefinition> definitions) {
  struct Own final : io::ConfiguredDevices {
    explicit Own(SimulatedDevices& given) : all(given) {}
    std::string set(std::string_view key, std::string_view value) override {
      return all.configure(key, value, {}).value_or("");
    }
    uint32_t drives() const override { return all.can_.drives(); }
    SimulatedDevices& all;
  };
  Own own(*this);
  return io::configureDevices(own, definitions);
}

void SimulatedDevices::loadTables() {
  tablesLoaded_ = true;
  if (hasTables_) tableProblem_ = files_.load(tables_);
}

uint32_t SimulatedDevices::retainedSize() {
  if (!tablesLoaded_) loadTables();
  return tables_.retainedSize();
}

void SimulatedDevices::restoreRetained(std::span<const uint8_t> image) {
  loadTables();
  tablesRestored_ = tables_.restoreRetained(image);
}

// Tables are stored at each change, so a warm start finds them unchanged (inventory of the services, 15.5).
void SimulatedDevices::powerOn(runtime::Instance& instance, nc::PowerOn kind, const ConstantOf& constantOf) {
  locate(instance);
  if (!tablesLoaded_ || (kind == nc::PowerOn::Cold && !tablesRestored_)) loadTables();
  tablesRestored_ = false;
  tables_.forgetChanges();
  areas_.clear();
  bytes_.clear();
  axes_.powerUp();
  com_.powerOn();
  can_.power();
  if (!simulated_) can_.openForScenario();
  canCalls_.clear();
  ethercatCalls_.clear();
  ethercat_.powerOn();
  servos_.powerOn();
  servoCells_ = {};
  for (uint32_t i = 0; i < servoCells_.size(); ++i) servoCells_[i].incrementsPerUm = servos_.incrementsPerUm(i);
  axisInputs_ = {};
  keyboards_.power();
  keyProblem_ = keyboards_.resolveCommands(constantOf);
  axisOutputs_ = {};
  canInputs_ = {};
  canOutputs_ = {};
  devicesUs_ = instance.nowUs();
  restUs_ = 0;
  inputs_.powerOn(instance.memory());
}

void SimulatedDevices::programChanged(runtime::Instance& instance, const rung_program& former) {
  const CanPlaces before = std::move(canPlaces_);
  locate(instance);
  canCalls_.relocate(before, canPlaces_, runtime::Relocation(former, instance.program()));
}

void SimulatedDevices::locate(runtime::Instance& instance) {
  const rung_program& program = instance.program();
  canPlaces_ = CanPlaces(program);
  if (!simulated_) return;
  axisPlaces_ = AxisPlaces(program);
  inputs_.locate(program);
  statePlaces_ = StatePlaces(program);
  servoPlaces_ = ServoPlaces(program);
  sharedPoints_ = SharedPoints(program);
  keyboardPlaces_ = KeyboardPlaces(program);
}

bool SimulatedDevices::answers(ServiceKind kind) const {
  switch (nc::technol::deviceOf(kind)) {
  case Device::None: return false;
  case Device::Bytes:
  case Device::Areas: return true;
  case Device::Tables: return hasTables_;
  case Device::Can: return simulated_ || isPacketOrder(kind);
  default: return simulated_;
  }
}

bool SimulatedDevices::respond(runtime::Instance& instance, const core::ServiceRequest& request,
                               core::ServiceReply& reply) {
  const ServiceKind kind = kindOf(request);
  const auto wrong = outOfRange(request);
  if (!answers(kind) && !wrong) return false;
  DeviceCall call(instance, request, reply, bytes_);
  if (wrong) {
    complaints_.add({nc::technol::deviceService(kind).service.name, wrong->operand, wrong->value, {}});
    answerNothing(call);
    return true;
  }
  switch (nc::technol::deviceOf(kind)) {
  case Device::None: return false;
  case Device::Bytes: bytes_.fetch(request, reply); break;
  case Device::Tables: answerTable(tables_, call); break;
  case Device::Areas: answerArea(areas_, call); break;
  case Device::Axes: answerAxis(axes_, axisPlaces_, call); break;
  case Device::Com: answerCom(com_.find(comOf(call)), call); break;
  case Device::Can:
    canCalls_.answer(call);
    complainOfDrive(call);
    break;
  case Device::Ethercat: ethercatCalls_.begin(call); break;
  }
  return true;
}

// Reports a wrong drive number, for which the instruction has no result.
void SimulatedDevices::complainOfDrive(const DeviceCall& call) {
  const bool exists = call.arg(0) >= 1 && call.arg(0) <= io::kMostDrives;
  if (call.kind() == ServiceKind::CanDrive && !exists) complaints_.add({"CAN_AX_SEND", "axis", call.arg(0), ""});
}

std::vector<std::string> SimulatedDevices::problems() const {
  std::vector<std::string> found;
  const std::string axes = simulated_ ? axes_.configurationProblem() : std::string();
  for (const std::string* problem : {&axes, &tableProblem_, &keyProblem_})
    if (!problem->empty()) found.push_back(*problem);
  return found;
}

void SimulatedDevices::startProgram() {
  can_.control().startProgram();
  canCalls_.clear();
  axes_.startPlc();
}

void SimulatedDevices::fault(runtime::Instance& instance) {
  if (!simulated_) return;
  axes_.fault();
  axisPlaces_.zeroOutputs(instance.memory());
  canPlaces_.disableDrives(instance.memory());
}

void SimulatedDevices::blockStarted(runtime::Instance& instance) {
  if (!simulated_) return;
  const int own = axisOutputs_.motion & ~axisInputs_.blockMotion;
  axisInputs_.blockMotion = static_cast<AxisMask>(axisPlaces_.cells().motions().read(instance.memory()) & ~own);
}

// ---- time ----------------------------------------------------------------------------------------------------------

void SimulatedDevices::beforeInput(runtime::Instance& instance, ModuleCells& cells) {
  if (!simulated_) return canCalls_.deliver(instance, canPlaces_);
  pass(instance, cells, static_cast<int64_t>(runtime::scanPeriodUs(instance.program())));
  devicesUs_ = std::max(devicesUs_, instance.nowUs()); // scans may be skipped on a real clock
}

void SimulatedDevices::idle(runtime::Instance& instance, ModuleCells& cells) {
  if (!simulated_) return canCalls_.deliver(instance, canPlaces_);
  if (const int64_t us = instance.nowUs() - devicesUs_; us >= kUsPerTick) pass(instance, cells, us);
}

void SimulatedDevices::pass(runtime::Instance& instance, ModuleCells& cells, int64_t us) {
  takeVirtualKeys(instance, cells);
  devicesUs_ += us;
  restUs_ += us;
  const auto ticks = static_cast<uint32_t>(restUs_ / kUsPerTick);
  restUs_ %= kUsPerTick;
  if (ticks != 0) {
    sharedPoints_.take(instance.memory(), cells);
    tickAxes(instance, ticks);
    tickOthers(instance, cells, ticks);
    sharedPoints_.give(instance.memory(), cells);
  }
  inputs_.pass(instance.memory(), axes_, us);
}

void SimulatedDevices::tickAxes(runtime::Instance& instance, uint32_t ticks) {
  const core::Memory memory = instance.memory();
  axisPlaces_.read(memory, axisInputs_, axisRequests_);
  for (uint32_t i = 0; i < kMaxAxes; ++i)
    axisInputs_.servoPosition[i] =
        static_cast<int32_t>(std::llround(axisInputs_.servoPosition[i] / servos_.incrementsPerUm(i)));
  for (uint32_t i = 0; i < ticks; ++i) axes_.tick(axisInputs_, axisRequests_);
  axes_.show(axisOutputs_);
  axisPlaces_.write(memory, axes_.count(), axisRequests_, axisOutputs_);
}

void SimulatedDevices::tickOthers(runtime::Instance& instance, ModuleCells& cells, uint32_t ticks) {
  const core::Memory memory = instance.memory();
  canPlaces_.readTerminals(memory, canOutputs_.units, canInputs_.terminals);
  canPlaces_.read(memory, canInputs_.units, canInputs_.drives, canOutputs_.units.errors);
  statePlaces_.read(memory, stateBits_);
  servoPlaces_.read(memory, servoCells_);
  for (uint32_t i = 0; i < axes_.count(); ++i) servoCells_[i].place = axes_.physical(i + 1);
  takeOutputs(cells, ethercat_.image(), servoCells_);
  for (uint32_t i = 0; i < ticks; ++i) {
    com_.tick();
    can_.tick(canInputs_, canOutputs_);
    ethercat_.tick(stateBits_);
    servos_.tick(servoCells_);
  }
  canPlaces_.write(memory, canOutputs_.units, canOutputs_.drives, can_.control());
  statePlaces_.write(memory, stateBits_);
  servoPlaces_.write(memory, servoCells_);
  giveInputs(cells, ethercat_.image(), servoCells_, axisOutputs_, axes_.count());
  canCalls_.showDrive(memory, canPlaces_);
  canCalls_.deliver(instance, canPlaces_);
  if (ethercatCalls_.finish(instance, bytes_)) instance.services().deliver();
}

void SimulatedDevices::takeLog(std::vector<std::string>& log) {
  Complaint complaint;
  while (axes_.takeComplaint(complaint) || complaints_.take(complaint)) log.push_back(complaint.text());
  io::DriveMessage ofDrive;
  while (can_.control().takeMessage(ofDrive)) log.push_back(io::textOf(ofDrive));
  io::UnitMessage ofUnit;
  while (can_.control().takeMessage(ofUnit)) log.push_back(io::textOf(ofUnit));
  EndedOrder ended;
  while (canCalls_.takeEnded(ended)) log.push_back(textOf(ended));
}

} // namespace rung::sim::technol

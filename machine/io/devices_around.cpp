// Real devices around a program (see devices_around.h).
#include "machine/io/devices_around.h"

#include "rtlib/nc/technol/exchange.h"

namespace rung::io {

using namespace io;

struct DevicesAround::Places final : nc::Places {
  explicit Places(const rung_program& of)
      : program(of), services(deviceOrders(of)), can(of), states(of), outputs(of), axes(of) {}

  const rung_program& program;
  std::vector<DeviceOrder> services; // by the program's numbers
  CanPlaces can;
  StatePlaces states;
  OutputPlaces outputs;
  AxisCells axes;
};

DevicesAround::DevicesAround(Devices& devices, const rung_program& program)
    : devices_(devices), control_(nc::makeControl(program.dialect)), places_(locate(program)),
      ethercat_(*devices.master), states_(*devices.master) {}

std::unique_ptr<nc::Places> DevicesAround::locate(const rung_program& program) const {
  return std::make_unique<Places>(program);
}

const DevicesAround::Places& DevicesAround::places() const { return static_cast<const Places&>(*places_); }

void DevicesAround::exchangePlaces(std::unique_ptr<nc::Places>& places) noexcept {
  places_.swap(places);
  const auto& former = static_cast<const Places&>(*places);
  devices_.can.relocate(former.can, this->places().can, runtime::Relocation(former.program, this->places().program));
}

uint32_t DevicesAround::works() const { return control_->works() | 1u << nc::kHookBeforeInput; }

// MODULE_INIT may give orders to devices already.
void DevicesAround::powerOn(runtime::Instance& instance, nc::PowerOn kind) {
  control_->prepare(instance, kind);
  for (com::Port& port : devices_.ports) port.powerOn();
  devices_.can.powerOn();
  devices_.tables.powerOn();
  devices_.axes.powerOn();
  bytes_.clear();
  ethercat_.clear();
  states_.reset(devices_.programStartsMaster);
  control_->start(instance);
}

void DevicesAround::beforePart(runtime::Instance& instance) {
  control_->beforeSlice(instance);
  if (instance.stopped()) devices_.can.dropPackets(instance, places().can);
}

void DevicesAround::afterPart(runtime::Instance& instance) {
  control_->afterSlice(instance);
  if (!instance.atListStart() || instance.faulted()) return;
  devices_.can.take(instance.memory(), places().can);
  devices_.axes.positioned().take(instance.memory(), places().axes);
}

void DevicesAround::onHook(runtime::Instance& instance, uint32_t work) {
  if (work == nc::kHookBeforeInput) beforeInput(instance);
  control_->onHook(instance, work);
}

void DevicesAround::beforeInput(runtime::Instance& instance) {
  tickMaster(instance.memory());
  bool answered = devices_.tables.takeAnswers(instance.services(), bytes_);
  answered = ethercat_.finish(instance, bytes_) || answered;
  if (answered) instance.services().deliver();
  devices_.can.show(instance, places().can);
  devices_.axes.positioned().show(instance.memory(), places().axes);
}

void DevicesAround::tickMaster(const core::Memory& memory) {
  if (devices_.master == &ethercat::noMaster()) return;
  places().states.read(memory, stateBits_);
  states_.tick(stateBits_);
  places().states.write(memory, stateBits_);
}

// What MODULE_HALT still orders counts, but no drive stays enabled (inventory of the services, 1.5).
void DevicesAround::onFault(runtime::Instance& instance) {
  control_->onFault(instance);
  devices_.can.take(instance.memory(), places().can);
  devices_.can.disableDrives();
  devices_.axes.fault(instance.memory(), places().outputs);
}

// ---- requests ------------------------------------------------------------------------------------------------------

// Without such a device the control refuses.
bool DevicesAround::respond(runtime::Instance& instance, const core::ServiceRequest& request,
                            core::ServiceReply& reply) {
  return answer(instance, request, reply) || control_->respond(instance, request, reply);
}

bool DevicesAround::answer(runtime::Instance& instance, const core::ServiceRequest& request,
                           core::ServiceReply& reply) {
  if (request.service >= places().services.size()) return false;
  const DeviceOrder order = places().services[request.service];
  DeviceCall call(instance, request, reply, bytes_);
  switch (order.device) {
  case DeviceKind::None: break;
  case DeviceKind::Data: bytes_.fetch(request, reply); return true;
  case DeviceKind::Tables: return askTable(static_cast<TableOrder>(order.order), call);
  case DeviceKind::ReadArea: readShared(devices_.areas, call); return noteArea(call);
  case DeviceKind::WriteArea: writeShared(devices_.areas, call); return noteArea(call);
  case DeviceKind::Axes: return devices_.axes.answer(order, call, places().axes);
  case DeviceKind::Com: answerCom(portOf(call), static_cast<ComOrder>(order.order), call); return true;
  case DeviceKind::Can: devices_.can.answer(static_cast<CanRequest>(order.order), call); return true;
  case DeviceKind::Ethercat: ethercat_.begin(static_cast<EthercatOrder>(order.order), call); return true;
  }
  return false;
}

com::Port* DevicesAround::portOf(const DeviceCall& call) {
  const uint32_t number = comOf(call);
  return number < devices_.ports.size() ? &devices_.ports[number] : nullptr;
}

bool DevicesAround::askTable(TableOrder order, DeviceCall& call) {
  if (devices_.tables.isEmpty() || !devices_.tables.ask(order, call)) return false;
  call.wait();
  return true;
}

bool DevicesAround::noteArea(const DeviceCall& call) {
  if (call.result(1) == static_cast<int64_t>(AreaResult::Broken)) devices_.areasBroken = true;
  return true;
}

} // namespace rung::io

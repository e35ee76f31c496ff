// See host_devices.h.
#include "machine/io/host_devices.h"

#include <optional>
#include <stdexcept>
#include <utility>

#include "machine/io/axes/axis_service.h"
#include "machine/io/channel_file.h"
#include "machine/io/com/tty_line.h"
#include "machine/io/device_call.h"
#include "machine/io/device_report.h"
#include "rtlib/nc/service.h"
#include "rtlib/nc/technol/exchange.h"
#include "rtlib/text/letters.h"
#include "rtlib/text/number.h"

namespace rung::io {

namespace {

constexpr uint32_t kChannels = CanController::kChannels;

// "2=can0"
struct Assignment {
  uint32_t number = 0;
  std::string device;
};
std::optional<Assignment> assignmentOf(std::string_view setting) {
  const size_t equals = setting.find('=');
  if (equals == std::string_view::npos || equals + 1 == setting.size()) return std::nullopt;
  const auto number = text::numberIn<uint32_t>(setting.substr(0, equals));
  return number ? std::optional(Assignment{*number, std::string(setting.substr(equals + 1))}) : std::nullopt;
}

std::string found(std::string_view setting) { return ", not '" + std::string(setting) + "'"; }

} // namespace

struct HostDevices::Machine {
  Devices devices;
  AxisPins axisPins;
  std::array<std::string, kChannels> interfaces;           // explicitly configured
  std::array<std::string, com::kMostPorts> devicesOfPorts; // explicitly configured
  std::array<bool, kChannels> adopted{};
  com::TtyThread tty;
  DeviceReport report{devices, tty};
  std::vector<std::string> warnings;
  bool started = false;

  std::string setPort(std::string_view key, std::string_view value);
  std::string setAxis(std::string_view key, std::string_view value);
  std::string setEthercat(std::string_view value);
  PositionedAxes& axes() { return devices.axes.positioned(); }
  void stepAxes(int64_t ns) noexcept;
  void setActive(uint32_t port, bool isActive);
  std::string ofTable(uint32_t table, std::string wrong);
  std::string interfaceOf(uint32_t channel) const;
  std::string deviceOf(uint32_t port) const;
  void openChannels();
  void openPorts();
};

HostDevices::HostDevices() : machine_(std::make_unique<Machine>()) {}
HostDevices::~HostDevices() { end(); }

// ---- settings ------------------------------------------------------------------------------------------------------

std::string HostDevices::setCan(std::string_view setting) {
  const auto given = assignmentOf(setting);
  if (!given || given->number < 1 || given->number > kChannels)
    return "a CAN channel is 1=INTERFACE or 2=INTERFACE" + found(setting);
  machine_->interfaces[given->number - 1] = given->device;
  machine_->devices.can.settings().channels[given->number - 1].active = true;
  return {};
}

std::string HostDevices::setCom(std::string_view setting) {
  const auto given = assignmentOf(setting);
  if (!given || given->number >= com::kMostPorts)
    return "a serial port is NUMBER=DEVICE with a number of 0 to 15" + found(setting);
  machine_->devicesOfPorts[given->number] = given->device;
  machine_->setActive(given->number, true);
  return {};
}

std::string HostDevices::setSharedFile(const std::string& path) { return machine_->devices.areas.mapFile(path); }

std::string HostDevices::Machine::setPort(std::string_view key, std::string_view value) {
  com::PortKey port;
  if (std::string wrong = readPortKey(key, port); !wrong.empty()) return wrong;
  com::Settings settings = devices.ports[port.number].settings();
  if (const std::string wrong = settings.set(port.attribute, value); !wrong.empty())
    return std::string(key) + ": " + wrong;
  devices.ports[port.number].configure(settings);
  return {};
}

std::string HostDevices::Machine::setAxis(std::string_view key, std::string_view value) {
  AxisKey own;
  if (std::string wrong = readAxisKey(key, own); !wrong.empty()) return wrong;
  return axes().set(own.axis, own.attribute, value);
}

void HostDevices::Machine::setActive(uint32_t port, bool isActive) {
  com::Settings settings = devices.ports[port].settings();
  settings.isActive = isActive;
  devices.ports[port].configure(settings);
}

std::string HostDevices::Machine::setEthercat(std::string_view value) {
  devices.programStartsMaster = value == "1";
  return value == "0" || value == "1" ? "" : "EtherCATOPViaPLC takes 0 or 1" + found(value);
}

// An unreadable file is only a warning: its table does not exist, and the program runs.
std::string HostDevices::Machine::ofTable(uint32_t table, std::string wrong) {
  if (table >= PlcTables::kTables || wrong.empty()) return wrong;
  warnings.push_back(std::move(wrong));
  return {};
}

std::string HostDevices::configure(std::string_view key, std::string_view value) {
  Devices& devices = machine_->devices;
  const std::string path(value);
  if (const auto table = numberAfter(key, "PlcTableDef"))
    return machine_->ofTable(*table, devices.tables.setDefinition(*table, path));
  if (const auto table = numberAfter(key, "PlcTable"))
    return machine_->ofTable(*table, devices.tables.setTable(*table, path));
  if (com::isPortKey(key)) return machine_->setPort(key, value);
  if (isAxisKey(key)) return machine_->setAxis(key, value);
  if (text::equalsIgnoringCase(key, "EtherCATOPViaPLC")) return machine_->setEthercat(value);
  if (text::equalsIgnoringCase(key, "PlcConfig")) return configureBy(path);
  if (const auto wrong = devices.can.settings().set(key, value)) return *wrong;
  return "'" + std::string(key) +
         "' is not a key of a device; there are COM[n], CAN[n], drive.n.type, axis.n, PlcTableDefN, "
         "PlcTableN, EtherCATOPViaPLC and PlcConfig";
}

// Ignores attributes of axes in the file that do not concern this machine.
std::string HostDevices::configureBy(const std::string& path) {
  struct Own final : ConfiguredDevices {
    explicit Own(HostDevices& given) : all(given) {}
    std::string set(std::string_view key, std::string_view value) override {
      AxisKey axis;
      const bool isAxis = isAxisKey(key) && readAxisKey(key, axis).empty();
      return isAxis && !PositionedAxes::takes(axis.attribute) ? "" : all.configure(key, value);
    }
    uint32_t drives() const override { return all.machine_->devices.can.settings().drives; }
    HostDevices& all;
  };
  host::ControlFiles files;
  if (std::string wrong = readControlFile(host::ControlFileKind::Channel, path, files); !wrong.empty()) return wrong;
  Own own(*this);
  return configureDevices(own, files.devices);
}

void HostDevices::set(const host::File& map, std::vector<std::string>& errors) {
  using Kind = host::DeviceSetting::Kind;
  const auto apply = [this](const host::DeviceSetting& setting) {
    switch (setting.kind) {
    case Kind::Can: return setCan(setting.key + "=" + setting.value);
    case Kind::Com: return setCom(setting.key + "=" + setting.value);
    case Kind::Axis: machine_->axes().add(text::numberIn<uint32_t>(setting.key).value()); break;
    case Kind::SharedFile: return setSharedFile(setting.value);
    case Kind::Config: return configure(setting.key, setting.value);
    }
    return std::string();
  };
  for (const host::DeviceSetting& setting : map.devices)
    if (const std::string wrong = apply(setting); !wrong.empty())
      errors.push_back(map.message(setting.at, "devices: " + wrong));
}

void HostDevices::addAxisPins(host::File& map, std::vector<std::string>& errors) {
  for (const host::DeviceSetting& setting : map.devices) {
    if (setting.kind != host::DeviceSetting::Kind::Axis) continue;
    const auto axis = text::numberIn<uint32_t>(setting.key).value();
    if (const std::string wrong = machine_->axisPins.add(map, axis, setting.value); !wrong.empty())
      errors.push_back(map.message(setting.at, "devices.axes: " + wrong));
  }
}

void HostDevices::useMaster(ethercat::Master& master) { machine_->devices.master = &master; }

void HostDevices::adoptCan(uint32_t channel, int descriptor) {
  machine_->devices.can.settings().channels[channel - 1].active = true;
  machine_->devices.can.adopt(channel, descriptor);
  machine_->adopted[channel - 1] = true;
}

// ---- devices -------------------------------------------------------------------------------------------------------

// "" if no interface is configured.
std::string HostDevices::Machine::interfaceOf(uint32_t channel) const {
  if (!interfaces[channel - 1].empty()) return interfaces[channel - 1];
  const auto& physical = devices.can.settings().channels[channel - 1].physical;
  return physical ? "can" + std::to_string(*physical) : "";
}

std::string HostDevices::Machine::deviceOf(uint32_t port) const {
  if (!devicesOfPorts[port].empty()) return devicesOfPorts[port];
  const uint32_t physical = devices.ports[port].settings().physical;
  return physical == 0 ? "" : com::devicePath(physical);
}

void HostDevices::Machine::openChannels() {
  devices.can.configure();
  for (uint32_t channel = 1; channel <= kChannels; ++channel) {
    if (adopted[channel - 1] || !devices.can.settings().isActive(channel)) continue;
    const std::string interface = interfaceOf(channel);
    const std::string wrong = interface.empty() ? "" : devices.can.open(channel, interface);
    if (!wrong.empty()) throw std::runtime_error("CAN channel " + std::to_string(channel) + ": " + wrong);
    if (interface.empty())
      warnings.push_back("CAN channel " + std::to_string(channel) +
                         " is configured, but has no interface (--can, PhysicalCanChannel): it does not exist");
  }
}

void HostDevices::Machine::openPorts() {
  for (uint32_t port = 0; port < devices.ports.size(); ++port) {
    if (!devices.ports[port].settings().isActive) continue;
    const std::string device = deviceOf(port);
    const std::string wrong = device.empty() ? "" : tty.add(devices.ports[port], device);
    if (!wrong.empty()) throw std::runtime_error("COM " + std::to_string(port) + ": " + wrong);
    if (!device.empty()) continue;
    warnings.push_back("the serial port " + std::to_string(port) +
                       " is configured, but has no device (--com, PhysicalComNo): it does not exist");
    setActive(port, false);
  }
}

bool HostDevices::isFor(const Image& image) { return nc::hasDevices(image.program().dialect); }

Instance HostDevices::instance(const Image& image, const rung_instance_options& options) {
  const rung_program& program = image.program();
  if (!isFor(image))
    throw std::runtime_error("devices are only for programs of TECHNOL; this one is of " +
                             std::string(program.dialect));
  if (std::string wrong = machine_->devices.tables.load(); !wrong.empty())
    machine_->warnings.push_back(std::move(wrong));
  machine_->openChannels();
  machine_->openPorts();
  rung_instance* instance = nullptr;
  check(api::newInstance(image.handle(), &options, std::make_unique<DevicesEnvironment>(machine_->devices, program),
                         &instance));
  return Instance(instance);
}

std::vector<std::string> HostDevices::warnings() const { return machine_->warnings; }

void HostDevices::start() {
  machine_->started = true;
  machine_->tty.start();
  machine_->devices.tables.start();
}

void HostDevices::end() {
  if (!std::exchange(machine_->started, false)) return;
  machine_->devices.can.close();
  machine_->tty.end();
  machine_->devices.tables.end();
}

void HostDevices::connectAxes(const host::PinCell* cells, const host::PinAccess& access) {
  machine_->axisPins.connect(cells, access);
}

void HostDevices::Machine::stepAxes(int64_t ns) noexcept {
  axisPins.read(axes());
  axes().step(ns);
  axisPins.write(axes());
}

void HostDevices::step(int64_t ns) noexcept {
  machine_->devices.can.step(ns);
  machine_->stepAxes(ns);
}

bool HostDevices::axesAtRest() const noexcept { return machine_->axes().atRest(); }

bool HostDevices::rest(int64_t ns) noexcept {
  machine_->axes().brake();
  machine_->stepAxes(ns);
  if (!axesAtRest()) return false;
  machine_->axes().open();
  machine_->axisPins.write(machine_->axes());
  return true;
}

std::vector<std::string> HostDevices::report() { return machine_->report.next(); }

// Real devices around a program.

using namespace io;

struct DevicesEnvironment::Places final : nc::Places {
  explicit Places(const rung_program& of) : program(of), can(of), states(of), outputs(of), axes(of) {}

  const rung_program& program;
  CanPlaces can;
  StatePlaces states;
  OutputPlaces outputs;
  AxisCells axes;
};

DevicesEnvironment::DevicesEnvironment(Devices& devices, const rung_program& program)
    : devices_(devices), control_(nc::makeControl(program.dialect)), places_(locate(program)),
      ethercat_(*devices.master), states_(*devices.master) {}

std::unique_ptr<nc::Places> DevicesEnvironment::locate(const rung_program& program) const {
  return std::make_unique<Places>(program);
}

const DevicesEnvironment::Places& DevicesEnvironment::places() const { return static_cast<const Places&>(*places_); }

void DevicesEnvironment::exchangePlaces(std::unique_ptr<nc::Places>& places) noexcept {
  places_.swap(places);
  const auto& former = static_cast<const Places&>(*places);
  devices_.can.relocate(former.can, this->places().can, runtime::Relocation(former.program, this->places().program));
}

uint32_t DevicesEnvironment::works() const { return control_->works() | 1u << nc::kHookBeforeInput; }

// MODULE_INIT may already make requests to devices.
void DevicesEnvironment::powerOn(runtime::Instance& instance, nc::PowerOn kind) {
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

void DevicesEnvironment::beforePart(runtime::Instance& instance) {
  control_->beforeSlice(instance);
  if (instance.stopped()) devices_.can.dropPackets(instance, places().can);
}

void DevicesEnvironment::afterPart(runtime::Instance& instance) {
  control_->afterSlice(instance);
  if (!instance.atListStart() || instance.faulted()) return;
  devices_.can.take(instance.memory(), places().can);
  devices_.axes.positioned().take(instance.memory(), places().axes);
}

void DevicesEnvironment::onHook(runtime::Instance& instance, uint32_t work) {
  if (work == nc::kHookBeforeInput) beforeInput(instance);
  control_->onHook(instance, work);
}

void DevicesEnvironment::beforeInput(runtime::Instance& instance) {
  tickMaster(instance.memory());
  bool answered = devices_.tables.takeAnswers(instance.services(), bytes_);
  answered = ethercat_.finish(instance, bytes_) || answered;
  if (answered) instance.services().deliver();
  devices_.can.show(instance, places().can);
  devices_.axes.positioned().show(instance.memory(), places().axes);
}

void DevicesEnvironment::tickMaster(const core::Memory& memory) {
  if (devices_.master == &ethercat::noMaster()) return;
  places().states.read(memory, stateBits_);
  states_.tick(stateBits_);
  places().states.write(memory, stateBits_);
}

// Commands of MODULE_HALT are still executed, but no drive stays enabled (inventory of the services, 1.5).
void DevicesEnvironment::onFault(runtime::Instance& instance) {
  control_->onFault(instance);
  devices_.can.take(instance.memory(), places().can);
  devices_.can.disableDrives();
  devices_.axes.fault(instance.memory(), places().outputs);
}

// ---- requests ------------------------------------------------------------------------------------------------------

// The control refuses requests to devices that do not exist.
bool DevicesEnvironment::respond(runtime::Instance& instance, const core::ServiceRequest& request,
                                 core::ServiceReply& reply) {
  return answer(instance, request, reply) || control_->respond(instance, request, reply);
}

bool DevicesEnvironment::answer(runtime::Instance& instance, const core::ServiceRequest& request,
                                core::ServiceReply& reply) {
  DeviceCall call(instance, request, reply, bytes_);
  switch (nc::technol::deviceOf(call.kind())) {
  case Device::None: break;
  case Device::Bytes: bytes_.fetch(request, reply); return true;
  case Device::Tables: return askTable(call);
  case Device::Areas: answerArea(devices_.areas, call); return noteArea(call);
  case Device::Axes: return devices_.axes.answer(call, places().axes);
  case Device::Com: answerCom(portOf(call), call); return true;
  case Device::Can: devices_.can.answer(call); return true;
  case Device::Ethercat: ethercat_.begin(call); return true;
  }
  return false;
}

com::Port* DevicesEnvironment::portOf(const DeviceCall& call) {
  const uint32_t number = comOf(call);
  return number < devices_.ports.size() ? &devices_.ports[number] : nullptr;
}

bool DevicesEnvironment::askTable(DeviceCall& call) {
  if (devices_.tables.isEmpty() || !devices_.tables.ask(call)) return false;
  call.wait();
  return true;
}

bool DevicesEnvironment::noteArea(const DeviceCall& call) {
  if (call.result(1) == static_cast<int64_t>(AreaResult::Broken)) devices_.areasBroken = true;
  return true;
}

} // namespace rung::io

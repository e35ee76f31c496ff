// The devices of this machine for a TECHNOL program of a host: serial ports, CAN interfaces, PLC tables in their files,
// shared areas, axes at the pins of a map; an EtherCAT master where the host gives one (inventory of the services, 17).
// What is not named does not exist: its instructions give the error of their section, its cells stay what they are.
//
// Order of things: settings; `instance`, once; `start`; the program runs, with `step` in its thread; the program ends;
// `end`. In the scan nothing waits, allocates or locks; with a file of shared areas, SA_READ and SA_WRITE each ask the
// system once how long that is.
#pragma once
#include <array>
#include <atomic>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "machine/host/mapping_file.h"
#include "machine/host/pins.h"
#include "machine/io/axes/axis_service.h"
#include "machine/io/can/can_service.h"
#include "machine/io/com/port.h"
#include "machine/io/device_call.h"
#include "machine/io/ethercat/ethercat_requests.h"
#include "machine/io/ethercat/master.h"
#include "machine/io/shared/shared_areas.h"
#include "machine/io/tables/table_service.h"
#include "rtlib/api/environment.h"
#include "rung/runtime.hpp"

namespace rung::io {

class HostDevices {
public:
  HostDevices();
  ~HostDevices(); // after the program
  HostDevices(const HostDevices&) = delete;
  HostDevices& operator=(const HostDevices&) = delete;

  // The program's dialect asks devices.
  static bool isFor(const Image& image);

  // ---- before `instance`; "" or what is wrong

  // "2=can0": the CAN channel 1 or 2 is this interface. It is active then.
  std::string setCan(std::string_view setting);
  // "1=/dev/ttyUSB0": the serial port 0 to 15 is this device. It is active then.
  std::string setCom(std::string_view setting);
  // The shared areas lie in this file, which other programs map (machine/io/shared).
  std::string setSharedFile(const std::string& path);
  // All that the table [devices] of a mapping file says; mistakes are further errors, with their places.
  void set(const host::File& map, std::vector<std::string>& errors);
  // The pins of the axes that it names; mistakes as for `set`.
  void addAxisPins(host::File& map, std::vector<std::string>& errors);
  // A key of the configuration that belongs to a device: COM[n], CAN[n], drive.n.type, axis.n, PlcTableDefN, PlcTableN,
  // EtherCATOPViaPLC; PlcConfig, the control's own file of the channel, whose devices they are. Files are named from
  // the working folder.
  std::string configure(std::string_view key, std::string_view value);
  // A master of the host, which outlives this.
  void useMaster(ethercat::Master& master);
  // A descriptor in the place of an interface, which becomes this object's: it takes and gives a `can_frame` at a time.
  void adoptCan(uint32_t channel, int descriptor);

  // ---- the program

  // With its devices around it. Throws std::runtime_error: it is of another dialect, or a device cannot be had at all;
  // rung::Error.
  Instance instance(const Image& image, const rung_instance_options& options);
  // What is configured and has no device here, a sentence each; after `instance`.
  std::vector<std::string> warnings() const;
  // As many cells as the map has pins, in their order; cells and access outlive this. Before the first step.
  void connectAxes(const host::PinCell* cells, const host::PinAccess& access);
  // The threads that serve the devices.
  void start();
  // Outputs of CAN units are 0, tables are on disk. After the program's power-off.
  void end();

  // The thread of the program, before each of its steps, also where nothing of it is due: the clock has moved on. Not
  // while another thread switches the program on.
  void step(int64_t ns) noexcept;
  // No axis moves.
  bool axesAtRest() const noexcept;
  // In the place of `step` once the program has ended: axes that move brake, then no drive is enabled any more, and it
  // is true.
  bool rest(int64_t ns) noexcept;

  // What an operator should know of devices since the last call: gone, back, what was lost, what is refused. Any one
  // thread but the program's.
  std::vector<std::string> report();

private:
  std::string configureBy(const std::string& path);

  struct Machine;
  std::unique_ptr<Machine> machine_;
};

// The real devices of a machine around a program: who answers its requests, and when cells are read and written.

// All devices; they outlive the program.
struct Devices {
  SharedAreas areas;
  std::array<com::Port, com::kMostPorts> ports;
  CanService can;
  TableService tables;
  AxisService axes;
  ethercat::Master* master = &ethercat::noMaster();
  bool programStartsMaster = false; // EtherCATOPViaPLC
  std::atomic<bool> areasBroken{false};
};

class DevicesEnvironment final : public api::Environment {
public:
  // They have the devices of a program of this dialect, whose first one is `program`.
  DevicesEnvironment(Devices& devices, const rung_program& program);

  nc::Control& control() override { return *control_; }
  const nc::Control& control() const override { return *control_; }
  uint32_t works() const override;
  void powerOn(runtime::Instance& instance, nc::PowerOn kind) override;
  void beforePart(runtime::Instance& instance) override;
  void afterPart(runtime::Instance& instance) override;
  void onHook(runtime::Instance& instance, uint32_t work) override;
  void onFault(runtime::Instance& instance) override;
  bool respond(runtime::Instance& instance, const core::ServiceRequest& request, core::ServiceReply& reply) override;
  std::unique_ptr<nc::Places> locate(const rung_program& program) const override;
  void exchangePlaces(std::unique_ptr<nc::Places>& places) noexcept override;

private:
  struct Places;
  bool answer(runtime::Instance& instance, const core::ServiceRequest& request, core::ServiceReply& reply);
  com::Port* portOf(const DeviceCall& call); // null: there is none of this number
  bool askTable(DeviceCall& call);
  bool noteArea(const DeviceCall& call); // that has been answered
  void beforeInput(runtime::Instance& instance);
  void tickMaster(const core::Memory& memory);
  const Places& places() const;

  Devices& devices_;
  std::unique_ptr<nc::Control> control_;
  std::unique_ptr<nc::Places> places_; // of the program that runs
  AnswerBytes bytes_;
  EthercatCalls ethercat_;
  ethercat::StateRequests states_;
  ethercat::StateBits stateBits_;
};

} // namespace rung::io

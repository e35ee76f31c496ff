// The devices of this machine for a TECHNOL program of a host: serial ports, CAN interfaces, PLC tables in their files,
// shared areas, axes at the pins of a map, and the host's EtherCAT master, if it has one (inventory of the services,
// 17). Devices that are not configured do not exist: their instructions return the error of their section, their cells
// do not change.
//
// Order of calls: settings; `instance`, once; `start`; the program runs, with `step` in its thread; the program ends;
// `end`. Nothing in the scan waits, allocates or locks; with a file of shared areas, SA_READ and SA_WRITE each ask the
// system once for its length.
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
  ~HostDevices(); // must run after the program is destroyed
  HostDevices(const HostDevices&) = delete;
  HostDevices& operator=(const HostDevices&) = delete;

  // Whether programs of the dialect make requests to devices.
  static bool isFor(const Image& image);

  // ---- before `instance`; the functions return "", or the error

  // "2=can0": connects the CAN channel 1 or 2 to this interface and makes it active.
  std::string setCan(std::string_view setting);
  // "1=/dev/ttyUSB0": connects the serial port 0 to 15 to this device and makes it active.
  std::string setCom(std::string_view setting);
  // Puts the shared areas in this file, which other programs map (machine/io/shared).
  std::string setSharedFile(const std::string& path);
  // Sets everything in the table [devices] of a mapping file; errors are appended with their positions.
  void set(const host::File& map, std::vector<std::string>& errors);
  // Adds the pins of the axes in that table; errors as for `set`.
  void addAxisPins(host::File& map, std::vector<std::string>& errors);
  // Sets a configuration key of a device: COM[n], CAN[n], drive.n.type, axis.n, PlcTableDefN, PlcTableN,
  // EtherCATOPViaPLC; or PlcConfig, the control's own channel file, whose devices are configured. Paths are relative to
  // the working directory.
  std::string configure(std::string_view key, std::string_view value);
  // The host's master, which must outlive this object.
  void useMaster(ethercat::Master& master);
  // Connects the channel to a descriptor in place of an interface: it reads and writes one `can_frame` at a time; this
  // object closes it.
  void adoptCan(uint32_t channel, int descriptor);

  // ---- the program

  // Creates the program with its devices. Throws std::runtime_error if it is of another dialect, or a device cannot be
  // served at all; rung::Error.
  Instance instance(const Image& image, const rung_instance_options& options);
  // Configured devices that this machine does not have, one sentence each; to be called after `instance`.
  std::vector<std::string> warnings() const;
  // `cells` has one cell per pin of the map, in the order of the pins; cells and access must outlive this object. To be
  // called before the first step.
  void connectAxes(const host::PinCell* cells, const host::PinAccess& access);
  // Starts the threads that serve the devices.
  void start();
  // Sets the outputs of CAN units to 0 and writes tables to disk. To be called after the program's power-off.
  void end();

  // Scan thread, before each step of the program, even if no slice is due: advances the clock by `ns`. Not to be called
  // while another thread switches the program on.
  void step(int64_t ns) noexcept;
  // Whether no axis moves.
  bool axesAtRest() const noexcept;
  // Scan thread, in place of `step` once the program has ended: brakes moving axes, then disables all drives and
  // returns true.
  bool rest(int64_t ns) noexcept;

  // Reports for the operator since the last call: devices that are gone or back, losses, refusals. Any one thread
  // except the scan thread.
  std::vector<std::string> report();

private:
  std::string configureBy(const std::string& path);

  struct Machine;
  std::unique_ptr<Machine> machine_;
};

// The real devices of a machine around a program: answers its requests, and reads and writes its cells at the right
// moments.

// All devices; they must outlive the program.
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
  // The devices for a program of this dialect; `program` is the first program.
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
  com::Port* portOf(const DeviceCall& call); // null: no port with this number
  bool askTable(DeviceCall& call);
  bool noteArea(const DeviceCall& call); // which has been answered
  void beforeInput(runtime::Instance& instance);
  void tickMaster(const core::Memory& memory);
  const Places& places() const;

  Devices& devices_;
  std::unique_ptr<nc::Control> control_;
  std::unique_ptr<nc::Places> places_; // of the running program
  AnswerBytes bytes_;
  EthercatCalls ethercat_;
  ethercat::StateRequests states_;
  ethercat::StateBits stateBits_;
};

} // namespace rung::io

// The devices of the simulated TECHNOL control, connected to a program: who answers its requests, and which cells they
// read and write (inventory of the services, 1). Shared areas, orders of packets and the event CAN are always there,
// tables where the configuration names them, all else with `nc simulated`; requests to axes that are out of range are
// always answered.
#pragma once
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "machine/host/control_files.h"
#include "machine/io/can/can_requests.h"
#include "machine/io/com/port.h"
#include "machine/io/device_call.h"
#include "machine/io/ethercat/ethercat_requests.h"
#include "machine/io/tables/table_files.h"
#include "machine/io/tables/table_requests.h"
#include "sim/simulated_nc.h"
#include "sim/technol/devices/can_bus.h"
#include "sim/technol/devices/com.h"
#include "sim/technol/devices/ethercat.h"
#include "sim/technol/events.h"
#include "sim/technol/module_cells.h"
#include "sim/technol/requests/axis_requests.h"
#include "sim/technol/requests/device_events.h"
#include "sim/technol/requests/module_points.h"

namespace rung::sim::technol {

class SimulatedDevices {
public:
  // Process data of the simulated net are found there; handed over at a power-on.
  const EthercatImage& image() const { return ethercat_.image(); }
  // Before the first power-on. "" or what is wrong; nothing: a key of something else. `path` is that of a file.
  std::optional<std::string> configure(std::string_view key, std::string_view value, const std::string& path);
  // What the control's own file of the channel says of devices. "" or what is wrong, with its place.
  std::string define(std::span<const host::DeviceDefinition> definitions);
  bool simulated() const { return simulated_; }

  // Memory has been started; MODULE_INIT follows. A cold start reads the tables' files anew.
  void powerOn(runtime::Instance& instance, nc::PowerOn kind, const ConstantOf& constantOf);
  // What is wrong with the configuration, and the files of tables and keyboards as they were read last; each may have
  // several lines.
  std::vector<std::string> problems() const;
  // Another program has taken over from `former`, which still exists.
  void programChanged(runtime::Instance& instance, const rung_program& former);
  // START PLC, before MODULE_INIT.
  void startProgram();
  // A fault or HALT, after MODULE_HALT.
  void fault(runtime::Instance& instance);
  // A block of the part program has begun, whose motion PO_OSxPI says.
  void blockStarted(runtime::Instance& instance);
  // The hook before MODULE_INPUT: the devices do what they do in one scan.
  void beforeInput(runtime::Instance& instance, ModuleCells& cells);
  // The program does not run; the devices do, up to the time of now.
  void idle(runtime::Instance& instance, ModuleCells& cells);
  // False: no simulated device answers.
  bool respond(runtime::Instance& instance, const core::ServiceRequest& request, core::ServiceReply& reply);
  // Lines for the log since the last call.
  void takeLog(std::vector<std::string>& log);

  std::vector<std::string_view> events() const;
  // "" or what is wrong; nothing: another event.
  std::optional<std::string> event(runtime::Instance& instance, std::string_view name,
                                   std::span<const NcArgument> keys);
  // Quantities without "NC.".
  std::optional<double> quantity(std::string_view name) const;
  std::optional<std::string> setQuantity(std::string_view name, double value);
  // SA0+n:w, PlcTableN.…, KnobSelAxN, Pos6ShiftAxN, DISPTOCn.Shown[row][column], structures of the units on CAN
  // (device_cells.h), process data of the simulated net and positions of modules (module_points.h).
  std::optional<NcCell> readCell(std::string_view name) const;
  std::optional<std::string> writeCell(std::string_view name, const NcCell& value);
  std::string cellProblem(std::string_view name) const;
  bool cellMayCome(std::string_view name) const;
  // What has left a port, COM[n] or CAN[n], and has not been checked: it is compared where it is as the keys say. "" or
  // what is wrong.
  std::string expectSent(std::string_view port, std::span<const NcArgument> keys);

  // The tables, as the control stores them (SimulatedNc::keptSize).
  uint32_t keptSize();
  void copyKept(std::span<uint8_t> image) const noexcept { tables_.copyKept(image); }
  void restoreKept(std::span<const uint8_t> image);

private:
  // What an event does, and what it takes; its keys have been checked when it acts. "" or what is wrong.
  struct Event {
    std::string_view name;
    std::span<const EventKey> keys;
    std::string (SimulatedDevices::*act)(const EventKeys&);
    bool isScripted = false; // also with `nc scripted`
  };
  // Nothing: another event.
  std::optional<std::string> oneOf(std::span<const Event> events, std::string_view name,
                                   std::span<const NcArgument> given);
  static std::span<const Event> deviceEvents();
  std::string areaEvent(const EventKeys& keys);
  std::string tableEvent(const EventKeys& keys);
  std::string stopEvent(const EventKeys& keys);
  std::string referenceEvent(const EventKeys& keys);
  std::string manualEvent(const EventKeys& keys);
  std::string commandEvent(const EventKeys& keys);
  std::string handwheelEvent(const EventKeys& keys);
  // Events of buses.
  static std::span<const Event> portEvents();
  std::string canEvent(const EventKeys& keys);
  std::string unitEvent(const EventKeys& keys);
  std::string driveEvent(const EventKeys& keys);
  std::string busEvent(const EventKeys& keys);
  std::string lineEvent(const EventKeys& keys);
  std::string netEvent(const EventKeys& keys);
  std::string bytesSent(uint32_t number, const EventKeys& keys, bool none);
  std::string packetSent(uint32_t channel, const EventKeys& keys, bool none);

  bool answers(io::ServiceKind kind) const;
  void locate(runtime::Instance& instance);
  void loadTables();
  void pass(runtime::Instance& instance, ModuleCells& cells, int64_t us);
  std::optional<NcCell> readTable(std::string_view name) const;
  std::optional<NcCell> readModule(std::string_view name) const;
  std::optional<NcCell> readElement(std::string_view identifier) const;
  // RUNG_NONE: it is not an input of the simulated net.
  uint32_t inputOfNet(std::string_view identifier) const;
  // Nothing: neither axes nor servos give it.
  std::optional<ModuleElement> givenElement(std::string_view identifier) const;
  // Why an element cannot be set, "": devices do not give it.
  std::string givenProblem(std::string_view identifier) const;
  std::optional<std::string> writeTable(std::string_view name, const NcCell& value);
  // Of a place that is not on the display, or of a handwheel that is not there.
  std::string displayProblem(uint32_t wheel) const;
  // Null: no such handwheel.
  const HandwheelDisplay* displayOf(uint32_t wheel) const;
  std::string keyEvent(runtime::Instance& instance, std::span<const NcArgument> given);
  void pressKey(runtime::Instance& instance, uint32_t keyboard, uint32_t scan, bool pressed);
  void takeVirtualKeys(runtime::Instance& instance, const ModuleCells& cells);
  void tickAxes(runtime::Instance& instance, uint32_t ticks);
  void tickOthers(runtime::Instance& instance, ModuleCells& cells, uint32_t ticks);
  void complainOfDrive(const io::DeviceCall& call);

  bool simulated_ = false;
  bool hasTables_ = false;
  io::TableFiles files_;
  io::PlcTables tables_;
  io::SharedAreas areas_;
  Axes axes_;
  ComPorts com_;
  CanDevices can_;
  io::CanCalls canCalls_{can_.control()};
  EtherCat ethercat_;
  io::EthercatCalls ethercatCalls_{ethercat_};
  EthercatServos servos_;
  Keyboards keyboards_;

  io::AnswerBytes bytes_;
  AxisPlaces axisPlaces_;
  io::CanPlaces canPlaces_;
  io::StatePlaces statePlaces_;
  ServoPlaces servoPlaces_;
  SharedPoints sharedPoints_;
  KeyboardPlaces keyboardPlaces_;
  AxisInputs axisInputs_;
  AxisRequests axisRequests_;
  AxisOutputs axisOutputs_;
  InputWiring inputs_;
  CanInputs canInputs_;
  CanOutputs canOutputs_;
  Complaints complaints_;
  io::ethercat::StateBits stateBits_;
  EthercatServos::Cells servoCells_;
  int64_t devicesUs_ = 0; // the time up to which the devices have come
  int64_t restUs_ = 0;    // of it, in which no tick has been made yet
  std::string tableProblem_, keyProblem_;
  bool tablesLoaded_ = false;
  bool tablesRestored_ = false; // for the next power-on
};

} // namespace rung::sim::technol

// The devices of the simulated TECHNOL control, connected to a program: they answer its requests, and read and write
// its cells (inventory of the services, 1). Shared areas, packet subscriptions and the event CAN always exist, tables
// if they are configured, everything else with `nc simulated`; requests to axes that are out of range are always
// answered.
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
  // The process data of the simulated network, valid from a power-on.
  const EthercatImage& image() const { return ethercat_.image(); }
  // To be called before the first power-on. Returns "", or the error; nothing for other keys. `path`: the value as the
  // path of a file.
  std::optional<std::string> configure(std::string_view key, std::string_view value, const std::string& path);
  // Configures the devices described in the control's own channel file. Returns "", or the error with its position.
  std::string define(std::span<const host::DeviceDefinition> definitions);
  bool simulated() const { return simulated_; }

  // Memory has been initialized; MODULE_INIT follows. A cold start reads the files of tables again.
  void powerOn(runtime::Instance& instance, nc::PowerOn kind, const ConstantOf& constantOf);
  // Errors of the configuration, and of the files of tables and keyboards when last read; each may have several lines.
  std::vector<std::string> problems() const;
  // Another program has taken over from `former`, which still exists.
  void programChanged(runtime::Instance& instance, const rung_program& former);
  // START PLC, before MODULE_INIT.
  void startProgram();
  // A fault or HALT, after MODULE_HALT.
  void fault(runtime::Instance& instance);
  // A block of the part program has begun; PO_OSxPI shows its motion.
  void blockStarted(runtime::Instance& instance);
  // The hook before MODULE_INPUT: the devices do the work of one scan.
  void beforeInput(runtime::Instance& instance, ModuleCells& cells);
  // The program does not run; the devices continue up to the current time.
  void idle(runtime::Instance& instance, ModuleCells& cells);
  // Returns false if no simulated device answers.
  bool respond(runtime::Instance& instance, const core::ServiceRequest& request, core::ServiceReply& reply);
  // Takes the lines for the log since the last call.
  void takeLog(std::vector<std::string>& log);

  std::vector<std::string_view> events() const;
  // Returns "", or the error; nothing for other events.
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
  // Checks data that a port, COM[n] or CAN[n], has sent and that have not been checked: they must match the keys.
  // Returns "", or the error.
  std::string expectSent(std::string_view port, std::span<const NcArgument> keys);

  // The tables as the control stores them (SimulatedNc::retainedSize).
  uint32_t retainedSize();
  void copyRetained(std::span<uint8_t> image) const noexcept { tables_.copyRetained(image); }
  void restoreRetained(std::span<const uint8_t> image);

  // Without complaints: they are taken at the end of each part of a scan and of each event.
  template <class Archive>
  void state(Archive& archive) {
    archive(tables_, areas_, axes_, com_, can_, canCalls_, ethercat_, ethercatCalls_, servos_, keyboards_, bytes_,
            axisInputs_.blockMotion, axisRequests_, axisOutputs_, inputs_, canInputs_.terminals, canOutputs_.units,
            canOutputs_.drives, stateBits_, devicesUs_, restUs_);
    EthercatServos::archiveCells(archive, servoCells_);
  }

private:
  // An event: its keys, which are checked before it acts, and its action, which returns "", or the error.
  struct Event {
    std::string_view name;
    std::span<const EventKey> keys;
    std::string (SimulatedDevices::*act)(const EventKeys&);
    bool isScripted = false; // also with `nc scripted`
  };
  // Nothing for other events.
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
  // RUNG_NONE: not an input of the simulated network.
  uint32_t inputOfNet(std::string_view identifier) const;
  // Nothing: neither axes nor servos have a value for it.
  std::optional<ModuleElement> givenElement(std::string_view identifier) const;
  // Why an element cannot be set; "": devices do not set it.
  std::string givenProblem(std::string_view identifier) const;
  std::optional<std::string> writeTable(std::string_view name, const NcCell& value);
  // For a place outside the display, or a handwheel that does not exist.
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
  int64_t devicesUs_ = 0; // time up to which the devices have worked
  int64_t restUs_ = 0;    // part of it that is less than a tick
  std::string tableProblem_, keyProblem_;
  bool tablesLoaded_ = false;
  bool tablesRestored_ = false; // they were restored for the next power-on
};

} // namespace rung::sim::technol

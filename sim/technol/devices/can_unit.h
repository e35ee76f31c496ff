// The objects of a simulated unit or drive, and its answers to SDO requests for them (CiA 301).
#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "machine/io/can/channel.h"
#include "machine/io/can/drives.h"
#include "machine/io/can/unit.h"
#include "sim/technol/devices/keyboards.h"

namespace rung::sim::technol {

enum class ObjectAccess : uint8_t { ReadWrite, ReadOnly, WriteOnly };

struct CanObject {
  io::sdo::Object place;
  uint32_t bytes = 4; // 1, 2 or 4
  uint32_t value = 0;
  ObjectAccess access = ObjectAccess::ReadOnly;

  template <class Archive>
  void state(Archive& archive) {
    archive(value);
  }
};

class CanObjects {
public:
  // `noSubindex`: the abort code if the index exists only with other subindices.
  explicit CanObjects(uint32_t noSubindex) : noSubindex_(noSubindex) {}
  // Adds an object; replaces one with the same place.
  void add(const CanObject& object);
  const CanObject* find(io::sdo::Object place) const;
  uint32_t value(io::sdo::Object place) const;
  // Does nothing if there is no such object.
  void set(io::sdo::Object place, uint32_t value);

  // The answer to a request; `written` is the object that the request has written, or null.
  io::CanPacket answer(uint32_t node, const io::CanPacket& request, const CanObject*& written);

  template <class Archive>
  void state(Archive& archive) {
    archive.each(objects_);
  }

private:
  CanObject* find(io::sdo::Object place);
  uint32_t missing(uint16_t index) const;

  uint32_t noSubindex_;
  std::vector<CanObject> objects_;
};

// A simulated unit on CAN channel 2: INOUT08, KLA50 or EPU panel, handwheel (man. 9.2, 9.6). io::CanUnit is the
// control's side.
//
// 1600h and 1A00h, which can be written while the unit is not operational, define the bytes of RPDO1 and TPDO1; by
// default these are outputs and inputs (l.4805-4858).

using NodePackets = io::BoundedQueue<io::CanPacket, 512>;

// The wiring of a unit, and its faults.
struct UnitWires {
  std::array<uint8_t, io::kUnitInputs> in{};           // IP0 to IP3; IP0 and IP1 of a handwheel are its keys
  std::array<uint8_t, 8> analogue{};                   // 6404h: potentiometers, 0 left end, 0FFh right end (l.4459)
  std::array<uint8_t, 4> keys{0xFF, 0xFF, 0xFF, 0xFF}; // 2108h: pressed keys of a matrix, 0FFh none (l.4567)
  std::array<uint16_t, 2> encoders{};                  // 210Dh (l.4607)
  std::array<uint8_t, io::kUnitOutputs> shorts{};      // shorted outputs of OP0 to OP2
  uint8_t error = 0;                                   // error register 1001h without bits 0 and 1 (l.3655-3668)
  bool silent = false;

  template <class Archive>
  void state(Archive& archive) {
    archive(in, analogue, keys, encoders, shorts, error, silent);
  }
};

class SimulatedUnit {
public:
  SimulatedUnit(uint32_t group, uint32_t board);

  uint32_t group() const { return group_; }
  uint32_t board() const { return board_; } // from 1
  uint8_t node() const { return node_; }
  UnitWires& wires() { return wires_; }
  const UnitWires& wires() const { return wires_; }
  // The state of the terminals OP0 to OP2.
  uint8_t output(uint32_t port) const;
  // Null: the unit is not a handwheel.
  const HandwheelDisplay* display() const { return display_.empty() ? nullptr : display_.data(); }

  // At a power-on: keeps the wiring and clears faults.
  void power();
  void receive(const io::CanPacket& packet, NodePackets& answers);
  // One millisecond.
  void tick(NodePackets& answers);

  template <class Archive>
  void state(Archive& archive) {
    archive(wires_, objects_, operational_, sendsAnalogue_, rpdo_, tpdo_, received_, shown_, outputs_, reported_,
            reportedShorts_);
    archive.each(display_);
  }

private:
  void setDefaults();
  uint8_t errorRegister() const;
  void takeOver();
  uint8_t input(io::sdo::Object field) const;
  uint32_t refusal(const io::CanPacket& request) const;
  void takeWritten(const CanObject& object);
  void answer(const io::CanPacket& request, NodePackets& answers);
  void sendInputs(NodePackets& answers) const;
  void refresh();

  uint32_t group_, board_;
  uint8_t node_;
  UnitWires wires_;
  CanObjects objects_{io::sdo::kNoSuchObject};
  std::vector<HandwheelDisplay> display_; // one element for a handwheel, otherwise empty
  bool operational_ = false;
  bool sendsAnalogue_ = false; // sends TPDO2 after each SYNC, according to object 1801h-1
  io::PdoFields rpdo_{}, tpdo_{};
  std::array<uint8_t, 8> received_{}; // RPDO1, applied at SYNC
  std::array<uint8_t, 8> shown_{};    // TOC_DISPLS
  std::array<uint8_t, io::kUnitOutputs> outputs_{};
  uint8_t reported_ = 0; // error register and shorts of the last emergency
  std::array<uint8_t, io::kUnitOutputs> reportedShorts_{};
};

// A simulated drive on CAN channel 1: Kollmorgen (or Berger-Lahr) with the states of CiA 402, or Unidrive (man. 13.14).

class SimulatedDrive {
public:
  explicit SimulatedDrive(uint32_t number);

  uint8_t node() const { return node_; }
  void setType(io::DriveType type) { type_ = type; }
  // Adds an object of the configuration; a power-on restores its value.
  void addObject(const CanObject& object);
  const CanObjects& objects() const { return objects_; }

  void power();
  void receive(const io::CanPacket& packet, NodePackets& answers);

  // ---- actions of a scenario

  // Sends an emergency with this error code. `holds`: its cause persists, so that it cannot be reset. 0: the cause is
  // gone.
  void fault(uint16_t code, bool holds, NodePackets& answers);
  void setManufacturerStatus(uint16_t status) { manufacturer_ = status; }
  void setSilent(bool silent) { silent_ = silent; }

  template <class Archive>
  void state(Archive& archive) {
    archive(objects_, operational_, silent_, state_, word_, received_, code_, holds_, manufacturer_);
  }

private:
  enum class State : uint8_t { SwitchOnDisabled, ReadyToSwitchOn, SwitchedOn, Enabled, Fault };

  void control(uint16_t word, NodePackets& answers);
  void follow(uint16_t word);
  void resetFault();
  uint16_t status() const;
  void sendStatus(NodePackets& answers) const;
  void refresh();
  void answer(const io::CanPacket& request, NodePackets& answers);

  uint8_t node_;
  io::DriveType type_ = io::DriveType::Kollmorgen;
  CanObjects objects_{io::sdo::kNoSuchSubindex};
  std::vector<CanObject> configured_;
  bool operational_ = false, silent_ = false;
  State state_ = State::SwitchOnDisabled;
  uint16_t word_ = 0;     // control word; for a Unidrive, the bits that its masks permit
  uint16_t received_ = 0; // RPDO1, applied at SYNC
  uint16_t code_ = 0;     // error code of the fault
  bool holds_ = false;
  uint16_t manufacturer_ = 0;
};

} // namespace rung::sim::technol

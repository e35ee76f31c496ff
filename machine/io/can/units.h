// The control's side of its units on the CAN bus: INOUT08, KLA50 and EPU panels, handwheels (man. ch. 9). It starts
// them, exchanges outputs and inputs by SYNC and PDOs, reads and writes their objects by SDO, maintains the structure
// INOUTS of each, and detects errors and time-outs. It works on packets, so the units may be simulated or real.
//
// The identifiers of PDOs are those of l.4370-4383; unit.h has their bytes. TPDO2 is ANL0 to ANL7. A unit reports
// errors by emergency packets.
#pragma once
#include <cstdint>
#include <vector>

#include "machine/io/can/unit.h"

namespace rung::io {

inline constexpr uint32_t kInputPorts = 128, kOutputPorts = 96, kHandwheels = 2;

// CAN_IO_..., CAN_MAT_..., CAN_TOC_...: the lowest board of the group with the error; number 0: none (man.
// l.3616-3651).
struct GroupCodes {
  uint8_t errorCode = 0, errorNumber = 0;     // _ERROR_CODE, register 1001h; _ERROR_NUM
  uint8_t timeoutCode = 0, timeoutNumber = 0; // _TIMEOUT_CODE, 1; _TIMEOUT_NUM

  bool operator==(const GroupCodes&) const = default;
  template <class Archive>
  void state(Archive& archive) {
    archive(errorCode, errorNumber, timeoutCode, timeoutNumber);
  }
};

// Values from the program.
struct UnitOrders {
  std::array<uint8_t, kOutputPorts> out{};                   // PxOUT, x from 0
  std::array<std::array<uint8_t, 8>, kHandwheels> display{}; // DISPTOCn, TOC_DISPLS
  std::array<bool, kHandwheels> displayBusy{};               // BUSY_DISPTOCn: the program is writing to it
};

// Values for the program.
struct UnitStates {
  std::array<uint8_t, kInputPorts> in{};                  // PxIN from x = 1; 0 for ports without a unit
  std::array<uint8_t, kOutputPorts> errors{};             // ERRLI_PxOUT; the program also resets its bits
  std::array<std::array<uint8_t, 2>, kHandwheels> keys{}; // PTLTOC_Pn, PTLTOC_Pn_2
  std::array<GroupCodes, kUnitGroups> groups{};
  bool zeroed = false; // a unit has a serious error: all outputs are 0 (man. l.3674)

  template <class Archive>
  void state(Archive& archive) {
    archive(in, errors, keys, groups, zeroed);
  }
};

class CanUnits {
public:
  // To be called before the first tick: number of units of a group; period of SYNC, 1 to 15 ms (man. l.3268-3271).
  void configure(uint32_t group, uint32_t units);
  void setControl(uint32_t group, uint32_t board, uint8_t control);
  void setSyncPeriod(uint32_t ms) { syncPeriod_ = ms; }
  uint32_t count(uint32_t group) const;
  bool isEmpty() const { return units_.empty(); }

  // At a power-on.
  void reset();
  // One millisecond before the first tick, without process data: maps and starts units. If the control waits for this
  // before it starts the program, scans have none of this work.
  void prepare(CanPort& port);
  bool areStarted() const;
  // One millisecond. `states.errors` is also read.
  void tick(const UnitOrders& orders, UnitStates& states, CanPort& port);
  // The oldest message not yet taken.
  bool takeMessage(UnitMessage& message) { return messages_.pop(message); }
  // Processes a received packet. Returns true if it is only for the control, not for the program.
  bool take(const CanPacket& packet);

  // Null: the group or the board is not configured. Boards from 1.
  const Inouts* find(uint32_t group, uint32_t board) const;
  // CAN_SYSIO_READ and CAN_SYSIO_WRITE. False: no such unit, or no such item.
  bool read(uint32_t group, uint32_t board, InoutsItem item, uint32_t& value) const;
  bool write(uint32_t group, uint32_t board, InoutsItem item, uint32_t value);

  template <class Archive>
  void state(Archive& archive) {
    archive(display_, messages_, sinceSync_, started_);
    archive.each(units_);
  }

private:
  void synchronize(const UnitOrders& orders, CanPort& port);
  void output(const UnitOrders& orders, UnitStates& states);
  static void show(const CanUnit& unit, UnitStates& states);
  // Position in `units_`, from 1; 0: no such unit.
  uint32_t numberOf(uint32_t group, uint32_t board) const;

  std::vector<CanUnit> units_;                                // by group and board
  std::array<uint8_t, kCanNode + 1> numbers_{};               // position in `units_`, from 1, by node; 0: no unit
  std::array<std::array<uint8_t, 8>, kHandwheels> display_{}; // last complete values
  UnitMessages messages_;
  uint32_t syncPeriod_ = 1, sinceSync_ = 0;
  bool started_ = false;
};

// The control's SDO requests to a unit: sets of requests, one bit each. The lowest waiting one is sent first.

namespace requests {

inline constexpr uint32_t kShorts = 0b111;          // 2101h:1-3 (man. l.3674-3678)
inline constexpr uint32_t kRegister = 1 << 3;       // 1001h
inline constexpr uint32_t kWheelMode = 1 << 4;      // 2110h: the keys of a handwheel work (man. l.4647-4663)
inline constexpr uint32_t kMappingAt = 5;           // the first bit of kMapping
inline constexpr uint32_t kMapping = 0xFFFF << 5;   // 1600h:1-8, 1A00h:1-8
inline constexpr uint32_t kAnalogue = 1 << 21;      // 1801h:1: whether the unit sends TPDO2
inline constexpr uint32_t kModes = 0b11 << 21;      // kAnalogue, and 2109h, which switches the matrix
inline constexpr uint32_t kDisplay = 0b1111 << 23;  // of a handwheel
inline constexpr uint32_t kIdentity = 0b1111 << 27; // 1018h, 1008h, 1009h, 100Ah (man. l.4079-4082)

// Requests that precede the exchange of process data.
inline constexpr uint32_t kBeforeStart = kWheelMode | kMapping | kAnalogue;

} // namespace requests

} // namespace rung::io

// CAN_*: packets, orders, units and drives, and their cells (man. ch. 9, 13.14).
#pragma once
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "machine/io/can/controller.h"
#include "machine/io/device_call.h"
#include "rtlib/change/relocation.h"
#include "rtlib/core/handover.h"
#include "rtlib/nc/control/technol/cells.h"

namespace rung::io {

// Where the cells lie in a program; the tasks of its event procedures.
class CanPlaces {
public:
  CanPlaces() = default; // a program that has nothing
  explicit CanPlaces(const rung_program& program);

  // The program resets bits of `errors`, ERRLI_PxOUT.
  void read(const core::Memory& memory, UnitOrders& unitOrders, DriveOrders& driveOrders,
            std::array<uint8_t, kOutputPorts>& errors) const;
  // Of the units and drives that exist.
  void write(const core::Memory& memory, const UnitStates& units, const DriveStates& drives,
             const CanController& can) const;
  // What others than the units have put into the input ports since they were written.
  void readTerminals(const core::Memory& memory, const UnitStates& written,
                     std::array<uint8_t, kInputPorts>& terminals) const;
  // CAN_DRIVE_CMD of all becomes 0.
  void disableDrives(const core::Memory& memory) const;
  // CAN_AX_RECV_PACKET, and CAN_AX_BUSY becomes 0.
  void writeDriveAnswer(const core::Memory& memory, const CanPacket& answer) const;
  const nc::technol::Procedure* procedure(uint64_t number) const {
    return number < procedures_.size() ? &procedures_[number].procedure : nullptr;
  }
  // The number of the procedure that another program has as `number`; nothing: none of its name.
  std::optional<uint64_t> numberOf(const CanPlaces& other, uint64_t number) const noexcept;

private:
  std::array<core::Place, kInputPorts> in_;
  std::array<core::Place, kOutputPorts> out_, errors_;
  std::array<core::Place, kMostDrives> command_, status_, manufacturer_;
  std::array<std::array<core::Place, 4>, kUnitGroups> codes_;
  std::array<std::array<core::Place, 2>, kHandwheels> keys_;
  std::array<std::array<core::Place, 8>, kHandwheels> display_;
  std::array<core::Place, kHandwheels> displayBusy_;
  std::array<core::Place, kCanDataBytes> answerData_;
  core::Place answerId_, answerRemote_, answerLength_, driveBusy_;
  struct NamedProcedure {
    std::string name;
    nc::technol::Procedure procedure;
  };
  void locateProcedures(const rung_program& program);

  std::vector<NamedProcedure> procedures_;
};

// An order of packets that has ended because another program has taken over, and what that one does not have.
struct EndedOrder {
  uint32_t handle = 0;
  bool lacksBuffer = false, lacksProcedure = false;
};
// As the log has it.
std::string textOf(const EndedOrder& order);

class CanCalls {
public:
  explicit CanCalls(CanController& can);

  // At a power-on and START PLC: no order is left.
  void clear() { orders_ = {}; }
  // Another program has taken over: orders continue with its procedures and its buffers. Those that lack one of them
  // end. Allocates nothing.
  void relocate(const CanPlaces& former, const CanPlaces& now, const runtime::Relocation& relocation) noexcept;
  // The oldest such order that was not taken, of at most 64; any one thread.
  bool takeEnded(EndedOrder& order) { return ended_.pop(order); }
  void answer(DeviceCall& call);
  // After the ticks of a scan: what has come goes into the buffers of orders, and their procedures run; else it waits
  // for CAN_RECV. A program that is stopped has no orders, and its packets are dropped.
  void deliver(runtime::Instance& instance, const CanPlaces& places);
  // The answer of a drive, and whether one is waited for.
  void showDrive(const core::Memory& memory, const CanPlaces& places);

private:
  struct Order {
    uint32_t handle = 0; // 0: none
    int64_t buffer = 0;  // nc::technol::bytesArgument
    uint64_t procedure = 0;
  };
  void send(DeviceCall& call);
  void receive(DeviceCall& call);
  void order(DeviceCall& call);
  void endOrder(DeviceCall& call);
  void end(Order& order, const EndedOrder& why) noexcept;
  void readItem(DeviceCall& call);
  void writeItem(DeviceCall& call);
  void sendToDrive(DeviceCall& call);
  InoutsItem itemAt(int64_t offset) const;
  void run(runtime::Instance& instance, const CanPlaces& places, uint32_t channel, const CanPacket& packet);

  CanController& can_;
  const std::array<uint8_t, inouts::kBytes> itemWidths_; // of INOUTS, by place
  std::array<Order, kMostCanOrders> orders_ = {};
  core::FixedRing<EndedOrder, 64> ended_;
  bool asksDrive_ = false;
};

} // namespace rung::io

// CAN_*: packets, packet subscriptions, units and drives, and their cells (man. ch. 9, 13.14).
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

// The places of the cells in a program, and the tasks of its event procedures.
class CanPlaces {
public:
  CanPlaces() = default; // for a program without these cells
  explicit CanPlaces(const rung_program& program);

  // Reads the program's commands, and `errors`, the bits ERRLI_PxOUT, which the program resets.
  void read(const core::Memory& memory, UnitOrders& unitOrders, DriveOrders& driveOrders,
            std::array<uint8_t, kOutputPorts>& errors) const;
  // Writes the states of the units and drives that exist.
  void write(const core::Memory& memory, const UnitStates& units, const DriveStates& drives,
             const CanController& can) const;
  // Reads the input ports that code other than the units has changed since they were written.
  void readTerminals(const core::Memory& memory, const UnitStates& written,
                     std::array<uint8_t, kInputPorts>& terminals) const;
  // Sets CAN_DRIVE_CMD of all drives to 0.
  void disableDrives(const core::Memory& memory) const;
  // Writes CAN_AX_RECV_PACKET, and sets CAN_AX_BUSY to 0.
  void writeDriveAnswer(const core::Memory& memory, const CanPacket& answer) const;
  const nc::technol::Procedure* procedure(uint64_t number) const {
    return number < procedures_.size() ? &procedures_[number].procedure : nullptr;
  }
  // The number of the procedure with the name that `number` has in another program; nothing: there is none.
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

// A packet subscription (CAN_RECV_REQ) that has ended because the new program lacks its buffer or procedure.
struct EndedOrder {
  uint32_t handle = 0;
  bool lacksBuffer = false, lacksProcedure = false;
};
// The sentence for the log.
std::string textOf(const EndedOrder& order);

class CanCalls {
public:
  explicit CanCalls(CanController& can);

  // At a power-on and START PLC: deletes all subscriptions.
  void clear() { orders_ = {}; }
  // Another program has taken over: subscriptions continue with its procedures and buffers; those that lack one of them
  // end. Allocates nothing.
  void relocate(const CanPlaces& former, const CanPlaces& now, const runtime::Relocation& relocation) noexcept;
  // The oldest ended subscription not yet taken, of at most 64; any one thread.
  bool takeEnded(EndedOrder& order) { return ended_.pop(order); }
  void answer(DeviceCall& call);
  // After the ticks of a scan: copies received packets to the buffers of matching subscriptions and runs their
  // procedures; other packets wait for CAN_RECV. A stopped program has no subscriptions, and its packets are dropped.
  void deliver(runtime::Instance& instance, const CanPlaces& places);
  // Writes the answer of a drive, and whether an answer is awaited.
  void showDrive(const core::Memory& memory, const CanPlaces& places);

  template <class Archive>
  void state(Archive& archive) {
    archive(orders_, asksDrive_);
  }

private:
  struct Order {
    uint32_t handle = 0; // 0: unused
    int64_t buffer = 0;  // of nc::technol::bytesArgument
    uint64_t procedure = 0;
    template <class Archive>
    void state(Archive& archive) {
      archive(handle, buffer, procedure);
    }
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
  const std::array<uint8_t, inouts::kBytes> itemWidths_; // widths of INOUTS items, by offset
  std::array<Order, kMostCanOrders> orders_ = {};
  core::FixedRing<EndedOrder, 64> ended_;
  bool asksDrive_ = false;
};

} // namespace rung::io

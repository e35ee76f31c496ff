// The two CAN channels of a control and the control's own traffic on them: drives on channel 1, units on channel 2
// (man. l.3242, l.9210). The buses are ports, simulated or real; without a port a channel is not active.
//
// Sequence of each millisecond: transmit; a simulated bus works; receive. Then the program's host takes the received
// packets one by one (takeReceived) and passes them to channel(n).deliver, which returns the subscriptions whose
// procedures must run.
#pragma once
#include "machine/io/can/drives.h"
#include "machine/io/can/units.h"

namespace rung::io {

class CanController {
public:
  static constexpr uint32_t kChannels = 2, kDriveChannel = 1, kUnitChannel = 2;

  CanController() = default;
  CanController(const CanController&) = delete;
  CanController& operator=(const CanController&) = delete;

  // To be called before the first tick. Ports must outlive the controller; channels are 1 and 2.
  void connect(uint32_t channel, CanPort& port) { ports_[channel - 1] = &port; }
  CanUnits& units() { return units_; }
  CanDrives& drives() { return drives_; }
  const CanUnits& units() const { return units_; }
  const CanDrives& drives() const { return drives_; }

  // At a power-on.
  void power();
  // One millisecond before the first one of the program; see CanUnits::prepare.
  void prepareUnits() { units_.prepare(*ports_[kUnitChannel - 1]); }
  // START PLC: deletes packet subscriptions; everything else stays.
  void startProgram() { orders_.clear(); }

  // Passes packets of the control and the program to the ports.
  void transmit(const UnitOrders& unitOrders, UnitStates& unitStates, const DriveOrders& driveOrders,
                DriveStates& driveStates);
  // Takes packets from the ports, for the control or for takeReceived.
  void receive();

  // ---- instructions

  // CAN_SEND, CAN_RECV, CAN_RECV_REQ; `channel` is 1 or 2.
  CanChannel& channel(uint32_t channel) { return channels_[channel - 1]; }
  // CAN_RECV_DEL, CAN_RECV_END.
  CanOrders& orders() { return orders_; }
  // CAN_SYSIO_READ, CAN_SYSIO_WRITE: false if the channel is not active, or has no such unit.
  bool readItem(uint32_t channel, uint32_t group, uint32_t board, InoutsItem item, uint32_t& value) const;
  bool writeItem(uint32_t channel, uint32_t group, uint32_t board, InoutsItem item, uint32_t value);
  // CAN_AX_SEND, and the cells CAN_AX_BUSY and CAN_AX_RECV_PACKET.
  void sendToDrive(uint32_t axis, CanPacket& packet) { drives_.send(axis, packet); }
  uint8_t driveBusy() const { return drives_.busy(); }
  const CanPacket& driveAnswer() const { return drives_.answer(); }

  // ---- packets

  // The oldest received packet for the program.
  bool takeReceived(uint32_t channel, CanPacket& packet) { return received_[channel - 1].pop(packet); }
  // Adds a packet that does not come from a port.
  void putReceived(uint32_t channel, const CanPacket& packet) { received_[channel - 1].pushAnyway(packet); }
  // The oldest packet of the program's CAN_SEND that was passed to the port; of more than 1024, the oldest are lost.
  bool takeSent(uint32_t channel, CanPacket& packet) { return sent_[channel - 1].pop(packet); }
  // Messages 4217 and 4219 of the control, and messages about units.
  bool takeMessage(DriveMessage& message) { return drives_.takeMessage(message); }
  bool takeMessage(UnitMessage& message) { return units_.takeMessage(message); }

  // Sets the channel's state to that of its port, which may change between two ticks.
  void updateState(uint32_t channel);

  template <class Archive>
  void state(Archive& archive) {
    archive(orders_, channels_, units_, drives_, received_, sent_);
  }

private:
  struct NoPort final : CanPort {
    BusState state() const override { return BusState::Inactive; }
    bool transmit(const CanPacket&) override { return false; }
    bool receive(CanPacket&) override { return false; }
  };
  void sendOwn(uint32_t channel);
  bool takeForControl(uint32_t channel, const CanPacket& packet);

  CanOrders orders_;
  std::array<CanChannel, kChannels> channels_{CanChannel(1, orders_), CanChannel(2, orders_)};
  NoPort noPort_;
  std::array<CanPort*, kChannels> ports_{&noPort_, &noPort_};
  CanUnits units_;
  CanDrives drives_;
  std::array<BoundedQueue<CanPacket, 256>, kChannels> received_;
  std::array<BoundedQueue<CanPacket, 1024>, kChannels> sent_;
};

} // namespace rung::io

// A logical CAN channel as a PLC program sees it (man. l.3689-3860): the queue of what it sends, the queue of what it
// receives, its orders. What moves the packets, a simulated bus or a real one, is a CanPort (port.h). All of it runs on
// the scan's thread.
#pragma once
#include "machine/io/can/bounded_queue.h"
#include "machine/io/can/orders.h"
#include "machine/io/can/packet.h"

namespace rung::io {

enum class BusState : uint8_t {
  Inactive, // the configuration has no such channel
  Active,
  BusOff, // the controller has left the bus after too many errors
  Down,   // the interface is not there, or is switched off
};

// The values of DR after CAN_SEND and CAN_RECV (man. l.3708-3717).
enum class CanError : uint8_t { Ok = 0, SendQueueFull = 1, NothingReceived = 2 };

class CanChannel {
public:
  static constexpr uint32_t kQueue = 32;

  // `number` is 1 or 2; `orders` outlives the channel.
  CanChannel(uint32_t number, CanOrders& orders) : number_(number), orders_(orders) {}

  uint32_t number() const { return number_; }
  BusState state() const { return state_; }
  void setState(BusState state) { state_ = state; }
  bool isActive() const { return state_ != BusState::Inactive; }
  // At a power-on: the queues are empty.
  void reset();

  // ---- the program's instructions

  // CAN_SEND. The queue is full; or the channel is not active, or off the bus.
  CanError send(const CanPacket& packet);
  // CAN_RECV. `packet` stays where nothing has come.
  CanError receive(CanPacket& packet);
  // CAN_RECV_REQ; `order.channel` is set here. 0: refused.
  uint32_t order(CanOrder order);

  // ---- the bus

  // The oldest packet that the program sends.
  bool takeToSend(CanPacket& packet) { return toSend_.pop(packet); }
  bool peekToSend(CanPacket& packet) const { return toSend_.peek(packet); }
  // A packet has come. The orders that it fills; without one it waits for CAN_RECV, and of more than 32 the oldest is
  // lost.
  CanMatches deliver(const CanPacket& packet);

private:
  uint32_t number_;
  CanOrders& orders_;
  BusState state_ = BusState::Inactive;
  BoundedQueue<CanPacket, kQueue> toSend_, received_;
};

} // namespace rung::io

// A logical channel: CAN_SEND, CAN_RECV, CAN_RECV_REQ, CAN_RECV_DEL (man. l.3680-3860).
#include "machine/io/can/controller.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace {

using namespace rung::io;
using testing::ElementsAre;

struct Channel : testing::Test {
  Channel() { channel.setState(BusState::Active); }
  CanMatches deliver(uint32_t id) { return channel.deliver(packetOf(id, {1})); }

  CanOrders orders;
  CanChannel channel{2, orders}, other{1, orders};
  CanPacket packet;
};

TEST_F(Channel, SendQueueHolds32) {
  for (uint32_t i = 0; i < 32; ++i) EXPECT_EQ(channel.send(packetOf(i, {})), CanError::Ok);
  EXPECT_EQ(channel.send(packetOf(32, {})), CanError::SendQueueFull);
  ASSERT_TRUE(channel.takeToSend(packet));
  EXPECT_EQ(packet.id, 0);
  EXPECT_EQ(channel.send(packetOf(33, {})), CanError::Ok);
}

TEST_F(Channel, WhatIsSentFitsTheBus) {
  channel.send({.id = 0xF810, .remote = 5, .length = 200, .data = {1, 2, 3, 4, 5, 6, 7, 8}});
  ASSERT_TRUE(channel.takeToSend(packet));
  EXPECT_EQ(packet, (CanPacket{.id = 0x10, .remote = 1, .length = 8}));
  channel.send({.id = 0x10, .length = 2, .data = {2, 0x55, 9}});
  ASSERT_TRUE(channel.takeToSend(packet));
  EXPECT_EQ(packet, packetOf(0x10, {2, 0x55}));
}

TEST_F(Channel, SendsOnlyWhileTheBusTakesPackets) {
  for (const BusState state : {BusState::Inactive, BusState::BusOff, BusState::Down}) {
    channel.setState(state);
    EXPECT_EQ(channel.send(packetOf(1, {})), CanError::SendQueueFull);
  }
}

TEST_F(Channel, ReceiveQueueLosesTheOldest) {
  packet = packetOf(0x7F, {9});
  EXPECT_EQ(channel.receive(packet), CanError::NothingReceived);
  EXPECT_EQ(packet, packetOf(0x7F, {9})) << "stays";
  for (uint32_t i = 0; i < 33; ++i) deliver(0x100 + i);
  for (uint32_t i = 1; i < 33; ++i) {
    ASSERT_EQ(channel.receive(packet), CanError::Ok);
    EXPECT_EQ(packet.id, 0x100 + i);
  }
  EXPECT_EQ(channel.receive(packet), CanError::NothingReceived);
}

TEST_F(Channel, AnOrderTakesThePacket) {
  const uint32_t handle = channel.order({.objectLow = 0x580, .objectHigh = 0x580, .nodeLow = 0x21, .nodeHigh = 0x21});
  EXPECT_EQ(handle, 1u);
  EXPECT_THAT(deliver(0x5A1).all(), ElementsAre(1));
  EXPECT_EQ(channel.receive(packet), CanError::NothingReceived);
  EXPECT_THAT(deliver(0x5A2).all(), ElementsAre());
  EXPECT_THAT(deliver(0x621).all(), ElementsAre());
  EXPECT_EQ(channel.receive(packet), CanError::Ok);
  EXPECT_EQ(packet.id, 0x5A2);
}

TEST_F(Channel, RangesIncludeBothEnds) {
  ASSERT_NE(channel.order({.objectLow = 0x180, .objectHigh = 0x280, .nodeLow = 0x20, .nodeHigh = 0x22}), 0u);
  for (const uint32_t id : {0x1A0, 0x1A2, 0x221, 0x2A0, 0x2A2}) EXPECT_EQ(deliver(id).count, 1u) << id;
  for (const uint32_t id : {0x19F, 0x1A3, 0x121, 0x321}) EXPECT_EQ(deliver(id).count, 0u) << id;
}

TEST_F(Channel, OrdersAreServedByHandle) {
  const CanOrder all{.objectHigh = 0x7FF, .nodeHigh = 0x7F};
  for (uint32_t i = 1; i <= 3; ++i) EXPECT_EQ(channel.order(all), i);
  EXPECT_TRUE(orders.remove(2));
  EXPECT_FALSE(orders.remove(2));
  EXPECT_FALSE(orders.remove(0));
  EXPECT_EQ(channel.order(all), 4u);
  EXPECT_THAT(deliver(0).all(), ElementsAre(1, 3, 4));
}

TEST_F(Channel, OrdersOfOtherChannelsDoNotMatch) {
  other.setState(BusState::Active);
  EXPECT_EQ(other.order({.objectHigh = 0x7FF, .nodeHigh = 0x7F}), 1u);
  EXPECT_EQ(deliver(0x10).count, 0u);
  EXPECT_EQ(other.deliver(packetOf(0x10, {})).count, 1u);
}

TEST_F(Channel, RefusesOrders) {
  EXPECT_EQ(other.order({}), 0u) << "the channel is not active";
  EXPECT_EQ(channel.order({.objectLow = 2, .objectHigh = 1}), 0u);
  EXPECT_EQ(channel.order({.nodeLow = 2, .nodeHigh = 1}), 0u);
  EXPECT_EQ(channel.order({.objectHigh = 0x800}), 0u);
  EXPECT_EQ(channel.order({.nodeHigh = 0x80}), 0u);
  for (uint32_t i = 1; i <= 32; ++i) EXPECT_EQ(channel.order({}), i);
  EXPECT_EQ(channel.order({}), 0u) << "32 are there";
  orders.clear(); // START PLC
  EXPECT_EQ(channel.order({}), 1u);
}

TEST_F(Channel, OffTheBusOrdersAreTakenAndPacketsComeNoMoreThanTheBusGives) {
  channel.setState(BusState::BusOff);
  EXPECT_EQ(channel.order({.objectHigh = 0x7FF, .nodeHigh = 0x7F}), 1u);
  channel.setState(BusState::Inactive);
  EXPECT_EQ(deliver(0x10).count, 0u);
  EXPECT_EQ(channel.receive(packet), CanError::NothingReceived);
}

TEST(CanController, PacketsWaitWhereThePortIsFull) {
  struct Narrow final : CanPort {
    BusState state() const override { return BusState::Active; }
    bool transmit(const CanPacket&) override {
      if (room == 0) return false;
      --room;
      return true;
    }
    bool receive(CanPacket&) override { return false; }
    int room = 2;
  } port;
  CanController control;
  control.connect(2, port);
  control.power();
  UnitStates units;
  DriveStates drives;
  for (uint32_t i = 0; i < 5; ++i) control.channel(2).send(packetOf(i, {}));
  control.transmit({}, units, {}, drives);
  CanPacket packet;
  ASSERT_TRUE(control.channel(2).peekToSend(packet));
  EXPECT_EQ(packet.id, 2) << "the refused one is the next one";
  ASSERT_TRUE(control.takeSent(2, packet));
  EXPECT_EQ(packet.id, 0);
  EXPECT_EQ(control.channel(1).send(packet), CanError::SendQueueFull) << "no port";
}

} // namespace

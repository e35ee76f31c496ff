// The real channel, at one end of a socket pair; the other end is the bus.
#include "machine/io/can/socket_can.h"

#include <gtest/gtest.h>
#include <linux/can.h>
#include <linux/can/error.h>
#include <sys/socket.h>
#include <unistd.h>

#include <optional>

#include "machine/io/can/controller.h"
#include "tests/support/patience.h"

namespace {

using namespace rung::io;
using rung::test::soon;

class SocketCanTest : public testing::Test {
protected:
  explicit SocketCanTest(int type = SOCK_SEQPACKET) {
    EXPECT_EQ(socketpair(AF_UNIX, type | SOCK_CLOEXEC, 0, ends_), 0);
  }
  ~SocketCanTest() override { closeBus(); }
  void adopt() { can_.adopt(ends_[0]); }
  void closeBus() {
    if (ends_[1] >= 0) ::close(ends_[1]);
    ends_[1] = -1;
  }
  void put(uint32_t id, std::initializer_list<uint8_t> data) const {
    can_frame frame{};
    frame.can_id = id;
    frame.can_dlc = static_cast<uint8_t>(data.size());
    std::copy(data.begin(), data.end(), frame.data);
    ASSERT_EQ(write(ends_[1], &frame, sizeof frame), ssize_t{sizeof frame});
  }
  std::optional<can_frame> get(int flags = 0) const {
    can_frame frame{};
    if (recv(ends_[1], &frame, sizeof frame, flags) != sizeof frame) return std::nullopt;
    return frame;
  }
  std::optional<CanPacket> received() {
    CanPacket packet;
    return soon([&] { return can_.receive(packet); }) ? std::optional(packet) : std::nullopt;
  }

  int ends_[2] = {-1, -1};
  SocketCan can_;
};

TEST_F(SocketCanTest, FramesGoOut) {
  adopt();
  EXPECT_EQ(can_.state(), BusState::Active);
  ASSERT_TRUE(can_.transmit(packetOf(0x610, {0x40, 8, 0x10})));
  ASSERT_TRUE(can_.transmit({.id = 0x7FF, .remote = 1, .length = 4}));
  const auto first = get();
  ASSERT_TRUE(first);
  EXPECT_EQ(first->can_id, 0x610u);
  EXPECT_EQ(first->can_dlc, 3);
  EXPECT_EQ(first->data[2], 0x10);
  const auto second = get();
  ASSERT_TRUE(second);
  EXPECT_EQ(second->can_id, 0x7FFu | CAN_RTR_FLAG);
  EXPECT_EQ(second->can_dlc, 4);
  EXPECT_TRUE(soon([&] { return can_.counts().sent == 2; }));
}

TEST_F(SocketCanTest, FramesComeInAndLongIdentifiersDoNot) {
  adopt();
  put(0x12345 | CAN_EFF_FLAG, {1});
  put(0x5A1, {0x4F, 1, 2});
  put(0x11 | CAN_RTR_FLAG, {});
  EXPECT_EQ(received(), packetOf(0x5A1, {0x4F, 1, 2}));
  EXPECT_EQ(received(), (CanPacket{.id = 0x11, .remote = 1}));
  EXPECT_EQ(can_.counts().received, 2u);
}

TEST_F(SocketCanTest, ErrorFramesAreNoPackets) {
  adopt();
  put(CAN_ERR_FLAG | CAN_ERR_TX_TIMEOUT, {0, 0, 0, 0, 0, 0, 0, 0});
  put(CAN_ERR_FLAG | CAN_ERR_ACK, {0, 0, 0, 0, 0, 0, 0, 0});
  put(CAN_ERR_FLAG | CAN_ERR_CRTL, {0, 1, 0, 0, 0, 0, 0, 0});
  EXPECT_TRUE(soon([&] { return can_.counts().errors == 3; }));
  EXPECT_EQ(can_.counts().timeouts, 2u);
  EXPECT_EQ(can_.state(), BusState::Active);
  CanPacket packet;
  EXPECT_FALSE(can_.receive(packet));
}

TEST_F(SocketCanTest, BusOffUntilTheControllerIsRestarted) {
  adopt();
  put(CAN_ERR_FLAG | CAN_ERR_BUSOFF, {});
  EXPECT_TRUE(soon([&] { return can_.state() == BusState::BusOff; }));
  EXPECT_FALSE(can_.transmit(packetOf(1, {})));
  put(CAN_ERR_FLAG | CAN_ERR_RESTARTED, {});
  EXPECT_TRUE(soon([&] { return can_.state() == BusState::Active; }));
  EXPECT_TRUE(can_.transmit(packetOf(2, {})));
  EXPECT_EQ(get()->can_id, 2u);
}

// The interface takes nothing: first its queue is full, then the ring, then the channel's queue; nothing is lost or
// turned round.
TEST_F(SocketCanTest, FullQueueIsTheErrorOfTheInstruction) {
  const int small = 1;
  setsockopt(ends_[0], SOL_SOCKET, SO_SNDBUF, &small, sizeof small);
  adopt();
  CanController control;
  control.connect(1, can_);
  control.power();
  UnitStates units;
  DriveStates drives;
  uint32_t taken = 0;
  const auto sendsAll = [&] {
    control.transmit({}, units, {}, drives);
    while (control.channel(1).send(packetOf(taken & 0x7FF, {})) == CanError::Ok) ++taken;
    return can_.counts().full > 5;
  };
  ASSERT_TRUE(soon(sendsAll));
  EXPECT_EQ(control.channel(1).send(packetOf(1, {})), CanError::SendQueueFull);
  for (uint32_t i = 0; i < taken; ++i) {
    std::optional<can_frame> frame;
    const auto comes = [&] {
      control.transmit({}, units, {}, drives);
      return (frame = get(MSG_DONTWAIT)).has_value();
    };
    ASSERT_TRUE(soon(comes));
    ASSERT_EQ(frame->can_id, i & 0x7FF);
  }
}

TEST_F(SocketCanTest, WhatTheProgramDoesNotTakeIsCounted) {
  adopt();
  for (uint32_t i = 0; i < SocketCan::kFromBus + 10; ++i) put(i, {});
  EXPECT_TRUE(soon([&] { return can_.counts().received == SocketCan::kFromBus + 10; }));
  EXPECT_EQ(can_.counts().lost, 10u);
  EXPECT_EQ(received()->id, 0);
}

TEST_F(SocketCanTest, OtherSideGone) {
  adopt();
  put(0x10, {1});
  ASSERT_TRUE(received());
  closeBus();
  EXPECT_TRUE(soon([&] { return can_.state() == BusState::Down; }));
  EXPECT_FALSE(can_.transmit(packetOf(1, {})));
  can_.close();
  EXPECT_EQ(can_.state(), BusState::Inactive);
}

struct SocketCanDatagrams : SocketCanTest {
  SocketCanDatagrams() : SocketCanTest(SOCK_DGRAM) {}
};

TEST_F(SocketCanDatagrams, OtherSideGone) {
  adopt();
  ASSERT_TRUE(can_.transmit(packetOf(1, {})));
  ASSERT_TRUE(get());
  closeBus();
  EXPECT_TRUE(soon([&] {
    can_.transmit(packetOf(1, {}));
    return can_.state() == BusState::Down;
  }));
}

// Where the system has CAN sockets, an interface that is not there yet is waited for.
TEST(SocketCanInterface, IsNotThere) {
  SocketCan can;
  EXPECT_NE(can.open(""), "");
  EXPECT_NE(can.open("a-name-that-is-too-long"), "");
  const int probe = socket(PF_CAN, SOCK_RAW | SOCK_CLOEXEC, 1);
  const std::string problem = can.open("rung-no-can");
  EXPECT_EQ(problem.empty(), probe >= 0) << problem;
  EXPECT_EQ(can.state(), probe >= 0 ? BusState::Down : BusState::Inactive);
  EXPECT_FALSE(can.transmit(packetOf(1, {})));
  if (probe >= 0) ::close(probe);
}

} // namespace

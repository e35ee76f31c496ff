// A program at one end of a socket pair; the other end is the bus. It is that of the scenarios of CAN.
#include <gmock/gmock.h>
#include <linux/can.h>
#include <linux/can/error.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <set>

#include "tests/unit/host_devices/bench.h"

namespace {

using rung::test::DeviceBench;
using testing::Contains;

class Bus : public DeviceBench, public testing::Test {
protected:
  Bus() : DeviceBench("can.plc") {
    EXPECT_EQ(socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC | SOCK_NONBLOCK, 0, ends_), 0);
  }
  ~Bus() override { unplug(); }
  void unplug() {
    if (ends_[1] >= 0) ::close(ends_[1]);
    ends_[1] = -1;
  }
  void beginWith(std::initializer_list<std::pair<const char*, const char*>> keys = {}) {
    for (const auto& [key, value] : keys) ASSERT_EQ(devices.configure(key, value), "");
    devices.adoptCan(2, ends_[0]);
    begin();
  }
  void put(uint32_t id, std::initializer_list<uint8_t> data) const {
    can_frame frame{};
    frame.can_id = id;
    frame.can_dlc = static_cast<uint8_t>(data.size());
    std::copy(data.begin(), data.end(), frame.data);
    ssize_t written = 0;
    do written = write(ends_[1], &frame, sizeof frame);
    while (written < 0 && errno == EAGAIN);
    ASSERT_EQ(written, ssize_t{sizeof frame});
  }
  std::optional<can_frame> get() const {
    can_frame frame{};
    if (recv(ends_[1], &frame, sizeof frame, 0) != sizeof frame) return std::nullopt;
    return frame;
  }
  // Steps until a frame with this identifier leaves.
  std::optional<can_frame> sent(uint32_t id) {
    std::optional<can_frame> found;
    soon([&] {
      while (const auto frame = get())
        if (frame->can_id == id) found = frame;
      return found.has_value();
    });
    return found;
  }

  int ends_[2] = {-1, -1};
};

TEST_F(Bus, PacketsOfTheProgram) {
  beginWith();
  set("DO1", 1);
  const auto frame = sent(0x7FA | CAN_RTR_FLAG);
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->can_dlc, 2);
  EXPECT_EQ((*this)["CODE"], 0);
  set("DO2", 1);
  EXPECT_TRUE(soonIs("CODE", 2)) << "nothing has come";
  put(0x123, {9, 8});
  ASSERT_TRUE(soon([&] {
    set("DO2", 1);
    return (*this)["CODE"] == 0;
  }));
  EXPECT_EQ((*this)["WORD.INBUF"], 0x123);
}

TEST_F(Bus, AnOrderRunsItsProcedure) {
  beginWith();
  set("DO3", 1);
  ASSERT_TRUE(soonIs("GIVEN", 1));
  put(0x5A1, {0x40, 8});
  put(0x5A5, {1}); // not of the order
  EXPECT_TRUE(soonIs("CALLS", 1));
  EXPECT_EQ((*this)["CHANNEL"], 2);
  EXPECT_EQ((*this)["WORD.ORDER"], 0x5A1);
  put(0x5A4, {1});
  EXPECT_TRUE(soonIs("CALLS", 2));
}

TEST_F(Bus, ErrorFramesAndBusOff) {
  beginWith();
  put(CAN_ERR_FLAG | CAN_ERR_BUSOFF, {});
  EXPECT_TRUE(soonReports("CAN channel 2 is off the bus"));
  set("DO1", 1);
  EXPECT_TRUE(soonIs("CODE", 1));
  put(CAN_ERR_FLAG | CAN_ERR_RESTARTED, {});
  EXPECT_TRUE(soonReports("CAN channel 2 works again"));
  set("DO1", 1);
  EXPECT_TRUE(soonIs("CODE", 0));
}

// The control is the master of its units: it starts them, sends outputs and SYNC, takes their inputs; a silent one is
// reported to the program.
TEST_F(Bus, Units) {
  beginWith({{"CAN[1].InOut08Cnt", "1"}});
  std::set<uint32_t> ids;
  const auto seen = [&] {
    while (const auto frame = get()) ids.insert(frame->can_id);
    return ids.contains(0) && ids.contains(0x80) && ids.contains(0x221) && ids.contains(0x621);
  };
  EXPECT_TRUE(soon(seen)) << "network management, SYNC, outputs, a question by SDO";
  put(0x1A1, {0x5A, 0, 0, 0});
  EXPECT_TRUE(soonIs("P1IN", 0x5A));
  EXPECT_TRUE(soonIs("CAN_IO_TIMEOUT_CODE", 1));
  EXPECT_EQ((*this)["CAN_IO_TIMEOUT_NUM"], 1);
}

TEST_F(Bus, AtTheEndOutputsAreZero) {
  beginWith({{"CAN[1].InOut08Cnt", "1"}});
  put(0x1A1, {0, 0, 0, 0});
  set("P0OUT", 0xFF);
  ASSERT_TRUE(soon([&] {
    put(0x1A1, {0, 0, 0, 0}); // it lives
    set("P0OUT", 0xFF);
    const auto frame = get();
    return frame && frame->can_id == 0x221 && frame->data[0] == 0xFF;
  }));
  end();
  uint8_t last = 0xFF;
  while (const auto frame = get())
    if (frame->can_id == 0x221) last = frame->data[0];
  EXPECT_EQ(last, 0);
}

TEST_F(Bus, WhoIsUnpluggedIsReported) {
  beginWith();
  unplug();
  EXPECT_TRUE(soonReports("CAN channel 2: its interface is not there"));
  set("DO1", 1);
  EXPECT_TRUE(soonIs("CODE", 1)) << "and the program runs on";
}

TEST_F(Bus, WhatComesTooFastIsReported) {
  beginWith();
  for (uint32_t i = 0; i < 300; ++i) put(0x100, {1});
  std::this_thread::sleep_for(std::chrono::milliseconds(300)); // a scan that is late
  EXPECT_TRUE(soonReports("packets were lost"));
}

} // namespace

// A program at one end of a socket pair; the other end is the bus. It is that of the scenarios of CAN.
#include <gmock/gmock.h>
#include <linux/can.h>
#include <linux/can/error.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <set>

#include "tests/unit/io/host_devices_bench.h"

namespace {

using rung::test::DeviceBench;

class Bus : public DeviceBench, public testing::Test {
protected:
  explicit Bus(const char* program = "can.plc") : DeviceBench(program) {
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

struct OrdersAtTheBus : Bus {
  OrdersAtTheBus() : Bus("can-orders-1.plc") {}
};

// Its procedure and its buffer are found by their names; what the new program orders in MODULE_INIT it has not ordered.
TEST_F(OrdersAtTheBus, ContinueInAnotherProgram) {
  beginWith();
  put(0x5A1, {1, 2});
  ASSERT_TRUE(soonIs("CALLS", 1));
  replaceBy("can-orders-2.plc");
  put(0x5A1, {3, 4});
  EXPECT_TRUE(soonIs("CALLS", 2));
  EXPECT_EQ((*this)["WORD.ORDER+4"], 0x0403);
  EXPECT_EQ((*this)["OTHERS"], 0);
  EXPECT_EQ((*this)["DWRD.MORE+4"], 0);
  EXPECT_EQ((*this)["DWRD.SECOND"], 0);
  replaceBy("can-orders-1.plc");
  put(0x5A1, {5, 6});
  EXPECT_TRUE(soonIs("CALLS", 3));
  EXPECT_EQ((*this)["WORD.ORDER+4"], 0x0605);
  EXPECT_THAT(devices.report(), testing::IsEmpty());
}

TEST_F(OrdersAtTheBus, EndWithoutTheirBuffer) {
  beginWith();
  put(0x5A1, {1, 2});
  ASSERT_TRUE(soonIs("CALLS", 1));
  replaceBy("can-orders-3.plc");
  EXPECT_TRUE(soonReports("CAN_RECV_REQ: the order with the handle 1 has ended, as the new program does not have its "
                          "buffer"));
  put(0x5A1, {3, 4});
  const auto taken = [&] {
    set("DORECV", 1);
    return (*this)["WORD.INBUF"] == 0x5A1;
  };
  EXPECT_TRUE(soon(taken)) << "the packet waits for CAN_RECV";
  EXPECT_EQ((*this)["CALLS"], 1);
  EXPECT_EQ((*this)["DWRD.AGAIN"], 0);
  EXPECT_EQ((*this)["GUARD"], 0);
}

// can-units.plc has neither.
TEST_F(OrdersAtTheBus, EndWithoutTheirBufferAndProcedure) {
  beginWith();
  put(0x5A1, {1, 2});
  ASSERT_TRUE(soonIs("CALLS", 1));
  replaceBy("can-units.plc");
  EXPECT_TRUE(soonReports("does not have its buffer and its procedure"));
}

struct HostDrives : Bus {
  void beginDrives() {
    ASSERT_EQ(devices.configure("CAN[0].Drives", "2"), "");
    devices.adoptCan(1, ends_[0]);
    begin();
  }
};

// Messages of the control (man. l.9649-9653), each as it comes, and one that is repeated not again within a second.
TEST_F(HostDrives, EmergenciesAndTimeOutsAreReported) {
  beginDrives();
  for (int i = 0; i < 3; ++i) put(0x82, {0x11, 0x86, 1, 0, 0, 0, 0, 0});
  put(0x81, {0x34, 0x12, 1, 0, 0, 0, 0, 0});
  std::vector<std::string> lines;
  EXPECT_TRUE(soon([&] {
    for (std::string& line : devices.report()) lines.push_back(std::move(line));
    return lines.size() >= 4;
  }));
  EXPECT_THAT(lines, testing::UnorderedElementsAre("4217: emergency of drive 2, fault 39, emergency 8611",
                                                   "4217: emergency of drive 1, fault 0, emergency 1234",
                                                   "4219: time-out of drive 1", "4219: time-out of drive 2"));
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
    return ids.contains(0) && ids.contains(0x80) && ids.contains(0x621);
  };
  EXPECT_TRUE(soon(seen)) << "network management, SYNC, a question by SDO";
  EXPECT_FALSE(ids.contains(0x221)) << "outputs to whom nobody has seen";
  put(0x1A1, {0x5A, 0, 0, 0, 0, 0, 0, 0});
  EXPECT_TRUE(soonIs("P1IN", 0x5A));
  EXPECT_TRUE(sent(0x221)) << "also to one that does not answer by SDO";
  EXPECT_TRUE(soonIs("CAN_IO_TIMEOUT_CODE", 1));
  EXPECT_EQ((*this)["CAN_IO_TIMEOUT_NUM"], 1);
}

// A unit gets the mapping of its process data, is started, and is said to be silent when it is.
TEST_F(Bus, UnitsAreMapped) {
  beginWith({{"CAN[1].InOut08Cnt", "1"}});
  std::vector<uint32_t> mapped;
  bool isStarted = false;
  const auto answerAll = [&] {
    while (const auto frame = get()) {
      const uint8_t* data = frame->data;
      const uint16_t index = static_cast<uint16_t>(data[1] | data[2] << 8);
      if (frame->can_id == 0 && data[0] == 1 && data[1] == 0x21) isStarted = true;
      if (frame->can_id != 0x621) continue;
      put(0x5A1, {uint8_t(data[0] == 0x40 ? 0x4F : 0x60), data[1], data[2], data[3], 0, 0, 0, 0});
      if (index == 0x1600 || index == 0x1A00)
        mapped.push_back(uint32_t{data[7]} << 24 | data[6] << 16 | data[5] << 8 | data[4]);
      EXPECT_FALSE(isStarted && mapped.size() != 16) << "its mapping comes first";
    }
    return isStarted;
  };
  ASSERT_TRUE(soon(answerAll));
  EXPECT_THAT(mapped, testing::ElementsAre(0x62000108, 0x62000208, 0x62000308, 0x00050008, 0x00050008, 0x00050008,
                                           0x00050008, 0x00050008, 0x60000108, 0x60000208, 0x60000308, 0x60000408,
                                           0x21080108, 0x21080208, 0x21080308, 0x21080408));
  EXPECT_TRUE(sent(0x221));
  EXPECT_TRUE(soonReports("CAN unit INOUT08 1 (node 21h) does not answer"));
}

// What is no frame, or one of a length that there is not, harms nobody.
TEST_F(Bus, Nonsense) {
  beginWith({{"CAN[1].InOut08Cnt", "1"}});
  can_frame frame{};
  frame.can_id = 0x1A1;
  frame.can_dlc = 200;
  std::fill(std::begin(frame.data), std::end(frame.data), uint8_t{0x11});
  for (const size_t bytes : {size_t{1}, sizeof frame - 1, sizeof frame})
    ASSERT_EQ(write(ends_[1], &frame, bytes), static_cast<ssize_t>(bytes));
  EXPECT_TRUE(soonIs("P1IN", 0x11)) << "eight bytes at most";
  put(CAN_ERR_FLAG | CAN_ERR_PROT | CAN_ERR_BUSERROR, {1, 2, 3, 4, 5, 6, 7, 8});
  put(0x1FFFFFFF | CAN_EFF_FLAG, {0});
  put(0x1A1, {0x22, 0x22, 0x22, 0x22, 0, 0, 0, 0});
  EXPECT_TRUE(soonIs("P1IN", 0x22));
}

TEST_F(Bus, NobodyAcknowledges) {
  beginWith();
  put(CAN_ERR_FLAG | CAN_ERR_ACK, {0, 0, 0, 0, 0, 0, 0, 0});
  EXPECT_TRUE(soonReports("CAN channel 2: no device acknowledges packets"));
}

// Those of the control's own file of the channel.
TEST_F(Bus, UnitsOfTheChannelsFile) {
  beginWith({{"PlcConfig", "tests/scenarios/technol/devices.ChannelConfig"}});
  put(0x1A1, {0x5A, 0, 0, 0, 0, 0, 0, 0});
  EXPECT_TRUE(soonIs("P1IN", 0x5A));
  EXPECT_TRUE(sent(0x221));
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
  int waiting = 1; // for the thread, which takes them all before the next scan, a late one
  ASSERT_TRUE(rung::test::soon([&] { return ioctl(ends_[0], FIONREAD, &waiting) == 0 && waiting == 0; }));
  EXPECT_TRUE(soonReports("packets were lost"));
}

} // namespace

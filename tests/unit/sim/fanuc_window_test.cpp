// Window requests of FANUC programs against the simulated CNC: completion codes, lengths, when the answer comes.
#include "rtlib/nc/fanuc/services.h"
#include "tests/unit/sim/pmc_machine.h"

namespace rung::sim::test {
namespace {

using nc::fanuc::kReadDataAt;

struct Answer {
  int64_t end = -1, length = 0;
  std::vector<int64_t> data;
  bool operator==(const Answer&) const = default;
};
void PrintTo(const Answer& answer, std::ostream* out) {
  *out << answer.end << ", " << answer.length << ':';
  for (const int64_t word : answer.data) *out << ' ' << word;
}

constexpr int64_t kAll = 0xFFFF; // -1

class FanucWindow : public testing::Test {
protected:
  core::ServiceQueue& queue() { return machine_.instance().services(); }
  uint32_t request(uint32_t service, std::vector<int64_t> args) {
    args.resize(service == 0 ? 4 : nc::fanuc::kWriteDataAt + nc::fanuc::kWindowWords);
    return queue().request(service, args.data(), static_cast<uint32_t>(args.size()));
  }
  bool isDone(uint32_t ticket) {
    queue().deliver();
    return queue().poll(ticket) == RUNG_SERVICE_DONE;
  }
  Answer answerOf(uint32_t ticket) {
    Answer answer{queue().result(ticket, 0), queue().result(ticket, 1), {}};
    for (int64_t at = 0; at < answer.length; at += 4)
      answer.data.push_back(queue().result(ticket, kReadDataAt + static_cast<uint32_t>(at / 4)));
    return answer;
  }
  // At high speed.
  Answer readNow(int64_t function, int64_t length, int64_t number, int64_t attribute) {
    const uint32_t ticket = request(0, {function, length, number, attribute});
    EXPECT_TRUE(isDone(ticket)) << function;
    return answerOf(ticket);
  }
  // At low speed.
  Answer read(int64_t function, int64_t length, int64_t number, int64_t attribute) {
    const uint32_t ticket = request(0, {function, length, number, attribute});
    EXPECT_FALSE(isDone(ticket)) << function;
    machine_.slot(4);
    EXPECT_TRUE(isDone(ticket)) << function;
    return answerOf(ticket);
  }
  int64_t write(std::vector<int64_t> args) {
    const uint32_t ticket = request(1, std::move(args));
    machine_.slot(3);
    EXPECT_FALSE(isDone(ticket));
    machine_.slot();
    EXPECT_TRUE(isDone(ticket));
    return queue().result(ticket, 0);
  }
  static Answer of(int64_t length, std::vector<int64_t> data) { return {0, length, std::move(data)}; }
  static Answer failed(int64_t end) { return {end, 0, {}}; }

  PmcMachine machine_{"fanuc", {{"nc", "simulated"}, {"axes", "XYZAC"}, {"param.1423", "1500"}}};
};

TEST_F(FanucWindow, OffsetsAreInMicrometres) {
  EXPECT_EQ(write({14, 4, 3, 3, 12345}), 0);
  EXPECT_EQ(write({14, 4, 3, 0, -7}), 0);
  EXPECT_EQ(read(13, 4, 3, 3), of(4, {12345}));
  EXPECT_EQ(read(13, 0, 3, 0), of(4, {-7}));
  EXPECT_EQ(machine_.nc().quantity("OFFSET.H.3"), 12.345);
  EXPECT_EQ(machine_.nc().quantity("OFFSET.DWEAR.3"), -0.007);
  EXPECT_EQ(read(13, 4, 0, 0), failed(3));
  EXPECT_EQ(read(13, 4, 1, 4), failed(3));
  EXPECT_EQ(read(13, 4, 401, 0), failed(3));
}

TEST_F(FanucWindow, OriginsOfOneAxisAndOfAll) {
  EXPECT_EQ(write({16, 20, 1, kAll, 1, -2, 3, 0, 5000}), 0);
  EXPECT_EQ(read(15, 4, 1, 2), of(4, {-2}));
  EXPECT_EQ(read(15, 20, 1, kAll), of(20, {1, -2, 3, 0, 5000}));
  EXPECT_EQ(read(15, 4, 1, 6), failed(3));
  EXPECT_EQ(read(15, 4, 1, 0), failed(3));
  EXPECT_EQ(read(15, 4, 55, 1), failed(3));
}

TEST_F(FanucWindow, ParametersHaveTheLengthThatIsAskedFor) {
  EXPECT_EQ(read(17, 2, 1423, 1), of(2, {1500}));
  EXPECT_EQ(read(17, 0, 1423, 0), of(4, {1500}));
  EXPECT_EQ(read(17, 1, 1423, 0), failed(5));
  EXPECT_EQ(readNow(154, 1, 1902, 0), of(1, {0}));
  EXPECT_EQ(write({18, 10, 4030, kAll, 300 | 301 << 16, 302 | 303 << 16, -1}), 0);
  EXPECT_EQ(readNow(154, 10, 4030, kAll), of(10, {300 | 301 << 16, 302 | 303 << 16, 0xFFFF}));
  EXPECT_EQ(machine_.nc().quantity("PARAM.4030.5"), -1);
  EXPECT_EQ(write({18, 1, 3401, 0, 0x81}), 0);
  EXPECT_EQ(readNow(154, 1, 3401, 0), of(1, {-127}));
  EXPECT_EQ(write({18, 4, 10000, 0, 1}), 3);
  EXPECT_EQ(readNow(154, 2, 1423, 6), failed(3));
}

TEST_F(FanucWindow, MacroVariablesHaveDecimalPlaces) {
  EXPECT_EQ(write({22, 6, 100, 0, 12345, 3}), 0); // 12.345
  EXPECT_EQ(machine_.nc().quantity("MACRO.100"), 12.345);
  EXPECT_EQ(read(21, 6, 100, 1), of(6, {123, 1}));
  EXPECT_EQ(read(21, 6, 100, 3), of(6, {12345, 3}));
  EXPECT_EQ(write({22, 4, 101, 2, -150}), 0); // places by the attribute
  EXPECT_EQ(machine_.nc().quantity("MACRO.101"), -1.5);
  EXPECT_EQ(read(21, 6, 100, 8), failed(2));
  EXPECT_EQ(read(21, 6, 99, 0), failed(3));
  EXPECT_EQ(write({22, 6, 1100, 0, 1, 0}), 3);
  machine_.set("G54.3", 1);
  EXPECT_EQ(read(21, 6, 1003, 0), of(6, {1, 0}));
  machine_.set("G280:4", 77);
  EXPECT_EQ(read(21, 6, 1033, 0), of(6, {77, 0}));
}

TEST_F(FanucWindow, PositionsOfOneAxisAndOfAll) {
  EXPECT_EQ(machine_.nc().setQuantity("MPOS.2", -1234), "");
  EXPECT_EQ(machine_.nc().setQuantity("WORK.1.2", 1), "");
  EXPECT_EQ(machine_.nc().setQuantity("RPOS.5", 2.5), "");
  EXPECT_EQ(readNow(28, 4, 0, 2), of(4, {-1234}));
  EXPECT_EQ(readNow(28, 20, 0, kAll), of(20, {0, -1234, 0, 0, 0}));
  EXPECT_EQ(readNow(27, 4, 0, 2), of(4, {-2234}));
  EXPECT_EQ(readNow(74, 4, 0, 5), of(4, {2500}));
  EXPECT_EQ(readNow(75, 4, 0, 1), of(4, {0}));
  EXPECT_EQ(readNow(28, 4, 0, 6), failed(3));
}

TEST_F(FanucWindow, State) {
  EXPECT_EQ(readNow(24, 4, 0, 0), of(4, {0}));
  EXPECT_EQ(readNow(25, 4, 0, 0), of(4, {0}));
  EXPECT_EQ(readNow(26, 2, 0, 0), of(2, {0}));
  EXPECT_EQ(readNow(50, 4, 0, 0), of(4, {0}));
  EXPECT_EQ(readNow(153, 2, 0, 0), of(2, {0}));
  EXPECT_EQ(readNow(23, 2, 0, 0), of(2, {0}));
  const Answer system = readNow(0, 14, 0, 0);
  EXPECT_EQ(system.end, 0);
  EXPECT_EQ(system.length, 14);
  EXPECT_EQ(system.data.back(), '0' | '5' << 8); // axes
}

TEST_F(FanucWindow, TheClockRunsWithTheSlots) {
  machine_.slot(4 * 125 * 61); // 244 s
  EXPECT_EQ(read(151, 6, 0, 1), of(6, {0 | 4 << 16, 4}));
  EXPECT_EQ(read(151, 6, 0, 0), of(6, {2000 | 1 << 16, 1}));
  EXPECT_EQ(read(151, 12, 0, kAll).length, 12);
  EXPECT_EQ(read(151, 6, 0, 2), failed(2));
}

TEST_F(FanucWindow, FunctionsThatAreNotThere) {
  EXPECT_EQ(read(999, 4, 0, 0), failed(1));
  EXPECT_EQ(readNow(1028, 4, 0, 1), failed(1)); // of path 2
  EXPECT_EQ(read(14, 4, 1, 0), failed(1));      // writes
  EXPECT_EQ(write({13, 4, 1, 0, 0}), 1);
  EXPECT_EQ(read(33, 0, 300, 6), failed(2)); // known, but not simulated
  EXPECT_EQ(readNow(207, 4, 11, 6), failed(2));
}

TEST(FanucScriptedWindow, HighSpeedEndsAtOnceLowSpeedWaits) {
  PmcMachine machine("fanuc", {});
  core::ServiceQueue& queue = machine.instance().services();
  const int64_t high[] = {28, 4, 0, 1}, low[] = {17, 2, 1423, 1};
  const uint32_t ticket = queue.request(0, high, 4);
  queue.deliver();
  EXPECT_EQ(queue.poll(ticket), RUNG_SERVICE_DONE);
  EXPECT_EQ(queue.result(ticket, 0), 1);
  queue.request(0, low, 4);
  machine.slot(5);
  EXPECT_EQ(queue.waiting(), 1u);
}

} // namespace
} // namespace rung::sim::test

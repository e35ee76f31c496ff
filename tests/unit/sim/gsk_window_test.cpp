// Window requests against the simulated CNC: end codes, scales, when the answer comes (man. l.8482-8945).
#include "tests/unit/sim/pmc_machine.h"

namespace rung::sim::test {
namespace {

using Config = std::vector<std::pair<std::string, std::string>>;

struct Answer {
  int64_t end = -1;
  int64_t data = 0;
  bool operator==(const Answer&) const = default;
};
void PrintTo(const Answer& answer, std::ostream* out) { *out << answer.end << ", " << answer.data; }

class Window : public testing::Test {
protected:
  // A low-speed request takes more than two slots (l.8512).
  Answer ask(uint32_t service, std::vector<int64_t> args) {
    core::ServiceQueue& queue = machine_.instance().services();
    const uint32_t ticket = queue.request(service, args.data(), static_cast<uint32_t>(args.size()));
    queue.deliver();
    if (queue.poll(ticket) != RUNG_SERVICE_DONE) {
      machine_.slot(3); // taken at the end of the first
      queue.deliver();
      EXPECT_NE(queue.poll(ticket), RUNG_SERVICE_DONE);
      machine_.slot();
      queue.deliver();
    }
    EXPECT_EQ(queue.poll(ticket), RUNG_SERVICE_DONE);
    return {queue.result(ticket, 0), service == 0 ? queue.result(ticket, 1) : 0};
  }
  Answer read(int64_t function, int64_t length, int64_t number, int64_t attribute) {
    return ask(0, {function, length, number, attribute});
  }
  Answer write(int64_t function, int64_t length, int64_t number, int64_t attribute, int64_t data) {
    return ask(1, {function, length, number, attribute, data});
  }

  GskMachine machine_{Config{{"nc", "simulated"}, {"param.1235", "8.5"}}};
};

TEST_F(Window, WritesAreReadBack) {
  const struct {
    int64_t write, read, number, attribute, data;
  } kCases[] = {{2, 1, 0, 0, 123456},  {2, 1, 2, 3, -1},          {4, 3, 0, 0, 100},   {4, 3, 54, 2, -70000},
                {6, 5, 1260, 0, 500},  {6, 5, 1225, 1, 90000000}, {10, 9, 100, 0, 35}, {10, 9, 999, 0, -10000},
                {12, 11, 7, 0, 10000}, {12, 11, 7, 1, -50000}};
  for (const auto& c : kCases) EXPECT_EQ(write(c.write, 4, c.number, c.attribute, c.data), (Answer{0, 0})) << c.write;
  for (const auto& c : kCases) EXPECT_EQ(read(c.read, 4, c.number, c.attribute), (Answer{0, c.data})) << c.read;
  EXPECT_EQ(machine_.nc().quantity("OFFSET.H.1"), 12.3456);
  EXPECT_EQ(machine_.nc().quantity("OFFSET.DWEAR.3"), -0.0001);
  EXPECT_EQ(machine_.nc().quantity("WORK.54.3"), -7);
}

TEST_F(Window, ReadsParametersOfTheConfiguration) {
  EXPECT_EQ(read(5, 4, 1235, 0), (Answer{0, 85000}));
  EXPECT_EQ(read(5, 4, 1235, 2), (Answer{0, 85000})); // every axis, until it has a value of its own
}

TEST_F(Window, ToolNumbersAreWhole) {
  EXPECT_EQ(write(31, 4, 1, 0, 50000), (Answer{0, 0}));
  EXPECT_EQ(machine_.nc().quantity("NEXTTOOL"), 5);
  EXPECT_EQ(write(31, 4, 0, 0, 70000), (Answer{0, 0}));
  EXPECT_EQ(machine_.nc().quantity("TOOL"), 7);
  EXPECT_EQ(write(31, 4, 0, 0, 70001), (Answer{5, 0}));
  EXPECT_EQ(write(12, 4, 0, 0, 15000), (Answer{5, 0}));
  EXPECT_EQ(machine_.nc().quantity("TOOL"), 7);
}

TEST_F(Window, EndCodes) {
  EXPECT_EQ(read(27, 4, 0, 0).end, 1);
  EXPECT_EQ(read(2, 4, 0, 0).end, 1);     // a write function
  EXPECT_EQ(write(1, 4, 0, 0, 0).end, 1); // a read function
  EXPECT_EQ(read(1, 3, 0, 0).end, 2);
  EXPECT_EQ(read(3, 4, 55, 0).end, 3);
  EXPECT_EQ(write(10, 4, 99, 0, 0).end, 3); // only 100-999 (l.8800)
  EXPECT_EQ(write(10, 4, 1000, 0, 0).end, 3);
  EXPECT_EQ(write(31, 4, 2, 0, 0).end, 3);
  EXPECT_EQ(read(1, 4, 0, 4).end, 4);
  EXPECT_EQ(read(3, 4, 1, 3).end, 4); // three axes
  EXPECT_EQ(read(11, 4, 1, 2).end, 4);
  EXPECT_EQ(read(17, 4, 0, 0).end, 4);      // counts from 1 (l.8888)
  EXPECT_EQ(write(2, 1, 0, 0, 128).end, 5); // does not fit a byte
  EXPECT_EQ(read(13, 4, 0, 0).end, 6);      // "not open yet"
  EXPECT_EQ(write(20, 4, 0, 0, 0).end, 6);
}

TEST_F(Window, ALengthThatDoesNotHoldTheValueIsRefused) {
  write(2, 4, 0, 0, 40000);
  EXPECT_EQ(read(1, 2, 0, 0).end, 2);
  EXPECT_EQ(read(1, 4, 0, 0), (Answer{0, 40000}));
}

TEST_F(Window, MachineCoordinatesAreInMicrometres) {
  EXPECT_EQ(machine_.nc().setQuantity("MPOS.2", -1234), "");
  EXPECT_EQ(read(17, 4, 0, 2), (Answer{0, -1234}));
  machine_.slot();
  EXPECT_EQ(static_cast<int32_t>(machine_.instance().memory().read(3, 4, 4)), -1234);
}

TEST_F(Window, SequenceNumber) {
  machine_.set("G8", 0x31);
  machine_.set("G43", 1);
  machine_.slot(26);
  NcArgument blocks;
  blocks.key = "blocks";
  blocks.isText = true;
  blocks.text = "N35 G4 P500; M30";
  EXPECT_EQ(machine_.nc().event(machine_.instance(), "program", {blocks}), "");
  machine_.set("G7.2", 1);
  machine_.slot();
  machine_.set("G7.2", 0);
  machine_.slot();
  EXPECT_EQ(read(14, 4, 0, 0), (Answer{0, 350000}));
}

TEST_F(Window, InterfaceVariablesAreSignals) {
  machine_.set("G54", 2);
  machine_.set("G230:4", 6);
  EXPECT_EQ(read(9, 4, 1001, 0), (Answer{0, 10000}));
  EXPECT_EQ(read(9, 4, 1000, 0), (Answer{0, 0}));
  EXPECT_EQ(read(9, 4, 1034, 0), (Answer{0, 60000}));
}

TEST(ProtectedWindow, WritesEndWithSeven) {
  GskMachine machine(Config{{"nc", "simulated"}, {"protect", "on"}});
  const int64_t args[] = {2, 4, 0, 0, 10000};
  core::ServiceQueue& queue = machine.instance().services();
  const uint32_t ticket = queue.request(1, args, 5);
  machine.slot(4);
  queue.deliver();
  EXPECT_EQ(queue.poll(ticket), RUNG_SERVICE_DONE);
  EXPECT_EQ(queue.result(ticket, 0), 7);
  EXPECT_EQ(machine.nc().quantity("OFFSET.H.1"), 0);
}

TEST(ScriptedWindow, HighSpeedIsNotProvidedLowSpeedWaits) {
  GskMachine machine(Config{});
  core::ServiceQueue& queue = machine.instance().services();
  const int64_t high[] = {17, 4, 0, 1};
  const uint32_t ticket = queue.request(0, high, 4);
  EXPECT_EQ(queue.waiting(), 0u);
  queue.deliver();
  EXPECT_EQ(queue.poll(ticket), RUNG_SERVICE_DONE);
  EXPECT_EQ(queue.result(ticket, 0), 6);
  const int64_t low[] = {1, 4, 0, 0};
  queue.request(0, low, 4);
  machine.slot(5);
  EXPECT_EQ(queue.waiting(), 1u);
  machine.set("F10", 3);
  EXPECT_EQ(machine.nc().setQuantity("MPOS.8", -5), "");
  machine.slot();
  EXPECT_EQ(machine.get("F10"), 3u); // F is the scenario's
  EXPECT_EQ(static_cast<int32_t>(machine.instance().memory().read(3, 28, 4)), -5);
}

} // namespace
} // namespace rung::sim::test

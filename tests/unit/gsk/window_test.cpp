// Window functions and PLC axis control: the tables, and what scenarios cannot reach.
#include <gtest/gtest.h>

#include "rtlib/nc/gsk/axis_commands.h"
#include "rtlib/nc/gsk/signals.h"
#include "rtlib/nc/gsk/window_functions.h"
#include "tests/unit/gsk/machine.h"

namespace rung::frontend::gsk::test {
namespace {

using namespace nc::gsk;
using namespace nc::pmc;

size_t countOf(WindowStatus status) {
  size_t count = 0;
  for (const WindowFunction& function : windowFunctions()) count += function.status == status ? 1 : 0;
  return count;
}

// Inventory §19.
TEST(GskWindow, TheListHas32Functions) {
  EXPECT_EQ(windowFunctions().size(), 32u);
  EXPECT_EQ(countOf(WindowStatus::Open), 13u);
  EXPECT_EQ(countOf(WindowStatus::ClosedInSection), 5u);
  EXPECT_EQ(countOf(WindowStatus::ClosedInList), 14u);
  for (uint64_t code = 0; code < 40; ++code) {
    const WindowFunction* found = findWindowFunction(windowFunctions(), code);
    EXPECT_EQ(found != nullptr, code <= 32 && code != 27) << code;
    if (found != nullptr) {
      EXPECT_EQ(found->code, code);
    }
  }
  EXPECT_EQ(findWindowFunction(windowFunctions(), 65536), nullptr);
  EXPECT_EQ(findWindowFunction(windowFunctions(), 65537), nullptr);
}

TEST(GskWindow, WritingIsAlwaysLowSpeed) { // man. l.3152
  for (const WindowFunction& function : windowFunctions())
    EXPECT_TRUE(function.access == WindowAccess::Read || function.speed == WindowSpeed::Low) << function.code;
}

TEST(GskAxis, TheTableHas16Commands) {
  EXPECT_EQ(axisCommands().size(), 16u);
  for (const AxisCommand& command : axisCommands()) EXPECT_EQ(findAxisCommand(axisCommands(), command.code), &command);
  for (uint64_t code : {11, 15, 17, 19, 22, 31, 33, 256})
    EXPECT_EQ(findAxisCommand(axisCommands(), code), nullptr) << code;
}

// The bytes of the groups are those of the signals.
TEST(GskAxis, GroupsAgreeWithTheSignals) {
  const auto expectAt = [](const std::string& symbol, std::string_view area, uint32_t byte, uint32_t bit) {
    const nc::Signal* signal = nc::findSignal(nc::gskSignals(), symbol);
    ASSERT_NE(signal, nullptr) << symbol;
    EXPECT_EQ(signal->area, area) << symbol;
    EXPECT_EQ(signal->byteOffset, byte) << symbol;
    EXPECT_EQ(signal->bit, bit) << symbol;
  };
  ASSERT_EQ(axisGroups().size(), kMostAxisGroups);
  for (const AxisGroup& group : axisGroups()) {
    const std::string g(1, group.letter);
    expectAt("EBUF" + g, "G", group.control, kEbufBit);
    expectAt("ECLR" + g, "G", group.control, kEclrBit);
    expectAt("EMSBK" + g, "G", group.command, 7);
    expectAt("EC0" + g, "G", group.command, 0);
    expectAt("EIF0" + g, "G", group.data1(), 0);
    expectAt("EID0" + g, "G", group.data2(), 0);
    expectAt("EID31" + g, "G", group.data2() + 3u, 7);
    expectAt("EBSY" + g, "F", group.status, kEbsyBit);
    expectAt("EABUF" + g, "F", group.strobes, kEabufBit);
    expectAt("EM11" + g, "F", group.code, 0);
  }
}

Machine windowMachine(const char* instruction) {
  return Machine(
      compileList(std::string("FUNC 0\nLD R0.0\nFUNC ") + instruction + "\nPRM D100\nPRM R10\nOUT R0.1\nFUNC 1\n"));
}

core::ServiceRequest taken(Machine& m) {
  core::ServiceRequest request;
  EXPECT_TRUE(m.instance().services().take(request));
  return request;
}

// A host that does not answer at once does not provide high-speed functions; the program goes on.
TEST(GskWindow, HighSpeedWithoutAnAnswerEndsWithCode6) {
  Machine m = windowMachine("WINDR");
  m.set("D100", 17);
  m.set("D104", 4);
  m.set("R0.0", 1);
  for (int scan = 0; scan < 100; ++scan) { // also when the queue is full
    m.set("D102", 0);
    m.scan();
    ASSERT_EQ(m.get("R0.1"), 1u) << scan;
    ASSERT_EQ(m.get("D102"), 6u) << scan;
    ASSERT_EQ(m.get("R10"), 1u) << scan;
  }
}

// A low-speed request that finds the queue full ends in the same way, in its third scan.
TEST(GskWindow, LowSpeedInAFullQueueEndsWithCode6) {
  Machine m = windowMachine("WINDW");
  while (m.instance().services().request(0, nullptr, 0) != 0) {
  }
  m.set("D100", 2);
  m.set("D104", 1);
  m.set("R0.0", 1);
  m.scan(2);
  EXPECT_EQ(m.get("R0.1"), 0u);
  m.scan();
  EXPECT_EQ(m.get("R0.1"), 1u);
  EXPECT_EQ(m.get("D102"), 6u);
}

// The answer to a request from before power-on is nobody's answer.
TEST(GskWindow, LateAnswerAfterARestartIsThrownAway) {
  Machine m = windowMachine("WINDR");
  const auto ask = [&] {
    m.set("D100", 1);
    m.set("D104", 1);
    m.set("R0.0", 1);
    m.scan();
    return taken(m);
  };
  const core::ServiceRequest old = ask();
  m.instance().warmStart();
  const core::ServiceRequest young = ask();
  m.instance().services().complete({.ticket = old.ticket, .resultCount = 2, .results = {0, 99}});
  m.scan(3);
  EXPECT_EQ(m.get("R0.1"), 0u);
  m.instance().services().complete({.ticket = young.ticket, .resultCount = 2, .results = {0, 7}});
  m.scan();
  EXPECT_EQ(m.get("R0.1"), 1u);
  EXPECT_EQ(m.get("D110"), 7u);
  EXPECT_EQ(m.instance().services().stray(), 1u);
}

// End codes are words: nothing else of a strange answer reaches the block.
TEST(GskWindow, EndCodesAreWords) {
  Machine m = windowMachine("WINDR");
  m.set("D100", 1);
  m.set("D104", 1);
  m.set("R0.0", 1);
  m.scan();
  m.instance().services().complete({.ticket = taken(m).ticket, .resultCount = 2, .results = {0x10000, 3}});
  m.scan(2);
  EXPECT_EQ(m.get("D102"), 0u);
  EXPECT_EQ(m.get("R10"), 0u);
  EXPECT_EQ(m.get("D110"), 3u);
}

// Services and the space of positions stand in a program only where something uses them.
TEST(GskWindow, DeclaredWhereUsed) {
  const auto spaces = [](const Machine& m) {
    return std::count_if(m.module().spaces.begin(), m.module().spaces.end(),
                         [](const ir::Space& space) { return space.name == "@MPOS"; });
  };
  const Machine windows = windowMachine("WINDR");
  EXPECT_EQ(windows.module().services, std::vector<std::string>{"windr function length number attribute -> end data"});
  EXPECT_EQ(spaces(windows), 0);
  const Machine positions = windowMachine("PSGN2");
  EXPECT_TRUE(positions.module().services.empty());
  EXPECT_EQ(spaces(positions), 1);
  const Machine writes = windowMachine("WINDW");
  EXPECT_EQ(writes.module().services, std::vector<std::string>{"windw function length number attribute data -> end"});
}

} // namespace
} // namespace rung::frontend::gsk::test

// Slots beside the simulated CNC of GSK allocate nothing: axes that a part program moves, functions that wait for the
// PLC, window requests, positions for PSGNL. A cell of a table that is written for the first time is made then.
#include <gtest/gtest.h>

#include "tests/support/count_allocations.h"
#include "tests/unit/sim/pmc_machine.h"

namespace {

using namespace rung::sim;
using rung::test::allocationsOf;
using test::GskMachine;
constexpr uint32_t kF = 1, kG = 2, kPositions = 3; // spaces of the program

using Config = std::vector<std::pair<std::string, std::string>>;

TEST(GskNoAllocation, CounterCounts) {
  EXPECT_GT(allocationsOf([] { GskMachine machine(Config{}); }), 0);
}

TEST(GskNoAllocation, ScriptedSlots) {
  GskMachine machine(Config{});
  ASSERT_EQ(machine.nc().setQuantity("MPOS.2", 70'000), "");
  EXPECT_EQ(allocationsOf([&] { machine.slot(3); }), 0);
  EXPECT_EQ(machine.instance().memory().read(kPositions, 4, 4), 70'000u);
}

TEST(GskNoAllocation, SlotsOfAProgram) {
  GskMachine machine(Config{{"nc", "simulated"}});
  for (const char* tool : {"TOOL", "NEXTTOOL"}) ASSERT_EQ(machine.nc().setQuantity(tool, 1), "");
  const NcArgument blocks{.key = "blocks", .isText = true, .text = "G1 F6000 X1; G4 P40; M3 S100; G28 Z1; M6 T2; M30"};
  ASSERT_EQ(machine.nc().event(machine.instance(), "program", {blocks}), "");
  machine.set("G8", 0x31);
  machine.set("G12", 100);
  machine.set("G43", 1);
  machine.slot(26); // the reset of the power-on has ended
  machine.set("G7.2", 1);
  machine.slot();
  machine.set("G7.2", 0);
  const int64_t macro[] = {9, 4, 100, 0};
  const int64_t position[] = {27, 4, 0, 1};
  const rung::core::Memory memory = machine.instance().memory();
  EXPECT_EQ(allocationsOf([&] {
              for (int i = 0; i < 200; ++i) {
                machine.instance().services().request(0, macro, 4);
                machine.instance().services().request(0, position, 4);
                machine.slot();
                memory.writeBit(kG, 4, 3, memory.readByte(kF, 7) != 0); // FIN while there is a strobe
              }
            }),
            0);
  EXPECT_EQ(machine.nc().quantity("MPOS.1"), 1000);
  EXPECT_EQ(machine.nc().quantity("TOOL"), 2);
}

} // namespace

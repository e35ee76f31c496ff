// What the simulated CNC takes, and when it refuses it. What it says of wrong input is a golden (golden_test.cpp).
#include "tests/unit/sim/pmc_machine.h"

namespace rung::sim::test {
namespace {

using Config = std::vector<std::pair<std::string, std::string>>;

NcArgument text(const char* key, const char* value) {
  NcArgument argument;
  argument.key = key;
  argument.isText = true;
  argument.text = value;
  return argument;
}

class GskSimulated : public testing::Test {
protected:
  std::string load(const char* blocks) {
    return machine_.nc().event(machine_.instance(), "program", {text("blocks", blocks)});
  }
  GskMachine machine_{Config{{"nc", "simulated"}}};
};

TEST(GskConfig, ParametersWithAnExponent) {
  const GskMachine machine(Config{{"nc", "simulated"}, {"param.1225", "1.5e3"}});
  EXPECT_EQ(machine.nc().quantity("PARAM.1225"), 1500);
}

TEST_F(GskSimulated, Quantities) {
  SimulatedNc& nc = machine_.nc();
  EXPECT_FALSE(nc.quantity("MPOS.4")); // three axes
  EXPECT_FALSE(nc.quantity("OFFSET.H.0"));
  EXPECT_FALSE(nc.quantity("OFFSET.H.401"));
  EXPECT_FALSE(nc.quantity("MACRO.99"));
  EXPECT_FALSE(nc.quantity("PARAM.1225.9"));
  EXPECT_EQ(nc.setQuantity("MACRO.777", -2.5), "");
  EXPECT_EQ(nc.quantity("MACRO.777"), -2.5);
}

TEST_F(GskSimulated, PartProgramsInLines) { EXPECT_EQ(load("/ n7 g1 x-1.5 (to the stop) f100;;\nM30"), ""); }

TEST_F(GskSimulated, NoProgramWhileOneRuns) {
  machine_.set("G8", 0x31);
  machine_.set("G43", 1);
  machine_.slot(26);
  EXPECT_EQ(load("G4 P800"), "");
  machine_.set("G7.2", 1);
  machine_.slot();
  machine_.set("G7.2", 0);
  machine_.slot();
  EXPECT_EQ(load("M30"), "a program is running; reset the CNC first");
  machine_.slot(100);
  EXPECT_EQ(load("M30"), "");
}

// A cutting block needs a feed, an axis of the PLC is no axis of a program, G30 needs the reference point.
TEST_F(GskSimulated, Alarms) {
  const auto run = [&](const char* blocks) {
    machine_.nc().event(machine_.instance(), "reset", {});
    machine_.slot(27);
    EXPECT_EQ(load(blocks), "");
    machine_.set("G7.2", 1);
    machine_.slot();
    machine_.set("G7.2", 0);
    machine_.slot(2);
    return machine_.nc().quantity("ALARM");
  };
  machine_.set("G8", 0x31);
  machine_.set("G43", 1);
  machine_.set("G14", 3);
  EXPECT_EQ(run("G1 X1"), 901);
  EXPECT_EQ(machine_.get("F0"), 0x40u | 0x80u); // suspended until reset
  EXPECT_EQ(run("G0 X1"), 0);
  EXPECT_EQ(machine_.nc().setQuantity("PARAM.7010.2", 1), "");
  machine_.set("G136", 2);
  EXPECT_EQ(run("G0 Y1"), 311);
}

} // namespace
} // namespace rung::sim::test

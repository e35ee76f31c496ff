// What the simulated CNC refuses: configuration, events, quantities and part programs that it does not know.
#include "tests/unit/sim/gsk_machine.h"

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

TEST(GskConfig, WrongValues) {
  const auto nc = makeSimulatedGsk();
  EXPECT_EQ(nc->config("nc", "real"), "nc: expected scripted or simulated, found 'real'");
  EXPECT_EQ(nc->config("axes", "XX"), "axes: letters of XYZABCUVW, each once");
  EXPECT_EQ(nc->config("axes", "XYZABCUVW"), "axes: 1 to 8 letters");
  EXPECT_EQ(nc->config("overtravel", "1"), "overtravel: expected on or off, found '1'");
  EXPECT_EQ(nc->config("encoders", ""), "encoders: expected absolute or incremental, found ''");
  EXPECT_EQ(nc->config("protect", "yes"), "protect: expected on or off, found 'yes'");
  EXPECT_EQ(nc->config("param.7010", "x"), "param.7010: expected a number, found 'x'");
  EXPECT_EQ(nc->config("param.7010.9", "1"), "param.7010.9: there are axes 1 to 8");
  EXPECT_EQ(nc->config("param.7010.x", "1"), "param.7010.x: there are axes 1 to 8");
  EXPECT_EQ(nc->config("param.7010", "nan"), "param.7010: expected a number, found 'nan'");
  EXPECT_EQ(nc->config("param.7010", "inf"), "param.7010: expected a number, found 'inf'");
  EXPECT_EQ(nc->config("jog", "fast"), "jog: expected a number, found 'fast'");
  EXPECT_EQ(nc->config("param.", "1"), "unknown configuration key 'param.'");
  EXPECT_EQ(nc->config("speed", "1"), "unknown configuration key 'speed'");
}

TEST(GskEvents, NeedTheSimulatedCnc) {
  GskMachine machine(Config{});
  EXPECT_EQ(machine.nc().event(machine.instance(), "reset", {}), "event reset needs 'config nc simulated'");
  EXPECT_EQ(machine.nc().event(machine.instance(), "boom", {}), "unknown event 'boom'");
  EXPECT_EQ(machine.nc().setQuantity("TOOL", 1), "the scripted NC has no quantity 'NC.TOOL'");
  EXPECT_EQ(machine.nc().setQuantity("MPOS.9", 1), "the scripted NC has no quantity 'NC.MPOS.9'");
}

class GskSimulated : public testing::Test {
protected:
  std::string load(const char* blocks) {
    return machine_.nc().event(machine_.instance(), "program", {text("blocks", blocks)});
  }
  GskMachine machine_{Config{{"nc", "simulated"}}};
};

TEST_F(GskSimulated, EventsWithoutTheirKeys) {
  SimulatedNc& nc = machine_.nc();
  EXPECT_EQ(nc.event(machine_.instance(), "program", {}), "event program takes blocks=\"...\"");
  EXPECT_EQ(nc.event(machine_.instance(), "alarm", {}), "event alarm takes number=N");
  EXPECT_EQ(nc.event(machine_.instance(), "handwheel", {}), "event handwheel takes pulses=N and wheel=1 or wheel=2");
  EXPECT_EQ(nc.event(machine_.instance(), "program", {text("blocks", "M30"), text("loops", "2")}),
            "event program does not know 'loops'");
}

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
  EXPECT_EQ(nc.setQuantity("FEED", 1), "NC.FEED can only be read");
  EXPECT_EQ(nc.setQuantity("APOS.1", 1), "NC.APOS.1 can only be read");
  EXPECT_EQ(nc.setQuantity("LOAD", 1), "the simulated NC has no quantity 'NC.LOAD'");
  EXPECT_EQ(nc.setQuantity("MACRO.777", -2.5), "");
  EXPECT_EQ(nc.quantity("MACRO.777"), -2.5);
}

TEST_F(GskSimulated, PartPrograms) {
  EXPECT_EQ(load("G1 X1; G2 X3"), "block 2: G2 is not simulated");
  EXPECT_EQ(load("G54.1 P3 X0; G54.2"), "block 2: G54.2 is not simulated");
  EXPECT_EQ(load("M98 P1"), "block 1: M98 is not simulated");
  EXPECT_EQ(load("A5"), "block 1: unknown word A; the axes are XYZ");
  EXPECT_EQ(load("X"), "block 1: a number is missing after 'X'");
  EXPECT_EQ(load("X1 ?"), "block 1: unexpected character '?'");
  EXPECT_EQ(load("(no end"), "block 1: a comment without ')'");
  EXPECT_EQ(load("#5"), "block 1: expected #NUMBER=VALUE");
  EXPECT_EQ(load("M3 M8"), "block 1: more than one M code; parameter 1803.6 allows three");
  EXPECT_EQ(load("S-1"), "block 1: S takes no such number");
  EXPECT_EQ(load("N-1"), "block 1: N takes no such number");
  EXPECT_EQ(load("M3; O4294967296"), "block 2: O takes no such number");
  EXPECT_EQ(load("#4294967296=1"), "block 1: expected #NUMBER=VALUE");
  EXPECT_EQ(load("XINF"), "block 1: a number is missing after 'X'");
  EXPECT_EQ(load(" ; ;"), "the program has no blocks");
  EXPECT_EQ(load("/ n7 g1 x-1.5 (to the stop) f100;;\nM30"), "");
}

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

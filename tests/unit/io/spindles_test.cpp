// Analogue outputs and spindles (man. chapter 12, l.7690-8240).
#include <gtest/gtest.h>

#include "tests/unit/io/axes_machine.h"

namespace {

using namespace rung::sim::technol;
using rung::test::AxesMachine;

TEST(Spindles, ValueGoesToTheActivePort) {
  AxesMachine machine;
  EXPECT_EQ(machine.axes.analog(1000).port, 0u); // before the first ANALOG_PORT
  machine.axes.analogPort(6);
  const AnalogOutput half = machine.axes.analog(21159); // 630 of 800 r/min at 8.2 V (l.8226)
  EXPECT_EQ(half.port, 6u);
  EXPECT_DOUBLE_EQ(half.value, 21159. / 32767);
  EXPECT_DOUBLE_EQ(machine.axes.output(6), half.value);
  machine.axes.analogPort(16);
  EXPECT_EQ(machine.axes.analog(-40000).value, -1); // limited to ±7FFFh
  EXPECT_EQ(machine.axes.analog(40000).value, 1);
  EXPECT_DOUBLE_EQ(machine.axes.output(6), half.value);
}

TEST(Spindles, PortsAndAxesOutOfRangeAreLogged) {
  AxesMachine machine;
  machine.axes.analogPort(17);
  machine.axes.analogPort(0);
  EXPECT_EQ(machine.axes.analogOnSpindle(1, 17, 0).port, 0u);
  EXPECT_EQ(machine.axes.analogOnSpindle(1, 4, 3).port, 0u);
  machine.axes.axSpi(9, SpindleRole::Main);
  machine.axes.regul(1, 5);
  EXPECT_EQ(machine.log(), "ANALOG_PORT: port 17\nANALOG_PORT: port 0\nANALOG: axis 17\nANALOG: spi 3\n"
                           "AX_SPI: axis 9 does not exist\nREGUL_X: set 5\n");
  EXPECT_EQ(machine.axes.analog(5).port, 0u);
  EXPECT_EQ(machine.axes.regulator(1), 1u);
}

TEST(Spindles, LastSwitchedAxisGetsTheValue) {
  AxesMachine machine;
  EXPECT_EQ(machine.axes.analogOnSpindle(1, 2, 0).port, 2u); // before any AX_SPI
  machine.axes.axSpi(4, SpindleRole::Main);
  EXPECT_EQ(machine.axes.analogOnSpindle(1, 2, 0).port, 4u); // l.8048
  EXPECT_EQ(machine.axes.analogSpi(1, 2).port, 2u);
}

TEST(Spindles, MainAndAssistantAreThoseOfNow) { // l.8130-8160
  AxesMachine machine({{"axes", "XYZCB"}});
  EXPECT_EQ(machine.axes.analogOnSpindle(1, 4, 1).port, 0u); // nobody is main
  machine.axes.axSpi(4, SpindleRole::Main);
  machine.axes.axSpi(5, SpindleRole::Assistant);
  EXPECT_EQ(machine.axes.analogOnSpindle(1, 4, 1).port, 4u);
  EXPECT_EQ(machine.axes.analogOnSpindle(1, 4, 2).port, 5u);
  machine.axes.axSpi(5, SpindleRole::Main);
  EXPECT_EQ(machine.axes.analogOnSpindle(1, 4, 1).port, 5u);
  EXPECT_EQ(machine.axes.analogOnSpindle(1, 4, 2).port, 0u);
  EXPECT_EQ(machine.axes.spindleRole(4), 3u);
  machine.axes.axSpi(4, SpindleRole::Keep);
  EXPECT_EQ(machine.axes.mainSpindle(), 5u);
  machine.axes.spiMain(4);
  EXPECT_EQ(machine.axes.mainSpindle(), 4u);
  EXPECT_EQ(machine.axes.spindleRole(4), 1u);
}

TEST(Spindles, MainMakesASpindleOfAnAxis) {
  AxesMachine machine;
  machine.axes.spiMain(4);
  EXPECT_EQ(machine.axes.spindleRole(4), 1u);
  EXPECT_EQ(machine.axes.analogOnSpindle(1, 1, 0).port, 4u);
}

TEST(Spindles, TurnsByItsOutput) {
  AxesMachine machine({{"axis.4.SpeedAt10V", "600000"}, {"axis.4.Acceleration", "1000"}});
  machine.axes.analogSpi(kFullOutput, 4);
  machine.scan(2);
  EXPECT_EQ(machine.axes.speedPerMinute(4), 0); // an axis does not follow it
  machine.axes.axSpi(4, SpindleRole::Main);
  machine.ticks(1000);
  EXPECT_NEAR(machine.axes.speedPerMinute(4), 60000, 1e-6); // 1000 °/s², 1 s
  machine.ticks(9000);
  EXPECT_NEAR(machine.axes.speedPerMinute(4), 600000, 1e-6);
  EXPECT_NEAR(machine.axes.physical(4), 50000, 1e-6);
  EXPECT_TRUE(machine.out.inPosition);
  EXPECT_EQ(machine.out.motion, 0);
}

TEST(Spindles, IsSwitchedOff) {
  AxesMachine machine({{"axis.4.SpeedAt10V", "60000"}, {"axis.4.Acceleration", "1000"}});
  machine.axes.axSpi(4, SpindleRole::Main);
  machine.axes.analogSpi(-kFullOutput, 4);
  machine.ticks(2000);
  EXPECT_EQ(machine.axes.speedPerMinute(4), -60000);
  const AnalogOutput off = machine.axes.axSpi(4, SpindleRole::Off);
  EXPECT_EQ(off.port, 4u);
  EXPECT_EQ(off.value, 0);
  EXPECT_EQ(machine.axes.spindleRole(4), 0u);
  EXPECT_EQ(machine.axes.mainSpindle(), 0u);
  machine.ticks(1000);
  EXPECT_EQ(machine.axes.speedPerMinute(4), 0);
}

TEST(Spindles, FaultZeroesTheOutputs) {
  AxesMachine machine({{"axis.4.SpeedAt10V", "60000"}});
  machine.axes.axSpi(4, SpindleRole::Main);
  machine.axes.analogSpi(kFullOutput, 4);
  machine.ticks(5000);
  machine.axes.fault();
  EXPECT_EQ(machine.axes.output(4), 0);
  machine.ticks(5000);
  EXPECT_EQ(machine.axes.speedPerMinute(4), 0);
  EXPECT_EQ(machine.axes.mainSpindle(), 4u);
}

TEST(Spindles, ParameterSets) {
  AxesMachine machine;
  machine.axes.regul(2, 4);
  EXPECT_EQ(machine.axes.regulator(2), 4u);
  EXPECT_EQ(machine.axes.regulator(1), 1u);
  machine.axes.regul(6, 2); // there are four axes
  EXPECT_EQ(machine.log(), "REGUL_6: axis 6 does not exist\n");
}

} // namespace

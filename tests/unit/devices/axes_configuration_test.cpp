// Configuration of the axes, switches by position, quantities, and what a power-up, a fault and STOP PLC do.
#include <gtest/gtest.h>

#include "tests/unit/devices/axes_machine.h"

namespace {

using namespace rung::sim::technol;
using rung::test::AxesMachine;

TEST(AxesConfiguration, TakesAttributesByTheirNames) {
  AxesMachine machine({{"axes", "XZC"}, {"axis.1.Position", "12.5"}, {"axis.3.Rotary", "1"}});
  EXPECT_EQ(machine.problems, "");
  EXPECT_EQ(machine.axes.count(), 3u);
  EXPECT_EQ(machine.axes.physical(1), 12.5);
  EXPECT_EQ(machine.axes.measured(1), 0);
}

TEST(AxesConfiguration, SaysWhatIsWrong) {
  Axes axes;
  EXPECT_EQ(axes.configure("axis.1.Colour", "3"), "an axis has no attribute 'Colour'");
  EXPECT_EQ(axes.configure("axis.17.Feed", "3"), "'axis.17.Feed' needs an axis from 1 to 16: axis.1.Feed");
  EXPECT_EQ(axes.configure("axis.2.RefMethod", "7"), "'RefMethod' needs 1, 5 or 9 to 15; found '7'");
  EXPECT_EQ(axes.configure("axis.2.RefSwitch", "3"), "'RefSwitch' needs 0 to 2; found '3'");
  EXPECT_EQ(axes.configure("axis.2.Acceleration", "0"), "'Acceleration' needs a number above 0; found '0'");
  EXPECT_EQ(axes.configure("axis.2.Position", "much"), "'Position' needs a number; found 'much'");
  EXPECT_EQ(axes.configure("axes", "XYX"), "'axes' has the letter 'X' twice");
  EXPECT_EQ(axes.configure("axes", ""), "'axes' needs 1 to 16 letters");
  EXPECT_NE(axes.configure("spindle", "1"), "");
  EXPECT_NE(axes.addSwitch(5, "1 5 -5"), "");
  EXPECT_NE(axes.addSwitch(5, "1 5"), "");
  EXPECT_NE(axes.addSwitch(5, "1 5 6 7"), "");
  EXPECT_EQ(axes.configure("axis.2.Position", "2e9"), "'Position' needs a number of -1e9 to 1e9; found '2e9'");
}

TEST(AxesConfiguration, AxesThatDoNotExist) {
  Axes axes;
  EXPECT_EQ(axes.configurationProblem(), "");
  EXPECT_EQ(axes.configure("axis.5.Feed", "5"), "");
  EXPECT_EQ(axes.configurationProblem(), "'axis.5.Feed' is for axis 5; the axes are XYZC, 1 to 4 (config axes)");
  EXPECT_EQ(axes.configure("axes", "XYZCA"), "");
  EXPECT_EQ(axes.configurationProblem(), "");
  EXPECT_EQ(axes.addSwitch(0, "6 1 2"), "");
  EXPECT_EQ(axes.configurationProblem(), "'switch 6 1 2' is for axis 6; the axes are XYZCA, 1 to 5 (config axes)");
}

TEST(AxesConfiguration, AFaultEndsReferencesAndPositionings) {
  AxesMachine machine({{"axis.1.RefSwitch", "0"}, {"axis.4.RefSwitch", "0"}});
  machine.requests.homingStartReq = 1;
  machine.requests.positioning = 8;
  EXPECT_TRUE(machine.axes.spiAx(4, {}));
  machine.scan(5);
  EXPECT_NE(machine.axes.speedPerMinute(1), 0);
  EXPECT_NE(machine.axes.speedPerMinute(4), 0);
  machine.axes.fault();
  machine.scan(5);
  EXPECT_EQ(machine.axes.speedPerMinute(1), 0);
  EXPECT_EQ(machine.axes.speedPerMinute(4), 0);
  EXPECT_EQ(machine.requests.homingStartReq, 0);
  EXPECT_EQ(machine.requests.positioning, 0);
  EXPECT_EQ(machine.requests.homing, 0);
}

TEST(AxesConfiguration, SwitchIsClosedByThePhysicalPlace) {
  AxesMachine machine;
  ASSERT_EQ(machine.axes.addSwitch(77, "1 -1000 -5"), "");
  const Axes::Switch& contact = machine.axes.switches()[0];
  EXPECT_EQ(contact.bit, 77u);
  EXPECT_FALSE(machine.axes.isClosed(contact));
  machine.axes.setPhysical(1, -5);
  EXPECT_TRUE(machine.axes.isClosed(contact));
  machine.axes.setMeasured(1, 3);
  EXPECT_TRUE(machine.axes.isClosed(contact));
}

TEST(AxesConfiguration, SwitchOfARotaryAxisIsClosedInEachRevolution) {
  AxesMachine machine;
  ASSERT_EQ(machine.axes.configure("axis.1.Rotary", "1"), "");
  ASSERT_EQ(machine.axes.addSwitch(77, "1 -10 5"), "");
  const Axes::Switch& contact = machine.axes.switches()[0];
  for (const double closed : {-730., -370., -355., -10., 0., 5., 350., 365., 710.}) {
    machine.axes.setPhysical(1, closed);
    EXPECT_TRUE(machine.axes.isClosed(contact)) << closed;
  }
  for (const double open : {-371., -354., -11., 6., 180., 349., 366.}) {
    machine.axes.setPhysical(1, open);
    EXPECT_FALSE(machine.axes.isClosed(contact)) << open;
  }
}

TEST(AxesConfiguration, ShowsPositionsInTheUnitsOfTheCells) {
  AxesMachine machine;
  machine.axes.setMeasured(2, -1.5);
  machine.scan();
  EXPECT_EQ(machine.out.positionEx[1], -1500LL * 65536);
  EXPECT_EQ(machine.out.positionShort[1], -12000);
  EXPECT_EQ(machine.out.position[1], -1.5);
  EXPECT_EQ(machine.axes.physical(2), 0);
  machine.axes.setPhysical(2, 5);
  EXPECT_EQ(machine.axes.measured(2), 3.5);
}

TEST(AxesConfiguration, ShowsTheMotionOfABlock) {
  AxesMachine machine;
  machine.in.blockMotion = 2;
  machine.scan();
  EXPECT_EQ(machine.out.motion, 2);
  EXPECT_TRUE(machine.out.inPosition);
}

TEST(AxesConfiguration, StopRequestsAreTakenInTheNextScan) {
  AxesMachine machine;
  machine.requests.stopReq = machine.requests.stopEmergencyReq = true;
  machine.scan();
  EXPECT_FALSE(machine.requests.stopReq);
  EXPECT_FALSE(machine.requests.stopEmergencyReq);
}

TEST(AxesConfiguration, PowerUpStartsAnew) {
  AxesMachine machine({{"axis.4.SpeedAt10V", "360000"}});
  machine.axes.regul(1, 3);
  machine.axes.axSpi(4, SpindleRole::Main);
  machine.axes.analogSpi(kFullOutput, 4);
  machine.scan(10);
  EXPECT_GT(machine.axes.physical(4), 0);
  machine.axes.powerUp();
  EXPECT_EQ(machine.axes.regulator(1), 1u);
  EXPECT_EQ(machine.axes.spindleRole(4), 0u);
  EXPECT_EQ(machine.axes.output(4), 0);
  EXPECT_EQ(machine.axes.physical(4), 0);
  machine.scan(10);
  EXPECT_EQ(machine.axes.physical(4), 0);
}

} // namespace

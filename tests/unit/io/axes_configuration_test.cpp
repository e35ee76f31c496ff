// Configuration of the axes, switches by position, quantities, and what a power-up, a fault and STOP PLC do. What is
// said about a wrong configuration is a golden (golden_test.cpp).
#include <gtest/gtest.h>

#include "tests/unit/io/axes_machine.h"

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

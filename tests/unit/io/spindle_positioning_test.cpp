// SPI_AX (man. l.7821-7973).
#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/io/axes_machine.h"

namespace {

using namespace rung::sim::technol;
using rung::test::AxesMachine;
using Configuration = std::initializer_list<std::pair<const char*, const char*>>;

// 600 °/s with 2000 °/s²: v²/2a is 90°.
constexpr SpindlePositioningOrder kToPulse{.feed1 = 36'000'000, .feed2 = 36'000'000, .angle = 0, .accel = 2000};

struct SpindleMachine : AxesMachine {
  SpindleMachine(Configuration more = {}) // NOLINT(google-explicit-constructor)
      : AxesMachine({{"axis.4.Rotary", "1"}, {"axis.4.RefSwitch", "0"}}) {
    for (const auto& [key, value] : more) problems += axes.configure(key, value);
    EXPECT_EQ(problems, "");
    axes.powerUp();
    requests.homing = 0xFFFF;
  }
  bool positioning() const { return has(requests.positioning, 3); }
  bool referenced() const { return has(requests.homing, 3); }
  int ticksToEnd() {
    return ticksUntil([&] { return !positioning(); });
  }
};

TEST(SpindlePositioning, EndsAfterThePulseByItsRamp) {
  SpindleMachine machine{{"axis.4.MachineNullPoint", "15"}};
  ASSERT_TRUE(machine.spiAx(4, kToPulse));
  EXPECT_EQ(machine.out.motion, 8); // at once
  machine.ticks(1);
  EXPECT_FALSE(machine.referenced());
  EXPECT_EQ(machine.ticksToEnd() + 1, 1050); // 0.3 s ramp, 270° at 600 °/s, 0.3 s ramp
  EXPECT_NEAR(machine.axes.physical(4), 450, 1e-9);
  EXPECT_NEAR(machine.axes.measured(4), 15 + 90, 1e-9);
  EXPECT_TRUE(machine.referenced()); // l.11471
  EXPECT_EQ(machine.out.motion, 0);
  EXPECT_EQ(machine.axes.spindleRole(4), 0u);
}

TEST(SpindlePositioning, TurnsToTheAngleFromThePulse) {
  SpindleMachine machine;
  SpindlePositioningOrder order = kToPulse;
  order.angle = 135'000;
  machine.spiAx(4, order);
  EXPECT_EQ(machine.ticksToEnd(), 1050 + 300); // 45°: 2 * sqrt(s/a)
  EXPECT_NEAR(machine.axes.measured(4), 135, 1e-9);
  EXPECT_NEAR(machine.axes.physical(4), 495, 1e-9);
}

TEST(SpindlePositioning, NegativeFeedsTurnDirections) {
  SpindleMachine machine;
  SpindlePositioningOrder order = kToPulse;
  order.feed1 = -36'000'000;
  machine.spiAx(4, order);
  EXPECT_EQ(machine.out.negative, 8);
  machine.ticksToEnd();
  EXPECT_NEAR(machine.axes.physical(4), -450, 1e-9);
  EXPECT_NEAR(machine.axes.measured(4), -90, 1e-9);
  order = kToPulse;
  order.feed2 = -36'000'000;
  order.angle = 30'000;
  machine.spiAx(4, order);
  machine.ticksToEnd();
  EXPECT_NEAR(machine.axes.measured(4), -30, 1e-9);
}

TEST(SpindlePositioning, OperandsNotGivenAreAttributes) {
  SpindleMachine machine{
      {"axis.4.RefSpeedLow", "6000"}, {"axis.4.PosAfterRef", "-20"}, {"axis.4.Acceleration", "1000"}};
  machine.spiAx(4, {});
  machine.ticks(200);
  EXPECT_NEAR(machine.axes.speedPerMinute(4), 6000, 1e-6);
  EXPECT_NEAR(machine.axes.physical(4), 5 + 10, 1e-9);
  machine.ticksToEnd();
  EXPECT_NEAR(machine.axes.measured(4), -20, 1e-9);
}

TEST(SpindlePositioning, EdgeOfTheSwitchLetsPulsesCount) { // RefSwitch 1
  SpindleMachine machine{{"axis.4.RefSwitch", "1"}};
  machine.in.refSwitch = 8; // from before
  machine.spiAx(4, kToPulse);
  machine.ticks(2000);
  EXPECT_TRUE(machine.positioning());
  machine.in.refSwitch = 0;
  machine.ticks(20);
  machine.in.refSwitch = 8;
  machine.ticks(20);
  machine.in.refSwitch = 0;
  EXPECT_GT(machine.ticksToEnd(), 0);
  EXPECT_NEAR(machine.axes.measured(4), 90, 1e-6);
}

TEST(SpindlePositioning, LevelOfTheSwitchLetsPulsesCount) { // RefSwitch 2
  SpindleMachine machine{{"axis.4.RefSwitch", "2"}};
  machine.in.refSwitch = 8;
  machine.spiAx(4, kToPulse);
  machine.ticks(400);
  machine.in.refSwitch = 0; // before the pulse
  machine.ticks(2000);
  EXPECT_TRUE(machine.positioning());
  machine.in.refSwitch = 8;
  EXPECT_GT(machine.ticksToEnd(), 0);
}

TEST(SpindlePositioning, BeginsFromTheSpeedOfTheSpindle) {
  SpindleMachine machine{{"axis.4.SpeedAt10V", "360000"}, {"axis.4.Acceleration", "6000"}};
  machine.axes.axSpi(4, SpindleRole::Main);
  machine.axes.analogSpi(kFullOutput, 4);
  machine.ticks(2000);
  EXPECT_NEAR(machine.axes.speedPerMinute(4), 360'000, 1e-6);
  machine.spiAx(4, kToPulse);
  EXPECT_EQ(machine.axes.mainSpindle(), 0u);
  machine.ticks(1);
  EXPECT_NEAR(machine.axes.speedPerMinute(4), 360'000 - 2 * 60, 1e-6);
  machine.ticksToEnd();
  EXPECT_NEAR(machine.axes.measured(4), 90, 1e-6); // the pulse was passed with feed1
  EXPECT_NEAR(std::fmod(machine.axes.physical(4), 360), 90, 1e-6);
}

TEST(SpindlePositioning, SeveralAtATimeAndAnew) {
  SpindleMachine machine{{"axes", "XYZCB"}, {"axis.5.RefSwitch", "0"}};
  machine.spiAx(4, kToPulse);
  machine.ticks(500);
  machine.spiAx(5, kToPulse); // linear: a pulse every 10 mm
  machine.spiAx(4, kToPulse); // restarts: the same pulse lies ahead
  EXPECT_EQ(machine.ticksToEnd(), 550);
  machine.ticks(1000);
  EXPECT_EQ(machine.requests.positioning, 0);
  EXPECT_NEAR(machine.axes.measured(5), 10, 1e-9); // 2as at the pulse: it still accelerates
}

TEST(SpindlePositioning, AbortsBrakeAndLeaveItUnreferenced) { // l.7966-7973
  const auto aborted = [](Configuration configuration, auto abort) {
    SpindleMachine machine(configuration);
    machine.in.manualEnabled = 0xFFFF;
    machine.spiAx(4, kToPulse);
    machine.ticks(300);
    EXPECT_NEAR(machine.axes.physical(4), 90, 1e-9);
    abort(machine);
    machine.ticks(1);
    EXPECT_FALSE(machine.positioning());
    EXPECT_EQ(machine.out.motion, 8);
    machine.ticks(1000);
    EXPECT_EQ(machine.out.motion, 0);
    EXPECT_FALSE(machine.referenced());
    return machine.axes.physical(4);
  };
  const double byAccel = 180, byEmergency = 90 + 600. * 600 / 2 / 9000;
  const Configuration hard{{"axis.4.AccelerationEmergency", "9000"}};
  EXPECT_NEAR(aborted({}, [](auto& m) { m.requests.positioning = 0; }), byAccel, 1e-9);
  EXPECT_NEAR(aborted({}, [](auto& m) { m.axes.stop(false); }), byAccel, 1e-9);
  EXPECT_NEAR(aborted({}, [](auto& m) { m.requests.stopReq = true; }), byAccel, 1e-9);
  EXPECT_NEAR(aborted({}, [](auto& m) { m.in.stopPi = true; }), byAccel, 1e-9);
  EXPECT_NEAR(aborted({}, [](auto& m) { m.in.enabled = 7; }), byAccel, 1e-9);
  EXPECT_NEAR(aborted({{"axis.4.ManEnable", "2"}}, [](auto& m) { m.in.manualEnabled = 7; }), byAccel, 1e-9);
  EXPECT_NEAR(aborted(hard, [](auto& m) { m.axes.stop(true); }), byEmergency, 1e-9);
  EXPECT_NEAR(aborted(hard, [](auto& m) { m.requests.stopEmergencyReq = true; }), byEmergency, 1e-9);
  EXPECT_NEAR(aborted(hard, [](auto& m) { m.in.limitPlus = 8; }), byEmergency, 1e-9);
}

TEST(SpindlePositioning, WhatDoesNotConcernItDoesNotAbort) {
  SpindleMachine machine;
  machine.in.limitMinus = 8;
  machine.in.limitPlus = 7;
  machine.in.stopPi = true;
  machine.scan(); // the edge was before
  machine.spiAx(4, kToPulse);
  EXPECT_EQ(machine.ticksToEnd(), 1050);
  EXPECT_TRUE(machine.referenced());
}

TEST(SpindlePositioning, AxSpiAbortsIt) {
  SpindleMachine machine;
  machine.spiAx(4, kToPulse);
  machine.ticks(300);
  machine.axes.axSpi(4, SpindleRole::Main);
  machine.ticks(1);
  EXPECT_FALSE(machine.positioning());
  EXPECT_FALSE(machine.referenced());
  machine.ticks(3000);
  EXPECT_EQ(machine.axes.speedPerMinute(4), 0);
  EXPECT_EQ(machine.axes.spindleRole(4), 1u);
}

TEST(SpindlePositioning, RefusesAxesOfUnitsAndThoseThatAreNotThere) {
  SpindleMachine machine;
  machine.axes.posInit(4, 0, true);
  EXPECT_FALSE(machine.spiAx(4, kToPulse));
  EXPECT_FALSE(machine.spiAx(5, kToPulse));
  EXPECT_FALSE(machine.spiAx(0, kToPulse));
  EXPECT_EQ(machine.log(), "SPI_AX: axis 4 belongs to a positioning unit\nSPI_AX: axis 5 does not exist\n"
                           "SPI_AX: axis 0\n");
}

TEST(SpindlePositioning, GoesOnWhileThePlcIsStopped) {
  SpindleMachine machine;
  machine.spiAx(4, kToPulse);
  machine.ticks(100);
  machine.axes.startPlc();
  EXPECT_EQ(machine.ticksToEnd(), 950);
}

} // namespace

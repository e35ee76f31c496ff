// Positioning units (man. chapter 19, l.12030-12420).
#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/io/axes_machine.h"

namespace {

using namespace rung::io;
using rung::test::AxesMachine;

constexpr uint32_t mmPerMin(double speed) { return static_cast<uint32_t>(speed * 65536); }

uint16_t status(AxesMachine& machine, int64_t axis, double feed, bool mp = true) {
  return machine.axes.posControl(axis, mmPerMin(feed), mp).status;
}

// POS_INIT and POS_MODE.
void begin(AxesMachine& machine, int64_t axis, int32_t length, uint16_t acceleration = 500) {
  machine.axes.posInit(axis, 0, true);
  ASSERT_TRUE(machine.axes.posMode(axis, length, acceleration).accepted);
}

TEST(PositioningUnit, MovesByTheDistance) {
  AxesMachine machine;
  begin(machine, 1, 60'000);                                             // 60 mm
  EXPECT_EQ(status(machine, 1, 6000), kUnitAvailable | kUnitProgrammed); // no JEDE in that scan
  machine.scan();
  EXPECT_EQ(status(machine, 1, 6000), kUnitAvailable | kUnitProgrammed | kUnitMoves);
  EXPECT_EQ(machine.out.motion, 1);
  EXPECT_FALSE(machine.out.inPosition);
  const int ticks = machine.ticksUntil([&] { return (status(machine, 1, 6000) & kUnitArrived) != 0; });
  EXPECT_EQ(ticks + 20, 800); // 60 mm at 100 mm/s, 500 mm/s²: s/v + v/a
  EXPECT_EQ(status(machine, 1, 6000), kUnitAvailable | kUnitProgrammed | kUnitArrived);
  EXPECT_EQ(machine.axes.measured(1), 60);
  EXPECT_EQ(machine.out.motion, 0);
  machine.axes.posReset(1);
  EXPECT_EQ(status(machine, 1, 6000), 0);
}

TEST(PositioningUnit, GoesBackInNegativeDirection) {
  AxesMachine machine({{"axis.2.Position", "10"}});
  begin(machine, 2, -1, 1000); // a µm: 2 * sqrt(s/a) = 2 ms
  status(machine, 2, 6000);
  machine.ticks(1);
  EXPECT_EQ(status(machine, 2, 6000), kUnitAvailable | kUnitProgrammed | kUnitMoves | kUnitNegative);
  EXPECT_EQ(machine.out.negative, 2);
  machine.ticks(1);
  EXPECT_EQ(status(machine, 2, 6000), kUnitAvailable | kUnitProgrammed | kUnitNegative | kUnitArrived);
  EXPECT_EQ(machine.axes.physical(2), 10 - 0.001);
}

TEST(PositioningUnit, DistanceOfNothingArrivesAtOnce) {
  AxesMachine machine;
  begin(machine, 1, 0);
  EXPECT_EQ(machine.axes.posControl(1, 0, false).status & kUnitArrived, 0);
  machine.ticks(1);
  EXPECT_NE(machine.axes.posControl(1, 0, false).status & kUnitArrived, 0);
}

TEST(PositioningUnit, BitsOfTheControlRecord) { // l.12101-12133
  AxesMachine machine;
  machine.axes.posInit(1, 0, true);
  EXPECT_FALSE(machine.axes.posControl(1, 0, true).programmed);
  EXPECT_EQ(machine.axes.posMode(1, 1000, 500).control, kControlInit); // MP := 0
  EXPECT_EQ(machine.axes.posControl(1, mmPerMin(600), true).control, kControlInit | kControlMp);
  machine.ticks(1);
  EXPECT_EQ(machine.axes.posControl(1, mmPerMin(600), true).control, kControlContinue | kControlMp);
  machine.ticks(5000);
  const PositioningUnits::State state = machine.axes.posControl(1, mmPerMin(600), false);
  EXPECT_TRUE(state.programmed);
  EXPECT_EQ(state.control, 0);
}

TEST(PositioningUnit, IsHeldAndGoesOn) {
  AxesMachine machine;
  begin(machine, 1, 100'000);
  const auto standsAfter = [&](auto hold, auto release) {
    const double before = machine.axes.measured(1);
    status(machine, 1, 6000);
    hold();
    machine.ticks(1000);
    const double place = machine.axes.measured(1);
    machine.ticks(100);
    EXPECT_EQ(machine.axes.measured(1), place);
    EXPECT_LT(place, 100);
    EXPECT_NEAR(place - before, before == 0 ? 0 : 10, 0.1); // v²/2a
    release();
    status(machine, 1, 6000);
    machine.ticks(300);
    EXPECT_NEAR(machine.axes.speedPerMinute(1), 6000, 1e-6);
  };
  standsAfter([&] { status(machine, 1, 6000, false); }, [] {});
  standsAfter([&] { status(machine, 1, 0); }, [] {});
  standsAfter([&] { machine.in.enabled = 0xFFFE; }, [&] { machine.in.enabled = 0xFFFF; });
  machine.ticks(5000);
  EXPECT_EQ(machine.axes.measured(1), 100);
}

TEST(PositioningUnit, RequestStaysWhereMotionIsForbidden) { // l.6243
  AxesMachine machine;
  begin(machine, 1, -1000);
  machine.in.enabled = 0;
  status(machine, 1, 600);
  machine.scan();
  EXPECT_EQ(machine.out.motion, 1);
  EXPECT_EQ(machine.out.negative, 1);
  EXPECT_EQ(machine.axes.measured(1), 0);
}

TEST(PositioningUnit, LimitsOfItsDirectionBrakeHardAndAreNotLatched) { // l.6688-6694
  AxesMachine machine;
  begin(machine, 1, 100'000);
  status(machine, 1, 6000);
  machine.ticks(300);
  machine.in.limitMinus = 1;
  machine.ticks(10);
  EXPECT_NEAR(machine.axes.speedPerMinute(1), 6000, 1e-6);
  machine.in.limitPlus = 1;
  const double before = machine.axes.measured(1);
  machine.ticks(50);
  EXPECT_EQ(machine.axes.speedPerMinute(1), 0);
  EXPECT_NEAR(machine.axes.measured(1) - before, 100. * 100 / 2 / 2000, 1e-9);
  machine.in.limitPlus = 0;
  machine.ticks(3000);
  EXPECT_EQ(machine.axes.measured(1), 100);
}

TEST(PositioningUnit, TakesAnotherFeedAndCapsIt) {
  AxesMachine machine({{"axis.1.FeedRT", "9000"}});
  begin(machine, 1, 1'000'000);
  status(machine, 1, 6000);
  machine.ticks(500);
  EXPECT_NEAR(machine.axes.speedPerMinute(1), 6000, 1e-6);
  status(machine, 1, 3000);
  machine.ticks(100);
  EXPECT_NEAR(machine.axes.speedPerMinute(1), 3000, 1e-6);
  status(machine, 1, 60000);
  machine.ticks(500);
  EXPECT_NEAR(machine.axes.speedPerMinute(1), 9000, 1e-6);
}

TEST(PositioningUnit, InitEndsAMotionForGood) { // l.12149-12157
  AxesMachine machine;
  begin(machine, 1, 100'000);
  status(machine, 1, 6000);
  machine.ticks(300);
  machine.axes.posInit(1, 0, true);
  EXPECT_EQ(status(machine, 1, 6000), kUnitAvailable | kUnitMoves);
  machine.ticks(1000);
  EXPECT_NEAR(machine.axes.measured(1), 20 + 10, 1e-9);
  EXPECT_EQ(machine.out.motion, 0);
}

TEST(PositioningUnit, ModeAfterInitCountsFromTheStand) {
  AxesMachine machine;
  begin(machine, 1, 100'000);
  status(machine, 1, 6000);
  machine.ticks(300);
  begin(machine, 1, 5000);
  status(machine, 1, 6000);
  machine.ticks(3000);
  EXPECT_NEAR(machine.axes.measured(1), 35, 1e-9);
}

TEST(PositioningUnit, ModeDuringAMotionIsAnError) {
  AxesMachine machine;
  begin(machine, 1, 100'000);
  status(machine, 1, 6000);
  machine.ticks(300);
  EXPECT_FALSE(machine.axes.posMode(1, 5, 500).accepted);
  EXPECT_NE(status(machine, 1, 6000) & kUnitError, 0);
  machine.ticks(5000);
  EXPECT_EQ(machine.axes.measured(1), 100); // the order is ignored
  EXPECT_NE(status(machine, 1, 6000) & kUnitError, 0);
  machine.axes.posInit(1, 0, true);
  EXPECT_EQ(status(machine, 1, 6000), kUnitAvailable);
}

TEST(PositioningUnit, OtherErrors) {
  AxesMachine machine({{"axes", "XYZCABUV"}});
  EXPECT_FALSE(machine.axes.posMode(1, 5, 500).accepted); // without POS_INIT
  EXPECT_EQ(status(machine, 1, 0), kUnitError);
  machine.axes.posInit(1, 0, true);
  EXPECT_FALSE(machine.axes.posMode(1, 5, 0).accepted);
  EXPECT_EQ(status(machine, 1, 0), kUnitError | kUnitAvailable);
  machine.axes.posInit(2, 0, false); // VAZBA_Y = 0
  EXPECT_EQ(status(machine, 2, 0), kUnitError);
  machine.in.blockMotion = 2;
  machine.scan();
  machine.axes.posInit(2, 0, true);
  EXPECT_EQ(status(machine, 2, 0), kUnitError);
  machine.axes.posInit(12, 0, true); // does not exist
  EXPECT_EQ(status(machine, 12, 0), kUnitError);
  machine.axes.posInit(17, 0, true);
  machine.axes.posInit(1, 7, true);
  EXPECT_EQ(machine.log(), "POS_INIT: axis 17\nPOS_INIT: space 7\n");
}

TEST(PositioningUnit, ThereAreSix) { // l.12040
  AxesMachine machine({{"axes", "XYZCABUV"}});
  for (int64_t axis = 1; axis <= 7; ++axis) machine.axes.posInit(axis, 0, true);
  EXPECT_EQ(status(machine, 6, 0), kUnitAvailable);
  EXPECT_EQ(status(machine, 7, 0), kUnitError);
  machine.axes.posReset(3);
  machine.axes.posInit(7, 0, true);
  EXPECT_EQ(status(machine, 7, 0), kUnitAvailable);
}

TEST(PositioningUnit, SeveralMoveAtATime) {
  AxesMachine machine;
  begin(machine, 1, 10'000);
  begin(machine, 3, -20'000);
  status(machine, 1, 6000);
  status(machine, 3, 600);
  machine.ticks(10'000);
  EXPECT_EQ(machine.axes.measured(1), 10);
  EXPECT_EQ(machine.axes.measured(3), -20);
}

TEST(PositioningUnit, ResetBrakes) {
  AxesMachine machine;
  begin(machine, 1, 100'000);
  status(machine, 1, 6000);
  machine.ticks(300);
  machine.axes.posReset(1);
  machine.scan();
  EXPECT_EQ(machine.out.motion, 1); // until it stops
  machine.ticks(1000);
  EXPECT_NEAR(machine.axes.measured(1), 30, 1e-9);
  EXPECT_EQ(machine.out.motion, 0);
}

TEST(PositioningUnit, StopOfTheNcDoesNotTouchIt) {
  AxesMachine machine;
  begin(machine, 1, 100'000);
  status(machine, 1, 6000);
  machine.ticks(300);
  machine.axes.stop(true);
  machine.ticks(5000);
  EXPECT_EQ(machine.axes.measured(1), 100);
}

TEST(PositioningUnit, FaultBrakesIt) {
  AxesMachine machine;
  begin(machine, 1, 100'000);
  status(machine, 1, 6000);
  machine.ticks(300);
  machine.axes.fault();
  machine.ticks(3000);
  EXPECT_NEAR(machine.axes.measured(1), 30, 1e-9);
  machine.axes.startPlc();
  status(machine, 1, 6000);
  machine.ticks(3000);
  EXPECT_EQ(machine.axes.measured(1), 100);
}

} // namespace

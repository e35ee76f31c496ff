// References (man. chapter 15, l.11460-12030).
#include <gtest/gtest.h>

#include "tests/unit/io/axes_machine.h"

namespace {

using namespace rung::sim::technol;
using rung::test::AxesMachine;
using Configuration = std::initializer_list<std::pair<const char*, const char*>>;

// Axis 1 with 100 mm/s and 10 mm/s at 500 mm/s², zero pulses every 10 mm; its switches are on between two places.
struct ReferenceMachine : AxesMachine {
  struct Range {
    double low = 1, high = 0;
    AxisMask at(double place) const { return place >= low && place <= high ? 1 : 0; }
  };
  Range reference, reverse, slow;

  ReferenceMachine(Configuration more = {}) // NOLINT(google-explicit-constructor)
      : AxesMachine({{"axis.1.RefSpeed", "6000"}, {"axis.1.RefSpeedLow", "600"}}) {
    for (const auto& [key, value] : more) problems += axes.configure(key, value);
    EXPECT_EQ(problems, "");
    axes.powerUp();
  }
  void tick() {
    const double place = axes.physical(1);
    in.refSwitch = in.servoSwitch = reference.at(place);
    in.reverseSwitch = reverse.at(place);
    in.slowSwitch = slow.at(place);
    ticks(1);
  }
  void tick(int count) {
    for (int i = 0; i < count; ++i) tick();
  }
  // The operator's single reference of axis 1, to its end. Ticks, or -1.
  int run() {
    EXPECT_EQ(axes.reference("single", 1), "");
    for (int i = 1; i < 100'000; ++i) {
      tick();
      if (!out.reference) return i;
    }
    return -1;
  }
  bool referenced() const { return has(requests.homing, 0); }
};

TEST(Reference, FastMethodSetsTheZeroPointAtThePulseAfterTheSwitch) {
  ReferenceMachine machine{{"axis.1.MachineNullPoint", "-200"}};
  machine.reference = {52, 1000};
  machine.requests.homing = 1;
  machine.axes.reference("single", 1);
  machine.tick();
  EXPECT_TRUE(machine.out.reference); // REFPI
  EXPECT_EQ(machine.out.motion, 1);
  EXPECT_FALSE(machine.referenced());
  machine.tick(300);
  EXPECT_NEAR(machine.axes.speedPerMinute(1), 6000, 1e-6);
  machine.tick(3000);
  EXPECT_TRUE(machine.referenced());
  EXPECT_FALSE(machine.out.reference);
  EXPECT_EQ(machine.out.motion, 0);
  EXPECT_NEAR(machine.axes.physical(1), 70.1, 1e-9); // the pulse at 70, v²/2a of 10 mm/s
  EXPECT_NEAR(machine.axes.measured(1), -199.9, 1e-9);
}

TEST(Reference, DefaultsAreThoseOfTheManual) {
  AxesMachine machine;
  machine.axes.reference("single", 1);
  machine.ticks(1000);
  EXPECT_NEAR(machine.axes.speedPerMinute(1), 10000, 1e-6);
}

TEST(Reference, GoesInNegativeDirection) {
  ReferenceMachine machine{{"axis.1.InvertRefDirection", "1"}};
  machine.reference = {-1000, -52};
  EXPECT_GT(machine.run(), 0);
  EXPECT_NEAR(machine.axes.physical(1), -70.1, 1e-9);
  EXPECT_NEAR(machine.axes.measured(1), -0.1, 1e-9);
}

TEST(Reference, ReversesOnce) {
  ReferenceMachine machine;
  machine.reverse = {30, 1000};
  machine.reference = {-1000, -52};
  EXPECT_GT(machine.run(), 0);
  EXPECT_NEAR(machine.axes.physical(1), -70.1, 1e-9);
}

TEST(Reference, SlowsDownBeforeTheSwitch) {
  ReferenceMachine machine{{"axis.1.SlowDownSwitch", "1"}};
  machine.slow = {32, 1000};
  machine.reference = {52, 1000};
  EXPECT_GT(machine.run(), 0);
  EXPECT_NEAR(machine.axes.physical(1), 60.1, 1e-9);
}

TEST(Reference, WithoutSwitchItIsSlowFromTheStart) {
  ReferenceMachine machine{{"axis.1.RefSwitch", "0"}};
  EXPECT_EQ(machine.run(), 20 + 990 + 20); // v/a, 9.9 mm at 10 mm/s, v/a
  EXPECT_NEAR(machine.axes.physical(1), 10.1, 1e-9);
}

TEST(Reference, LevelAndEdgeOfTheSwitch) {
  ReferenceMachine edge, level{{"axis.1.RefSwitch", "2"}};
  edge.reference = level.reference = {-5, 1000}; // it is on the switch
  EXPECT_EQ(edge.run(), -1);
  EXPECT_GT(level.run(), 0);
  EXPECT_NEAR(level.axes.physical(1), 10.1, 1e-9);
}

TEST(Reference, MovesOnRelativelyAndAbsolutely) {
  for (const auto& [how, place] : {std::pair{"1", -130.}, {"2", -30.}}) {
    ReferenceMachine machine{
        {"axis.1.MachineNullPoint", "-100"}, {"axis.1.MoveToPosAfterRef", how}, {"axis.1.PosAfterRef", "-30"}};
    machine.reference = {52, 1000};
    EXPECT_GT(machine.run(), 0);
    EXPECT_NEAR(machine.axes.measured(1), place, 1e-9);
  }
}

TEST(Reference, SwitchWithReversal) { // 10, 12, 15
  for (const char* method : {"10", "12", "15"}) {
    ReferenceMachine machine{{"axis.1.RefMethod", method}, {"axis.1.MachineNullPoint", "7"}};
    machine.reference = {50, 1000};
    EXPECT_GT(machine.run(), 0);
    EXPECT_NEAR(machine.axes.physical(1), 49.9, 0.02); // zero at 50, to a tick
    EXPECT_NEAR(machine.axes.measured(1), 6.9, 1e-9);
    EXPECT_EQ(machine.out.negative, 1);
  }
}

TEST(Reference, SwitchWithoutReversal) { // 11
  ReferenceMachine machine{{"axis.1.RefMethod", "11"}};
  machine.slow = {30, 1000};
  machine.reference = {50, 1000};
  EXPECT_GT(machine.run(), 0);
  EXPECT_NEAR(machine.axes.physical(1), 50.1, 0.02);
  EXPECT_NEAR(machine.axes.measured(1), 0.1, 1e-9);
}

TEST(Reference, WithoutMotion) { // 13, 14
  ReferenceMachine simulated{{"axis.1.RefMethod", "13"}, {"axis.1.MachineNullPoint", "9"}};
  simulated.axes.setPhysical(1, 4);
  EXPECT_EQ(simulated.run(), 1); // without REFPI (l.6757)
  EXPECT_EQ(simulated.axes.measured(1), 9);
  EXPECT_EQ(simulated.axes.physical(1), 4);
  ReferenceMachine absolute{{"axis.1.RefMethod", "14"}, {"axis.1.MachineNullPoint", "9"}};
  absolute.in.servoPosition[0] = -2500;
  EXPECT_EQ(absolute.run(), 1);
  EXPECT_EQ(absolute.axes.measured(1), 6.5);
  absolute.axes.configure("axis.1.InvertRefDirection", "1");
  EXPECT_EQ(absolute.run(), 1);
  EXPECT_EQ(absolute.axes.measured(1), 11.5);
}

TEST(Reference, CodedDistances) { // 5
  ReferenceMachine machine{{"axis.1.RefMethod", "5"}, {"axis.1.Position", "33"}, {"axis.1.ZeroPulseAt", "3"}};
  EXPECT_GT(machine.run(), 0);
  EXPECT_NEAR(machine.axes.measured(1), machine.axes.physical(1) - 3, 1e-9);
  EXPECT_TRUE(machine.referenced());
}

TEST(Reference, IsHeldByEnableAndLimit) {
  ReferenceMachine machine;
  machine.reference = {52, 1000};
  machine.axes.reference("single", 1);
  machine.tick(300);
  machine.in.enabled = 0xFFFE;
  machine.tick(300);
  EXPECT_EQ(machine.axes.speedPerMinute(1), 0);
  EXPECT_EQ(machine.out.motion, 1);
  machine.in.enabled = 0xFFFF;
  machine.in.limitPlus = 1;
  machine.tick(100);
  EXPECT_EQ(machine.axes.speedPerMinute(1), 0);
  machine.in.limitPlus = 0;
  machine.tick(4000);
  EXPECT_TRUE(machine.referenced());
  EXPECT_NEAR(machine.axes.measured(1), 0.1, 1e-9);
}

TEST(Reference, StopEndsIt) {
  for (const bool byProgram : {false, true}) {
    ReferenceMachine machine;
    machine.requests.homing = 1;
    if (byProgram)
      machine.requests.homingStartReq = 1;
    else
      machine.axes.reference("single", 1);
    machine.tick(300);
    EXPECT_TRUE(machine.out.reference);
    machine.requests.stopReq = true;
    machine.tick(1);
    EXPECT_FALSE(machine.out.reference);
    EXPECT_EQ(machine.requests.homingStartReq, 0);
    machine.tick(1000);
    EXPECT_EQ(machine.out.motion, 0);
    EXPECT_FALSE(machine.referenced());
    EXPECT_EQ(machine.axes.speedPerMinute(1), 0);
  }
}

TEST(Reference, ProgramStartsIt) { // l.11744
  AxesMachine machine({{"axis.1.RefSwitch", "0"}, {"axis.2.RefSwitch", "0"}, {"axis.1.RefSpeedLow", "600"}});
  machine.requests.homingStartReq = 3;
  machine.scan();
  EXPECT_EQ(machine.out.motion, 3); // together
  EXPECT_TRUE(machine.out.reference);
  machine.ticks(2000);
  EXPECT_EQ(machine.requests.homing, 1);
  EXPECT_EQ(machine.requests.homingStartReq, 2);
  machine.ticks(20'000);
  EXPECT_EQ(machine.requests.homing, 3);
  EXPECT_EQ(machine.requests.homingStartReq, 0);
  EXPECT_FALSE(machine.out.reference);
}

TEST(Reference, ProgramSetsTheZeroPoint) { // l.6643, l.11779
  AxesMachine machine({{"axis.2.MachineNullPoint", "100"}});
  machine.axes.setPhysical(2, 33);
  machine.in.refpointDist[1] = -2500LL * 65536; // µm
  machine.requests.homingReq = 2;
  machine.scan();
  EXPECT_EQ(machine.requests.homingReq, 0);
  EXPECT_EQ(machine.axes.measured(2), 97.5);
  EXPECT_EQ(machine.requests.homing, 0);
}

TEST(Reference, ThatThePlcDoesIsAskedOfIt) {
  AxesMachine machine({{"axis.1.RefMethod", "1"}, {"axis.2.RefViaPlc", "1"}});
  machine.axes.reference("single", 3);
  machine.scan();
  EXPECT_TRUE(machine.requests.homingSingle);
  EXPECT_EQ(machine.requests.homingAxes, 3);
  EXPECT_EQ(machine.out.motion, 0);
  machine.requests.homingStartReq = 1; // RefMethod 1: refused
  machine.scan();
  EXPECT_EQ(machine.requests.homingStartReq, 0);
  EXPECT_EQ(machine.log(), "reference: axis 1 has RefMethod 1: the PLC references it\n");
  machine.axes.reference("plc", 4);
  machine.scan();
  EXPECT_TRUE(machine.requests.homingPlc);
  EXPECT_EQ(machine.requests.homingAxes, 4);
  machine.axes.reference("group", 6);
  machine.scan();
  EXPECT_TRUE(machine.requests.homingGroup);
  EXPECT_EQ(machine.requests.homingAxes, 6);
}

TEST(Reference, WithoutTravel) { // pseudo, simul, clear
  AxesMachine machine;
  machine.axes.setPhysical(1, 8);
  machine.requests.softLimits = machine.requests.nonlinearEnable = 0xFFFF;
  machine.axes.reference("pseudo", 1);
  machine.axes.reference("simul", 2);
  machine.scan();
  EXPECT_EQ(machine.requests.homing, 3);
  EXPECT_EQ(machine.axes.measured(1), 0);
  EXPECT_EQ(machine.requests.softLimits, 0xFFFE);
  EXPECT_EQ(machine.requests.nonlinearEnable, 0xFFFE);
  machine.axes.reference("clear", 1);
  machine.scan();
  EXPECT_EQ(machine.requests.homing, 2);
}

TEST(Reference, OverrideHasAnEffectUnlessConfigured) { // FeedOvrDuringRef l.11577
  for (const auto& [without, speed] : {std::pair{"0", 3000.}, {"1", 6000.}}) {
    ReferenceMachine machine{{"axis.1.FeedOvrDuringRef", without}};
    machine.in.feedOvr = true;
    machine.in.feedOverride = 500;
    machine.axes.reference("single", 1);
    machine.tick(500);
    EXPECT_NEAR(machine.axes.speedPerMinute(1), speed, 1e-6);
  }
}

TEST(Reference, RefusesWhatCannotBe) {
  AxesMachine machine;
  EXPECT_NE(machine.axes.reference("double", 1), "");
  EXPECT_EQ(machine.axes.reference("single", 0x10), "a reference needs axes that exist: XYZC");
  machine.axes.posInit(1, 0, true);
  machine.axes.axSpi(4, SpindleRole::Main);
  machine.axes.reference("single", 9);
  machine.scan();
  EXPECT_EQ(machine.log(), "reference: axis 1 is moved otherwise\nreference: axis 4 is a spindle\n");
  EXPECT_FALSE(machine.out.reference);
}

} // namespace

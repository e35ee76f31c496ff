// Manual motion, the handwheel and SHIFT (man. chapter 20, l.10830-11135), and commands of keys (l.17360-17630).
#include <gtest/gtest.h>

#include "tests/unit/io/axes_machine.h"

namespace {

using namespace rung::sim::technol;
using rung::test::AxesMachine;

struct ManualMachine : AxesMachine {
  using AxesMachine::AxesMachine;
  ManualMachine() : AxesMachine() {}
  // By the program: AUTMAN_REQ and REQ_EXT_CONT_AUTMAN.
  void external() {
    in.autmanReq = in.externalControl = true;
    scan();
  }
  void byPanel() {
    axes.autman(true);
    scan();
  }
  void key(const char* command, bool pressed) { EXPECT_EQ(axes.rtm(command, pressed), "") << command; }
};

TEST(ManualMotion, IsActiveByRequestSelectionAndOperator) { // l.10844, l.11015-11030
  ManualMachine machine;
  machine.scan();
  EXPECT_FALSE(machine.out.manual);
  machine.in.autmanReq = true;
  machine.scan();
  EXPECT_TRUE(machine.out.manual);
  machine.in.autmanReq = false;
  machine.scan();
  EXPECT_FALSE(machine.out.manual);
  machine.requests.autmanSelect = true;
  machine.scan();
  EXPECT_FALSE(machine.requests.autmanSelect);
  EXPECT_TRUE(machine.out.manual);
  machine.requests.autmanCancel = true;
  machine.scan();
  EXPECT_FALSE(machine.requests.autmanCancel);
  EXPECT_FALSE(machine.out.manual);
  machine.byPanel();
  EXPECT_TRUE(machine.out.manual);
  machine.in.autmanAllowed = false;
  machine.scan();
  EXPECT_FALSE(machine.out.manual);
  machine.requests.autmanSelect = true; // not granted, taken all the same
  machine.scan();
  EXPECT_FALSE(machine.requests.autmanSelect);
  EXPECT_FALSE(machine.out.manual);
}

TEST(ManualMotion, ProgramMovesSeveralAxes) {
  ManualMachine machine;
  machine.external();
  machine.in.externalPlus = 1;
  machine.in.externalMinus = 2;
  machine.scan();
  EXPECT_EQ(machine.out.motion, 3);
  EXPECT_EQ(machine.out.negative, 2);
  machine.ticks(980);
  // 2000 mm/min at 500 mm/s²: s = v t - v²/2a
  const double v = 2000. / 60;
  EXPECT_NEAR(machine.axes.measured(1), v - v * v / 1000, 1e-9);
  EXPECT_NEAR(machine.axes.measured(2), -(v - v * v / 1000), 1e-9);
  machine.in.externalPlus = machine.in.externalMinus = 0;
  machine.scan();
  EXPECT_EQ(machine.out.motion, 3); // until the standstill
  machine.ticks(200);
  EXPECT_EQ(machine.out.motion, 0);
  EXPECT_NEAR(machine.axes.measured(1), v, 1e-9);
}

TEST(ManualMotion, BothDirectionsAreNone) {
  ManualMachine machine;
  machine.external();
  machine.in.externalPlus = machine.in.externalMinus = 1;
  machine.ticks(100);
  EXPECT_EQ(machine.axes.measured(1), 0);
  EXPECT_EQ(machine.out.motion, 0);
}

TEST(ManualMotion, OrdersOfTheProgramNeedItsControl) {
  ManualMachine machine;
  machine.byPanel();
  machine.in.externalPlus = 1;
  machine.ticks(100);
  EXPECT_EQ(machine.axes.measured(1), 0);
  machine.key("RTMID_MMM_MOVE01", true);
  machine.scan();
  EXPECT_EQ(machine.out.motion, 2);
  machine.in.externalControl = true;
  machine.scan();
  EXPECT_NE(machine.axes.speedPerMinute(1), 0);
  EXPECT_FALSE(machine.out.panelControl);
  machine.ticks(200);
  EXPECT_EQ(machine.axes.speedPerMinute(2), 0);
}

TEST(ManualMotion, Speeds) { // l.10966-11009
  ManualMachine machine({{"axis.1.Feed", "1200"}, {"axis.1.FeedRT", "6000"}});
  machine.external();
  machine.in.externalPlus = 1;
  const auto speed = [&] {
    machine.ticks(500);
    return machine.axes.speedPerMinute(1);
  };
  EXPECT_NEAR(speed(), 1200, 1e-6);
  machine.in.feed = 3000;
  EXPECT_NEAR(speed(), 1200, 1e-6);
  machine.in.externalFeed = true;
  EXPECT_NEAR(speed(), 3000, 1e-6);
  machine.in.feedMultiplier = 500;
  EXPECT_NEAR(speed(), 1500, 1e-6);
  machine.in.feedOvr = true;
  machine.in.feedOverride = 100;
  EXPECT_NEAR(speed(), 150, 1e-6);
  machine.in.feedMultiplier = 1000;
  machine.in.feedOverride = 1000;
  machine.in.externalRapid = true;
  EXPECT_NEAR(speed(), 6000, 1e-6);
  machine.in.rapidFeed = 4000;
  machine.in.externalRapidFeed = true;
  EXPECT_NEAR(speed(), 4000, 1e-6);
  machine.in.feedOverride = 2000; // no faster than rapid traverse (l.6542)
  EXPECT_NEAR(speed(), 6000, 1e-6);
}

TEST(ManualMotion, FeedPerRevolution) { // G95_AUTMAN, µm/rev
  ManualMachine machine({{"axis.4.SpeedAt10V", "360000"}, {"axis.4.Acceleration", "6000"}});
  machine.axes.axSpi(4, SpindleRole::Main);
  machine.axes.analogSpi(-kFullOutput, 4); // 1000 r/min
  machine.external();
  machine.in.externalPlus = 1;
  machine.in.externalFeed = machine.in.perRevolution = true;
  machine.in.feed = 250;
  machine.ticks(2000);
  EXPECT_NEAR(machine.axes.speedPerMinute(1), 250, 1e-6);
}

TEST(ManualMotion, NeedsItsEnable) { // l.10861-10869
  ManualMachine machine({{"axis.2.ManEnable", "2"}});
  machine.external();
  machine.in.externalPlus = 3;
  machine.in.enabled = 0;
  machine.scan(10);
  EXPECT_EQ(machine.out.motion, 3); // the request is there all the same
  EXPECT_EQ(machine.axes.measured(1), 0);
  EXPECT_EQ(machine.axes.measured(2), 0);
  machine.in.manualEnabled = 3;
  machine.scan(10);
  EXPECT_EQ(machine.axes.measured(1), 0);
  EXPECT_GT(machine.axes.measured(2), 0);
  machine.in.enabled = 1;
  machine.in.manualEnabled = 0;
  machine.scan(10);
  EXPECT_GT(machine.axes.measured(1), 0);
  EXPECT_EQ(machine.axes.speedPerMinute(2), 0);
}

TEST(ManualMotion, LeavesALimit) { // l.6692
  ManualMachine machine;
  machine.external();
  machine.in.externalPlus = 1;
  machine.scan(20);
  machine.in.limitPlus = 1;
  machine.scan(2);
  EXPECT_EQ(machine.axes.speedPerMinute(1), 0);
  machine.in.externalPlus = 0;
  machine.in.externalMinus = 1;
  machine.scan(10);
  EXPECT_LT(machine.axes.speedPerMinute(1), 0);
}

TEST(ManualMotion, EndsWithAutmanAndAtAFault) {
  for (const bool fault : {false, true}) {
    ManualMachine machine;
    machine.external();
    machine.in.externalPlus = 1;
    machine.scan(20);
    if (fault)
      machine.axes.fault();
    else
      machine.in.autmanReq = false;
    machine.scan(10);
    EXPECT_FALSE(machine.out.manual);
    EXPECT_EQ(machine.axes.speedPerMinute(1), 0);
    EXPECT_EQ(machine.out.motion, 0);
    machine.axes.startPlc();
    machine.scan(10);
    EXPECT_EQ(machine.out.manual, fault);
  }
}

TEST(ManualMotion, KeysOfThePanel) {
  ManualMachine machine;
  machine.key("RTMID_IMMM_MOVE00NEG", true); // switches AUTMAN on
  machine.scan(10);
  EXPECT_TRUE(machine.out.manual);
  EXPECT_TRUE(machine.out.panelControl);
  EXPECT_EQ(machine.out.manualMinus, 1);
  EXPECT_EQ(machine.out.manualPlus, 0);
  EXPECT_FALSE(machine.out.rapid);
  machine.key("RTMID_MMM_RAPIDTRAVERSE", true);
  machine.scan(200);
  EXPECT_TRUE(machine.out.rapid);
  EXPECT_EQ(machine.axes.speedPerMinute(1), -60000);
  machine.key("RTMID_MMM_RAPIDTRAVERSE", false);
  machine.key("RTMID_IMMM_MOVE00NEG", false);
  machine.key("RTMID_MMM_MOVEXNEGYRT", true);
  machine.scan(1);
  EXPECT_EQ(machine.out.manualMinus, 1);
  EXPECT_EQ(machine.out.manualPlus, 2);
  EXPECT_TRUE(machine.out.rapid);
  machine.key("RTMID_MMM_MOVEXNEGYRT", false);
  machine.scan(200);
  EXPECT_EQ(machine.out.motion, 0);
}

TEST(ManualMotion, KeysForThePreselectedAxis) {
  ManualMachine machine;
  machine.byPanel();
  machine.key("RTMID_MMM_SEL02", true);
  machine.scan();
  EXPECT_TRUE(machine.out.selecting);
  EXPECT_EQ(machine.out.manualPlus, 4); // for clamping, l.10850
  EXPECT_EQ(machine.out.motion, 0);
  EXPECT_EQ(machine.out.knobSelected[2], 1);
  machine.key("RTMID_MMM_MOVENEG", true);
  machine.scan(5);
  EXPECT_FALSE(machine.out.selecting);
  EXPECT_EQ(machine.out.manualMinus, 4);
  EXPECT_EQ(machine.out.motion, 4);
  machine.key("RTMID_MMM_MOVENEG", false);
  machine.scan(10);
  EXPECT_EQ(machine.out.motion, 0);
}

TEST(ManualMotion, HoldKeepsKeysPressed) {
  ManualMachine machine;
  machine.byPanel();
  machine.key("RTMID_MMM_HOLD", true);
  machine.key("RTMID_MMM_HOLD", false);
  machine.key("RTMID_MMM_MOVEZ", true);
  machine.key("RTMID_MMM_MOVEZ", false);
  machine.scan(20);
  EXPECT_EQ(machine.out.motion, 4);
  machine.key("RTMID_MMM_HOLD", true);
  machine.scan(20);
  EXPECT_EQ(machine.out.motion, 0);
}

TEST(ManualMotion, HandwheelMovesThePreselectedAxis) {
  ManualMachine machine;
  machine.external();
  machine.axes.handwheel(5); // nothing is preselected
  machine.scan();
  machine.in.externalSelect = true;
  machine.in.externalPlus = 2;
  machine.scan();
  EXPECT_TRUE(machine.out.selecting);
  machine.in.externalPlus = 0;
  machine.axes.handwheel(5);
  machine.scan();
  EXPECT_EQ(machine.out.motion, 2);
  machine.axes.handwheel(-7);
  machine.ticks(500);
  EXPECT_NEAR(machine.axes.measured(2), -0.2, 1e-9); // KNOB_STEP 100 µm
  EXPECT_EQ(machine.out.motion, 0);
  EXPECT_EQ(machine.axes.measured(1), 0);
}

TEST(ManualMotion, StepsOfTheHandwheel) { // l.17576-17598
  ManualMachine machine;
  machine.byPanel();
  machine.key("RTMID_MMM_SELX", true);
  machine.key("RTMID_MMM_KNOB_STEP50", true);
  machine.scan();
  EXPECT_EQ(machine.requests.knobStep, 50);
  machine.key("RTMID_MMM_KNOB_STEP_UP", true);
  machine.key("RTMID_MMM_KNOB_STEP_UP", true);
  machine.scan();
  EXPECT_EQ(machine.requests.knobStep, 200);
  for (int i = 0; i < 20; ++i) machine.key("RTMID_MMM_KNOB_STEP_DOWN", true);
  machine.scan();
  EXPECT_EQ(machine.requests.knobStep, 1);
  machine.key("RTMID_MMM_KNOB_DEC", true);
  machine.scan(5);
  EXPECT_NEAR(machine.axes.measured(1), -0.001, 1e-12);
  EXPECT_TRUE(machine.out.panelControl);
}

TEST(ManualMotion, UnknownCommandsAreRefused) {
  ManualMachine machine;
  for (const char* command : {"RTMID_MMM_MOVE16", "RTMID_MMM_MOVE1", "RTMID_MMM_FLY", "MOVE00", "RTMID_MMM_MOVE00X",
                              "RTMID_MMM_KNOB_STEP3", "RTMID_MMM_SEL", "RTMID_MMM_SEL00RT", ""})
    EXPECT_NE(machine.axes.rtm(command, true), "") << command;
}

TEST(ManualMotion, PositionOfTheStop) { // INPOS_STOP l.10871
  ManualMachine machine;
  machine.external();
  machine.in.externalPlus = 1;
  machine.scan(5);
  EXPECT_TRUE(machine.out.atStop); // no block
  machine.in.externalPlus = 0;
  machine.scan(20);
  machine.in.block = true;
  machine.scan(1);
  EXPECT_TRUE(machine.out.atStop);
  const double place = machine.axes.measured(1);
  machine.in.externalPlus = 1;
  machine.scan(10);
  EXPECT_FALSE(machine.out.atStop);
  machine.in.externalPlus = 0;
  machine.scan(20);
  EXPECT_FALSE(machine.out.atStop);
  machine.axes.setPhysical(1, place);
  machine.scan(1);
  EXPECT_TRUE(machine.out.atStop);
  machine.in.externalPlus = 1;
  machine.scan(1);
  machine.in.block = false;
  machine.scan(1);
  EXPECT_TRUE(machine.out.atStop);
}

TEST(ManualMotion, ShiftIsNotMeasured) { // l.11057-11127
  ManualMachine machine;
  machine.key("RTMID_MMM_SHIFT_REQ", true);
  machine.key("RTMID_MMM_SHIFT_ACT", true);
  machine.key("RTMID_MMM_SEL01", true);
  machine.scan();
  EXPECT_TRUE(machine.requests.shiftSelected);
  EXPECT_TRUE(machine.requests.shiftActive);
  EXPECT_EQ(machine.out.shiftControl, 2);
  EXPECT_EQ(machine.out.knobSelected[1], 2);
  machine.axes.handwheel(-3);
  machine.scan(20);
  EXPECT_EQ(machine.out.shift[1], -2400); // 300 µm in eighths
  EXPECT_NEAR(machine.out.shiftMm[1], -0.3, 1e-12);
  EXPECT_EQ(machine.axes.measured(2), 0);
  EXPECT_NEAR(machine.axes.physical(2), -0.3, 1e-12);
  machine.requests.shiftActive = false; // it stays, the choice of the axis goes
  machine.scan();
  EXPECT_EQ(machine.out.shiftControl, 0);
  EXPECT_EQ(machine.out.knobSelected[1], 0);
  EXPECT_EQ(machine.out.shift[1], -2400);
  machine.requests.shiftSelected = false; // it returns
  machine.scan(20);
  EXPECT_EQ(machine.out.shift[1], 0);
  EXPECT_EQ(machine.axes.physical(2), 0);
}

TEST(ManualMotion, ShiftNeedsItsBits) {
  ManualMachine machine;
  machine.in.shiftEnable = 0x3D;
  machine.requests.shiftActive = true;
  machine.key("RTMID_MMM_SEL00", true);
  machine.axes.handwheel(3);
  machine.scan(20);
  EXPECT_EQ(machine.out.shift[0], 0); // REQ_ESHIFT is missing
  machine.requests.shiftSelected = true;
  machine.key("RTMID_MMM_SEL01", true);
  machine.axes.handwheel(3);
  machine.scan(20);
  EXPECT_EQ(machine.out.shift[1], 0); // SHIFT_ENABLE is missing
  machine.key("RTMID_MMM_SEL00", true);
  machine.axes.handwheel(3);
  machine.scan(20);
  EXPECT_EQ(machine.out.shift[0], 2400);
}

TEST(ManualMotion, LeavesAxesOfOthersAlone) {
  ManualMachine machine;
  machine.axes.posInit(1, 0, true);
  machine.external();
  machine.in.externalPlus = 3;
  machine.scan(5);
  EXPECT_EQ(machine.axes.measured(1), 0);
  EXPECT_GT(machine.axes.measured(2), 0);
  machine.axes.posInit(2, 0, true); // manual motion has it
  EXPECT_EQ(machine.axes.posControl(2, 0, true).status, rung::io::kUnitError);
}

} // namespace

// Axes that positioning units move by pins (man. ch. 19). The program is that of the simulated units' scenarios.
#include <gmock/gmock.h>

#include <cmath>

#include "ir/support/temporary_folder.h"
#include "tests/unit/io/host_devices_axis_bench.h"

namespace {

using namespace testing;
using rung::test::AxisBench;

class PositionedAxis : public AxisBench, public Test {
protected:
  PositionedAxis() : AxisBench("device-units.plc") {}
  std::string reports() {
    std::string all;
    for (const std::string& line : devices.report()) all += line + '\n';
    return all;
  }
};

TEST_F(PositionedAxis, IsMovedByTheDistance) {
  beginWith();
  EXPECT_EQ(command(), 5);
  take();
  EXPECT_EQ((*this)["DISP"], 1);
  move(10'000);
  EXPECT_EQ((*this)["JEDE"], 1);
  EXPECT_EQ((*this)["PO_OS4PI"], 1);
  ms(400); // 10 mm: 0.1 s at 100 mm/s and the ramps
  EXPECT_EQ(command(), 15);
  EXPECT_EQ((*this)["POL"], 1);
  EXPECT_EQ((*this)["JEDE"], 0);
  EXPECT_EQ((*this)["PO_OS4PI"], 0);
  EXPECT_EQ((*this)["B_POL_EX+24:8"], 15'000 * int64_t{65536});
  move(-20'000);
  EXPECT_EQ((*this)["SM_PO4PI"], 1);
  ms(600);
  EXPECT_EQ(command(), -5);
  order("GIVE");
  EXPECT_EQ((*this)["DISP"], 0);
}

// Whatever the period of the thread, the command is bounded by feed and acceleration.
TEST_F(PositionedAxis, FollowsTheTrapezoidInEachStep) {
  beginWith();
  take();
  move(30'000);
  for (const int64_t ns : {250'000, 1'000'000, 2'000'000, 125'000}) {
    const double seconds = static_cast<double>(ns) / 1e9;
    double place = command(), speed = NAN;
    for (int i = 0; i < 100; ++i) {
      stepDrive(ns);
      const double now = (command() - place) / seconds;
      place = command();
      ASSERT_LE(now, 100 + 1e-6);
      if (!std::isnan(speed)) ASSERT_LE(std::fabs(now - speed), 500 * seconds + 1e-6);
      speed = now;
    }
  }
  ms(600);
  EXPECT_EQ(command(), 35);
}

TEST_F(PositionedAxis, ArrivesWhereTheAxisIs) { // MaxDifference, l.10180
  beginWith(", MaxDifference = 0.02");
  take();
  move(1'000);
  follows = false;
  real("position-feedback") = 5.97;
  ms(400);
  EXPECT_EQ(command(), 6);
  EXPECT_EQ((*this)["POL"], 0);
  EXPECT_EQ((*this)["PO_OS4PI"], 1);
  real("position-feedback") = 5.985;
  ms(40);
  EXPECT_EQ((*this)["POL"], 1);
}

TEST_F(PositionedAxis, IsHeldByTheProgram) {
  beginWith(", AccelerationEmergency = 4000");
  take();
  move(100'000);
  ms(400);
  const auto standsWhile = [&](const char* name, int64_t holds) {
    set(name, holds);
    ms(300);
    const double place = command();
    ms(100);
    EXPECT_EQ(command(), place) << name;
    EXPECT_EQ((*this)["PO_OS4PI"], name == std::string("ALLOW") ? 0 : 1); // l.6243
    set(name, 1 - holds);
    ms(100);
    EXPECT_GT(command(), place) << name;
  };
  standsWhile("MP4PI", 0);
  standsWhile("KH40", 1);
  standsWhile("ALLOW", 0);
}

TEST_F(PositionedAxis, TheNetRateIsCapped) { // FeedRT
  beginWith(", FeedRT = 3000");
  take();
  move(100'000);
  ms(300);
  const double place = command();
  ms(100);
  EXPECT_NEAR(command() - place, 5, 1e-6); // 50 mm/s
}

TEST_F(PositionedAxis, HasTheAttributesOfTheChannelsFile) {
  const rung::TemporaryFolder folder;
  const std::string file = folder / "Channel0.ChannelConfig";
  std::ofstream(file) << "<ChannelConfig><NCAxis No=\"3\" RefMethod=\"9\" FeedRT=\"1200\"></NCAxis></ChannelConfig>";
  ASSERT_EQ(devices.configure("PlcConfig", file), "");
  beginWith();
  take();
  move(100'000);
  ms(300);
  const double place = command();
  ms(100);
  EXPECT_NEAR(command() - place, 2, 1e-6); // 20 mm/s
}

TEST_F(PositionedAxis, WithoutAReferenceItIsRefused) {
  beginWith();
  bit("homed") = false;
  follows = false;
  real("position-feedback") = -3;
  ms(40);
  EXPECT_EQ(command(), -3) << "it is moved by somebody else";
  take();
  EXPECT_EQ((*this)["ERR"], 1);
  EXPECT_EQ((*this)["DISP"], 0);
  EXPECT_THAT(reports(), StrEq("axis 4: POS_INIT is refused: the axis has no reference\n"));
  take();
  EXPECT_EQ(reports(), "") << "it was said";
  bit("homed") = true;
  ms(1);
  EXPECT_EQ(command(), -3) << "without a jump";
  take();
  EXPECT_EQ((*this)["ERR"], 0);
  EXPECT_EQ((*this)["DISP"], 1);
}

TEST_F(PositionedAxis, APositionLoopThatIsOpenIsRefused) { // VAZBA_x, l.6306
  beginWith();
  EXPECT_TRUE(bit("enable"));
  set("VAZBA_4", 0);
  ms(40);
  EXPECT_FALSE(bit("enable"));
  take();
  EXPECT_EQ((*this)["ERR"], 1);
  EXPECT_THAT(reports(), HasSubstr("its position loop is open (VAZBA_x)"));
}

TEST_F(PositionedAxis, ADriveThatIsDisabledIsLost) {
  beginWith();
  take();
  move(100'000);
  ms(400);
  bit("enabled") = false;
  follows = false;
  real("position-feedback") = 20;
  ms(40);
  EXPECT_EQ(command(), 20);
  EXPECT_EQ((*this)["ERR"], 1);
  EXPECT_EQ((*this)["DISP"], 0);
  EXPECT_EQ((*this)["PO_OS4PI"], 0);
  EXPECT_THAT(reports(), StrEq("axis 4: the positioning unit has lost the axis: its drive is not enabled\n"));
  bit("enabled") = true;
  follows = true;
  ms(500);
  EXPECT_EQ(command(), 20) << "the motion is over";
  take();
  EXPECT_EQ((*this)["ERR"], 0);
}

TEST_F(PositionedAxis, AFaultBrakesIt) {
  beginWith(", AccelerationEmergency = 5000");
  take();
  move(100'000);
  ms(400);
  const double place = command();
  bit("fault") = true;
  ms(19); // 100 mm/s: 20 ms, 1 mm
  EXPECT_GT(command(), place + 0.9);
  ms(40);
  EXPECT_NEAR(command(), place + 1, 1e-9);
  EXPECT_EQ((*this)["ERR"], 1);
  EXPECT_THAT(reports(), HasSubstr("has lost the axis: its drive has a fault"));
}

TEST_F(PositionedAxis, FollowingError) { // l.10177
  beginWith(", FollowingErrorLimit = 2.5");
  take();
  move(100'000);
  follows = false;
  ms(60);
  EXPECT_EQ((*this)["ERR"], 0);
  ms(140);
  EXPECT_EQ((*this)["ERR"], 1);
  EXPECT_EQ((*this)["DISP"], 0);
  EXPECT_THAT(reports(), HasSubstr("its following error exceeds FollowingErrorLimit"));
}

TEST_F(PositionedAxis, ASpindleIsNoAxis) {
  beginWith();
  take();
  order("SPINDLE");
  EXPECT_EQ((*this)["DISP"], 0);
  EXPECT_EQ((*this)["ERR"], 1);
  take();
  EXPECT_EQ((*this)["ERR"], 1);
  EXPECT_THAT(reports(), HasSubstr("POS_INIT is refused: the axis is a spindle"));
}

TEST_F(PositionedAxis, AFaultOfTheProgramBrakesIt) {
  beginWith();
  take();
  move(100'000);
  ms(400);
  EXPECT_FALSE(devices.axesAtRest());
  const double place = command();
  order("FAULT");
  ms(300);
  EXPECT_TRUE(devices.axesAtRest());
  EXPECT_GT(command(), place + 10);
  EXPECT_LT(command(), place + 14); // a scan and 10 mm of ramp
  EXPECT_TRUE(bit("enable")) << "somebody holds it";
}

TEST_F(PositionedAxis, ComesToRestAtTheEnd) {
  beginWith();
  take();
  move(100'000);
  ms(400);
  const double place = command();
  int steps = 1;
  while (!devices.rest(1'000'000) && steps < 1000) {
    real("position-feedback") = command();
    ++steps;
  }
  EXPECT_EQ(steps, 200);
  EXPECT_NEAR(command(), place + 10, 1e-9);
  EXPECT_FALSE(bit("enable"));
}

// A place that is no number is that of a drive that does not work.
TEST_F(PositionedAxis, APlaceThatIsNoNumber) {
  beginWith();
  take();
  follows = false;
  real("position-feedback") = NAN;
  ms(40);
  EXPECT_EQ(command(), 5);
  EXPECT_EQ((*this)["ERR"], 1);
  EXPECT_EQ((*this)["B_POL_EX+24:8"], 5'000 * int64_t{65536});
}

TEST_F(PositionedAxis, OthersAreNotThere) {
  beginWith();
  set("TAKE_1", 1);
  set("AXIS", 1);
  ms(40);
  EXPECT_EQ((*this)["ERR"], 1);
  EXPECT_EQ((*this)["DISP"], 0);
  EXPECT_THAT(reports(), HasSubstr("POS_INIT: this host cannot move this axis for the program"));
}

TEST(AxisSettings, Mistakes) {
  rung::io::HostDevices devices;
  rung::host::File map =
      rung::test::faultlessMap("[in]\n\"a.homed\" = { type = \"bit\", name = \"ALLOW\" }\n[devices.axes]\n4 = \"a\"\n"
                               "5 = { pins = \"b\", FeedRT = 0, RefSpeed = 5, MaxDifference = -1 }\n6 = \"b\"\n"
                               "[devices.config]\n\"axis.17.FeedRT\" = 5\n");
  std::vector<std::string> errors;
  devices.set(map, errors);
  devices.addAxisPins(map, errors);
  EXPECT_THAT(
      errors,
      ElementsAre(
          HasSubstr("m.map:5:28: devices: 'FeedRT' needs a number above 0; found '0'"),
          HasSubstr("m.map:5:42: devices: 'RefSpeed' is not an attribute of an axis here; there are Acceleration, "),
          HasSubstr("m.map:5:61: devices: MaxDifference takes 0 to 1e9 mm, not '-1'"),
          HasSubstr("m.map:8:20: devices: 'axis.17.FeedRT' needs an axis from 1 to 16"),
          HasSubstr("m.map:4:5: devices.axes: found a pin a.homed in line 2 already, which axis 4 is to have"),
          HasSubstr("m.map:6:5: devices.axes: found a pin b.position-feedback already, which axis 6 is to have")));
}

} // namespace

// Drives by CiA 402 and the servos that order them by the bits flEdrv…N (TECHNOL manual 13.18, l.10216-10479).
#include <gtest/gtest.h>

#include <limits>

#include "sim/technol/devices/ethercat_servo.h"
#include "tests/unit/io/ethercat_net.h"

namespace {

using namespace rung::sim::technol;
using rung::test::EthercatNet;

// ---- the drive ---------------------------------------------------------------------------------------------------

TEST(Ds402, UpAndDown) {
  Ds402Drive drive;
  const auto after = [&](uint16_t control) {
    drive.step(control);
    return drive.status();
  };
  EXPECT_EQ(drive.status(), 0x40);
  EXPECT_EQ(after(0x0F), 0x40); // not before 06h
  EXPECT_EQ(after(0x06), 0x21);
  EXPECT_EQ(after(0x07), 0x23);
  EXPECT_EQ(after(0x0F), 0x27);
  EXPECT_EQ(after(0x0F), 0x27);
  EXPECT_EQ(after(0x07), 0x23);
  EXPECT_EQ(after(0x06), 0x21);
  EXPECT_EQ(after(0x0F), 0x23); // one state a step
  EXPECT_EQ(after(0x0F), 0x27);
  EXPECT_EQ(after(0x02), 0x07); // quick stop
  EXPECT_EQ(after(0x00), 0x40);
}

TEST(Ds402, AFaultStaysUntilTheResetRises) {
  Ds402Drive drive;
  for (const uint16_t control : {0x06, 0x07, 0x8F}) drive.step(control);
  drive.fault(0x7310);
  drive.step(0x8F); // has been there before
  EXPECT_EQ(drive.status(), 0x08);
  EXPECT_EQ(drive.error(), 0x7310);
  drive.step(0x0F);
  EXPECT_EQ(drive.status(), 0x08);
  drive.step(0x8F);
  EXPECT_EQ(drive.status(), 0x40); // and 0Fh does not enable it
  EXPECT_EQ(drive.error(), 0);
  drive.step(0x0F);
  EXPECT_EQ(drive.status(), 0x40);
  drive.fault(0);
  EXPECT_EQ(drive.status(), 0x40);
}

TEST(Ds402, AsASlave) {
  EthercatNet net{{"ethercat.0", "coe"}, {"ethercat.0.ds402", "1"}};
  ASSERT_EQ(net.problems, "");
  net.ticks(1);
  EXPECT_EQ(net.net.object(0, 0x6041, 0), 0x40u);
  for (const auto& [control, status] : {std::pair{0x06, 0x21u}, {0x07, 0x23u}, {0x0F, 0x27u}}) {
    ASSERT_EQ(net.download(0, 0x6040, 0, {static_cast<uint8_t>(control), 0}), 0u);
    EXPECT_EQ(net.net.object(0, 0x6041, 0), status);
  }
  ASSERT_EQ(net.net.fault(0, 0x7310), "");
  net.ticks(1);
  EXPECT_EQ(net.net.object(0, 0x6041, 0), 0x08u);
  EXPECT_EQ(net.net.object(0, 0x603F, 0), 0x7310u);
  EXPECT_EQ(net.download(0, 0x6041, 0, {0, 0}), 0x06010002u);
}

void enable(EthercatNet& net) {
  for (const uint8_t control : {0x06, 0x07, 0x0F}) ASSERT_EQ(net.download(0, 0x6040, 0, {control, 0}), 0u);
}

TEST(Ds402, AMotorGoesToItsTarget) {
  EthercatNet net{{"ethercat.0", "coe"}, {"ethercat.0.ds402", "1"}, {"ethercat.0.motor", "position"}};
  ASSERT_EQ(net.problems, "");
  net.net.setObject(0, 0x607A, 0, 0xFFFFFFFB);
  net.ticks(1);
  EXPECT_EQ(net.net.object(0, 0x6064, 0), 0u); // not enabled
  enable(net);
  EXPECT_EQ(net.net.object(0, 0x6064, 0), 0xFFFFFFFBu);
  EXPECT_EQ(net.download(0, 0x6064, 0, {1, 0, 0, 0}), 0x06010002u);
}

TEST(Ds402, AMotorKeepsAVelocity) {
  EthercatNet net{{"ethercat.0", "coe"}, {"ethercat.0.ds402", "1"}, {"ethercat.0.motor", "velocity"}};
  ASSERT_EQ(net.problems, "");
  enable(net);
  net.net.setObject(0, 0x60FF, 0, static_cast<uint32_t>(-1500));
  net.ticks(1);
  EXPECT_EQ(net.net.object(0, 0x6064, 0), 0xFFFFFFFFu);
  net.ticks(1); // what is less than an increment counts
  EXPECT_EQ(net.net.object(0, 0x6064, 0), 0xFFFFFFFDu);
  ASSERT_EQ(net.net.fault(0, 0x7310), "");
  net.ticks(5);
  EXPECT_EQ(net.net.object(0, 0x6064, 0), 0xFFFFFFFDu);
}

TEST(Ds402, AMotorNeedsADrive) {
  EthercatNet net{{"ethercat.0", "coe"}, {"ethercat.0.motor", "velocity"}};
  EXPECT_NE(net.problems.find("a motor needs a drive"), std::string::npos) << net.problems;
  EthercatNet other{{"ethercat.0", "coe"}, {"ethercat.0.ds402", "1"}, {"ethercat.0.motor", "1"}};
  EXPECT_NE(other.problems.find("position or velocity"), std::string::npos) << other.problems;
}

// ---- the servo ---------------------------------------------------------------------------------------------------

struct Servo : testing::Test {
  void scans(int count) {
    for (int i = 0; i < 20 * count; ++i) servos.tick(cells);
  }
  // Scans until the bit is reset; 100: it stays.
  int until(bool ServoCells::* bit) {
    servo.*bit = true;
    int count = 0;
    for (; count < 100 && servo.*bit; ++count) scans(1);
    return count;
  }
  EthercatServos servos;
  EthercatServos::Cells cells;
  ServoCells& servo = cells[3];
};

// The example of l.10434-10479, one request after the other.
TEST_F(Servo, ASimulatedDriveFollowsTheRequests) {
  servo.isSimulated = true;
  EXPECT_EQ(until(&ServoCells::init), 1);
  EXPECT_EQ(servo.state, ServoState::Init);
  EXPECT_EQ(servo.control, 0);
  EXPECT_TRUE(servo.blocksMotion);

  servo.on = true;
  scans(1);
  EXPECT_EQ(servo.control, 0x06);
  scans(1);
  EXPECT_EQ(servo.status, 0x21);
  EXPECT_EQ(servo.control, 0x07); // ON, VOLT, QSTOP (l.10362)
  EXPECT_TRUE(servo.on);
  EXPECT_EQ(servo.state, ServoState::Init);
  scans(1);
  EXPECT_EQ(servo.status, 0x23);
  EXPECT_FALSE(servo.on);
  EXPECT_EQ(servo.state, ServoState::On);

  EXPECT_EQ(until(&ServoCells::enable), 2);
  EXPECT_EQ(servo.control, 0x0F);
  EXPECT_EQ(servo.status, 0x27);
  EXPECT_EQ(servo.state, ServoState::Enable);
  EXPECT_FALSE(servo.blocksMotion);

  EXPECT_EQ(until(&ServoCells::disable), 2);
  EXPECT_EQ(servo.control, 0x07);
  EXPECT_EQ(servo.status, 0x23);
  EXPECT_EQ(servo.state, ServoState::On);
  EXPECT_TRUE(servo.blocksMotion);

  EXPECT_EQ(until(&ServoCells::done), 2);
  EXPECT_EQ(servo.control, 0);
  EXPECT_EQ(servo.status, 0x40);
  EXPECT_EQ(servo.state, ServoState::Done);
}

TEST_F(Servo, NobodyAnswersForADriveThatIsNotThere) {
  servo.control = 0x55;
  EXPECT_EQ(until(&ServoCells::init), 100);
  EXPECT_EQ(servo.control, 0x55);
  EXPECT_FALSE(servo.blocksMotion || servo.isFaulty);
}

TEST_F(Servo, EnableWithoutOnWaits) {
  servo.isSimulated = true;
  EXPECT_EQ(until(&ServoCells::enable), 100);
  EXPECT_EQ(servo.status, 0x40);
  EXPECT_EQ(until(&ServoCells::disable), 1); // it is not enabled; and the drive is not switched on by it
  EXPECT_EQ(servo.status & 0x6F, 0x40);
  EXPECT_EQ(servo.state, ServoState::Done);
}

TEST_F(Servo, StoppingComesFirst) {
  servo.isSimulated = true;
  until(&ServoCells::on);
  until(&ServoCells::enable);
  servo.on = servo.enable = servo.disable = servo.done = true;
  scans(2);
  EXPECT_EQ(servo.status, 0x40);
  EXPECT_FALSE(servo.done);
}

TEST_F(Servo, OnOfAnEnabledDriveDisablesIt) {
  servo.isSimulated = true;
  until(&ServoCells::on);
  until(&ServoCells::enable);
  EXPECT_EQ(until(&ServoCells::on), 2);
  EXPECT_EQ(servo.status, 0x23);
}

// A drive on the net: its status word is read, its control word written, by connections.
TEST_F(Servo, AFaultIsErased) {
  EthercatNet net{{"ethercat.0", "coe"}, {"ethercat.0.ds402", "1"}};
  servo.isConnected = true;
  const auto scan = [&] {
    net.net.setObject(0, 0x6040, 0, servo.control);
    net.scans(1);
    servo.status = static_cast<uint16_t>(*net.net.object(0, 0x6041, 0));
    servo.error = static_cast<uint16_t>(*net.net.object(0, 0x603F, 0));
    scans(1);
  };
  const auto request = [&](bool ServoCells::* bit) {
    servo.*bit = true;
    for (int i = 0; i < 10 && servo.*bit; ++i) scan();
    return !(servo.*bit);
  };
  ASSERT_TRUE(request(&ServoCells::on) && request(&ServoCells::enable));
  ASSERT_EQ(net.net.fault(0, 0x7310), "");
  scan();
  EXPECT_TRUE(servo.isFaulty);
  EXPECT_TRUE(servo.blocksMotion);
  EXPECT_EQ(servo.error, 0x7310);
  EXPECT_EQ(servo.state, ServoState::Enable);
  servo.erase = true;
  scan();
  EXPECT_EQ(servo.control & 0x80, 0x80);
  scan();
  EXPECT_FALSE(servo.erase || servo.isFaulty);
  EXPECT_EQ(servo.control & 0x80, 0);
  EXPECT_EQ(servo.status, 0x40); // it has to be switched on again
  EXPECT_EQ(servo.state, ServoState::Enable);
  EXPECT_TRUE(request(&ServoCells::on) && request(&ServoCells::enable));
  EXPECT_FALSE(servo.blocksMotion);
}

TEST_F(Servo, ThePulseIsRepeatedWhileTheFaultLasts) {
  servo.isConnected = servo.erase = true;
  servo.status = 0x08;
  std::string seen;
  for (int i = 0; i < 4; ++i) {
    scans(1);
    seen += (servo.control & 0x80) != 0 ? '1' : '0';
  }
  EXPECT_EQ(seen, "1010");
  EXPECT_TRUE(servo.erase);
  servo.status = 0x40;
  scans(1);
  EXPECT_FALSE(servo.erase);
}

// ---- positions and velocities --------------------------------------------------------------------------------------

TEST_F(Servo, ADriveThatIsNotEnabledIsAskedToStay) { // l.10346
  servo.isConnected = true;
  servo.status = 0x23;
  servo.position = -700;
  servo.place = 5;
  scans(1);
  EXPECT_EQ(servo.requestedPosition, -700);
  servo.place = 6;
  servo.position = -650;
  scans(1);
  EXPECT_EQ(servo.requestedPosition, -650);
  EXPECT_EQ(servo.requestedVelocity, 0);
  EXPECT_EQ(servo.followingError(), 0);
}

TEST_F(Servo, AnEnabledDriveIsAskedToGoWithItsAxis) { // l.10337-10349
  servo.isConnected = true;
  servo.status = 0x27;
  servo.position = 100;
  servo.place = 5;
  scans(1); // enabled from the beginning: it need not jump
  EXPECT_EQ(servo.requestedPosition, 100);
  servo.place = 5.25;
  scans(1);
  EXPECT_EQ(servo.requestedPosition, 350);
  EXPECT_EQ(servo.requestedVelocity, 250 * 50);
  EXPECT_EQ(servo.followingError(), 250);
  servo.velocityScale = -0.5;
  servo.place = 5;
  scans(1);
  EXPECT_EQ(servo.requestedPosition, 100);
  EXPECT_EQ(servo.requestedVelocity, 125 * 50);
  scans(1);
  EXPECT_EQ(servo.requestedVelocity, 0);
}

TEST_F(Servo, PositionsWrapAsTheirCellsDo) {
  servo.isConnected = true;
  servo.status = 0x27;
  servo.position = 0x7FFF'FFFF;
  scans(1);
  servo.place = 0.001;
  scans(1);
  EXPECT_EQ(servo.requestedPosition, std::numeric_limits<int32_t>::min());
  EXPECT_EQ(servo.requestedVelocity, 50);
  EXPECT_EQ(servo.followingError(), 1);
  servo.velocityScale = 1e12;
  servo.place = 0.002;
  scans(1);
  EXPECT_EQ(servo.requestedVelocity, std::numeric_limits<int32_t>::max());
}

TEST_F(Servo, IncrementsOfTheTrajectoryMode) { // l.10187-10191
  ASSERT_EQ(servos.configure("servo.3.ServoType", "28"), "");
  ASSERT_EQ(servos.configure("servo.3.measconstnumerator", "1"), "");
  ASSERT_EQ(servos.configure("servo.3.MeasConstDenominator", "16384"), "");
  EXPECT_EQ(servos.incrementsPerUm(3), 4);
  EXPECT_EQ(servos.incrementsPerUm(2), 1);
  servo.incrementsPerUm = 4;
  servo.isSimulated = true;
  servo.place = -0.5;
  scans(1);
  EXPECT_EQ(servo.position, -2000);
  EXPECT_EQ(servo.micrometres(servo.position), -500);
}

TEST_F(Servo, IncrementsOfTheSpeedMode) { // l.8565-8567
  ASSERT_EQ(servos.configure("servo.0.MeasConstNumerator", "5"), "");
  EXPECT_EQ(servos.incrementsPerUm(0), 0.2);
  ASSERT_EQ(servos.configure("servo.0.MeasConstDenominator", "2"), "");
  ASSERT_EQ(servos.configure("servo.0.ServoType", "1"), "");
  EXPECT_EQ(servos.incrementsPerUm(0), 0.4);
  ASSERT_EQ(servos.configure("servo.0.MeasConstNumerator", "-5"), "");
  EXPECT_EQ(servos.incrementsPerUm(0), -0.4);
  ASSERT_EQ(servos.configure("servo.0.MeasConstNumerator", "0"), "");
  EXPECT_EQ(servos.incrementsPerUm(0), 2);
}

TEST_F(Servo, WrongAttributes) {
  EXPECT_NE(servos.configure("servo.16.ServoType", "28").find("a servo from 0 to 15"), std::string::npos);
  EXPECT_NE(servos.configure("servo.x", "28").find("a servo from 0 to 15"), std::string::npos);
  EXPECT_NE(servos.configure("servo.0.Gain", "1").find("not 'Gain'"), std::string::npos);
  for (const char* wrong : {"1.5", "2147483648", "", "x"})
    EXPECT_NE(servos.configure("servo.0.MeasConstNumerator", wrong).find("needs a whole number"), std::string::npos)
        << wrong;
  EXPECT_EQ(servos.incrementsPerUm(0), 1);
}

TEST_F(Servo, ASimulatedDriveGoesAScanLater) {
  servo.isSimulated = true;
  servo.place = 3;
  until(&ServoCells::on);
  EXPECT_EQ(servo.position, 3000);
  servo.place = 4; // not enabled
  scans(1);
  EXPECT_EQ(servo.position, 3000);
  until(&ServoCells::enable);
  servo.place = 4.5;
  scans(1);
  EXPECT_EQ(servo.requestedPosition, 3500);
  EXPECT_EQ(servo.position, 3000);
  scans(1);
  EXPECT_EQ(servo.position, 3500);
}

TEST_F(Servo, PowerOff) {
  servo.isSimulated = true;
  until(&ServoCells::on);
  until(&ServoCells::enable);
  servos.powerOn();
  servo = {.isSimulated = true}; // so do the cells
  scans(1);
  EXPECT_EQ(servo.status, 0x40);
  EXPECT_EQ(servo.control, 0);
}

} // namespace

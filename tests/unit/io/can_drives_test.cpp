// Drives on CAN channel 1 (man. 13.14).
#include "tests/unit/io/can_rig.h"

namespace {

using namespace rung::io;
using rung::test::CanRig;

struct Drives : testing::Test, CanRig {
  Drives() {
    configure("CAN[0].Drives", "3");
    configure("drive.2.sdo.0x2003.1", "680/2");
    configure("drive.2.sdo.0x2004.0", "-1/1 ro");
    configure("drive.2.sdo.0x2005.0", "7/4 wo");
    configure("drive.3.type", "unidrive");
    configure("drive.3.sdo.0x2006.16", "0/1");
    devices.power();
    run();
  }
  uint16_t& command(uint32_t drive) { return in.drives.command[drive - 1]; }
  uint16_t status(uint32_t drive) const { return out.drives.status[drive - 1]; }
  CanPacket ask(uint32_t axis, std::initializer_list<uint8_t> data) {
    CanPacket packet = packetOf(0xFFFF, data);
    devices.control().sendToDrive(axis, packet);
    EXPECT_EQ(devices.control().driveBusy(), 0xFF);
    EXPECT_EQ(packet.id, 0x600 + axis); // filled in, l.9488
    EXPECT_EQ(packet.remote, 0);
    EXPECT_EQ(packet.length, 8);
    run();
    EXPECT_EQ(devices.control().driveBusy(), 0);
    return devices.control().driveAnswer();
  }
};

TEST_F(Drives, BrakedEnabledNotEnabled) { // l.9377-9384
  EXPECT_EQ(status(1), 0x33) << "not enabled";
  command(1) = kDriveEnable;
  run();
  EXPECT_EQ(status(1), 0x37);
  EXPECT_EQ(status(2), 0x33);
  command(1) = kDriveEnable | kDriveBrake;
  run();
  EXPECT_EQ(status(1), 0x50) << "the brake counts, whatever EN is";
  command(1) = kDriveBrake;
  run();
  EXPECT_EQ(status(1), 0x50);
  command(1) = kDriveEnable;
  run();
  EXPECT_EQ(status(1), 0x37);
  command(1) = 0;
  run();
  EXPECT_EQ(status(1), 0x33);
}

TEST_F(Drives, NoDriveHasNoStatus) {
  command(4) = kDriveEnable;
  run();
  EXPECT_EQ(status(4), 0);
  EXPECT_EQ(out.drives.manufacturer[3], 0);
}

TEST_F(Drives, FaultStaysUntilItIsReset) {
  command(2) = kDriveEnable;
  run();
  EXPECT_EQ(devices.driveEvent(2, {.fault = 0x8611}), "");
  run();
  EXPECT_EQ(status(2), 0x08);
  DriveMessage message;
  ASSERT_TRUE(devices.control().takeMessage(message));
  EXPECT_EQ(message.number, 4217); // l.9649
  EXPECT_EQ(message.drive, 2);
  EXPECT_EQ(message.fault, 39); // lag error, l.9732
  EXPECT_EQ(message.emergency, 0x8611);
  EXPECT_FALSE(devices.control().takeMessage(message));
  EXPECT_EQ(devices.driveObject(2, 0x603F, 0), 0x8611u);
  EXPECT_EQ(devices.driveObject(2, 0x1001, 0), 1u);

  command(2) = 0; // neither of these resets it
  run();
  command(2) = kDriveEnable;
  run();
  EXPECT_EQ(status(2), 0x08);
  EXPECT_EQ(ask(2, {0x2B, 0x40, 0x60, 0, 0x80, 0, 0, 0}), packetOf(0x582, {0x60, 0x40, 0x60, 0, 0, 0, 0, 0}));
  EXPECT_EQ(status(2), 0x33) << "not enabled until the program takes EN back";
  run(100);
  EXPECT_EQ(status(2), 0x33);
  command(2) = 0;
  run();
  command(2) = kDriveEnable;
  run();
  EXPECT_EQ(status(2), 0x37);
  EXPECT_EQ(devices.driveObject(2, 0x603F, 0), 0u);
}

TEST_F(Drives, FaultWhoseCauseStays) {
  EXPECT_EQ(devices.driveEvent(1, {.fault = 0x3110, .hold = true}), "");
  run();
  ask(1, {0x2B, 0x40, 0x60, 0, 0x80, 0, 0, 0});
  EXPECT_EQ(status(1), 0x08);
  EXPECT_EQ(devices.driveEvent(1, {.fault = 0}), "");
  run();
  EXPECT_EQ(status(1), 0x08) << "the cause is gone, the fault is not";
  ask(1, {0x2B, 0x40, 0x60, 0, 0x80, 0, 0, 0});
  EXPECT_EQ(status(1), 0x33);
}

TEST_F(Drives, UnknownEmergencyHasNoNumber) {
  EXPECT_EQ(devices.driveEvent(1, {.fault = 0x1234}), "");
  run();
  DriveMessage message;
  ASSERT_TRUE(devices.control().takeMessage(message));
  EXPECT_EQ(message.fault, 0);
}

TEST_F(Drives, ManufacturerStatusWarns) { // l.9339-9369
  EXPECT_EQ(devices.driveEvent(1, {.mstat = 0x0104}), "");
  run();
  EXPECT_EQ(out.drives.manufacturer[0], 0x0104);
  EXPECT_EQ(status(1), 0x33 | kDriveWarning);
}

TEST_F(Drives, ObjectsBySdo) { // l.9480-9602
  EXPECT_EQ(ask(2, {0x40, 0x03, 0x20, 1}), packetOf(0x582, {0x4B, 0x03, 0x20, 1, 0xA8, 0x02, 0, 0}));
  EXPECT_EQ(ask(2, {0x2B, 0x03, 0x20, 1, 0x34, 0x12}), packetOf(0x582, {0x60, 0x03, 0x20, 1, 0, 0, 0, 0}));
  EXPECT_EQ(devices.driveObject(2, 0x2003, 1), 0x1234u);
  EXPECT_EQ(ask(2, {0x40, 0x04, 0x20, 0}), packetOf(0x582, {0x4F, 0x04, 0x20, 0, 0xFF, 0, 0, 0}));
  EXPECT_EQ(ask(2, {0x2F, 0x04, 0x20, 0, 1}), packetOf(0x582, {0x80, 0x04, 0x20, 0, 2, 0, 1, 6})) << "read only";
  EXPECT_EQ(ask(2, {0x40, 0x05, 0x20, 0}), packetOf(0x582, {0x80, 0x05, 0x20, 0, 1, 0, 1, 6})) << "write only";
  EXPECT_EQ(ask(2, {0x23, 0x03, 0x20, 1, 1}), packetOf(0x582, {0x80, 0x03, 0x20, 1, 0x10, 0, 7, 6})) << "length";
  EXPECT_EQ(ask(1, {0x40, 0x03, 0x20, 1}), packetOf(0x581, {0x80, 0x03, 0x20, 1, 0, 0, 2, 6})) << "no object";
  EXPECT_EQ(ask(1, {0x40, 0x00, 0x10, 0}), packetOf(0x581, {0x43, 0x00, 0x10, 0, 0x92, 1, 2, 0}));
  EXPECT_EQ(ask(1, {0x40, 0x41, 0x60, 0}), packetOf(0x581, {0x4B, 0x41, 0x60, 0, 0x33, 0, 0, 0}));
  EXPECT_EQ(received(1).id, 0xFFFF) << "answers to CAN_AX_SEND are in CAN_AX_RECV_PACKET alone";
  devices.power();
  EXPECT_EQ(devices.driveObject(2, 0x2003, 1), 680u);
}

TEST_F(Drives, SilentDrive) {
  CanPacket packet = packetOf(0, {0x40, 0, 0x10, 0});
  EXPECT_EQ(devices.driveEvent(1, {.silent = true}), "");
  devices.control().sendToDrive(1, packet);
  run(99);
  EXPECT_EQ(devices.control().driveBusy(), 0xFF);
  EXPECT_EQ(status(1), 0x33);
  run(1);
  EXPECT_EQ(status(1), 0);
  DriveMessage message;
  ASSERT_TRUE(devices.control().takeMessage(message));
  EXPECT_EQ(message.number, 4219);
  EXPECT_EQ(message.drive, 1);
  run(500);
  EXPECT_FALSE(devices.control().takeMessage(message)) << "once";
  EXPECT_EQ(devices.driveEvent(1, {.silent = false}), "");
  run();
  EXPECT_EQ(status(1), 0x33);
  EXPECT_EQ(devices.control().driveBusy(), 0xFF);
  devices.control().sendToDrive(1, packet); // the program repeats it, l.9541
  run();
  EXPECT_EQ(devices.control().driveBusy(), 0);
}

TEST_F(Drives, TheSecondQuestionTakesThePlaceOfTheFirst) {
  CanPacket packet = packetOf(0, {0x40, 0, 0x10, 0});
  devices.control().sendToDrive(7, packet); // no such drive
  run();
  EXPECT_EQ(devices.control().driveBusy(), 0xFF);
  devices.control().sendToDrive(2, packet);
  run();
  EXPECT_EQ(devices.control().driveBusy(), 0);
  EXPECT_EQ(devices.control().driveAnswer().id, 0x582);
}

TEST_F(Drives, TheProgramsOwnSdoIsAnsweredToo) {
  EXPECT_EQ(devices.control().channel(1).send(packetOf(0x602, {0x40, 0x03, 0x20, 1, 0, 0, 0, 0})), CanError::Ok);
  run();
  EXPECT_EQ(received(1), packetOf(0x582, {0x4B, 0x03, 0x20, 1, 0xA8, 0x02, 0, 0}));
}

TEST_F(Drives, Unidrive) { // l.9386-9441
  constexpr uint16_t kMask0 = 0x0200;
  EXPECT_EQ(status(3), 0x05) << "healthy, zero speed";
  command(3) = 0x0001; // without its mask the bit does not count
  run();
  EXPECT_EQ(status(3), 0x05);
  command(3) = kMask0 | 0x0001;
  run();
  EXPECT_EQ(status(3), 0x2F);
  command(3) = 0; // the mask is taken away: the drive stays as it is
  run();
  EXPECT_EQ(status(3), 0x2F);
  command(3) = kMask0;
  run();
  EXPECT_EQ(status(3), 0x05);
}

TEST_F(Drives, UnidriveTrip) {
  command(3) = 0x0010;
  run();
  EXPECT_EQ(status(3), 0x04);
  DriveMessage message;
  ASSERT_TRUE(devices.control().takeMessage(message));
  EXPECT_EQ(message.emergency, 52);
  EXPECT_FALSE(devices.control().takeMessage(message)) << "once for the edge";
  command(3) = 0;
  ask(3, {0x2B, 0x40, 0x60, 0, 0x80, 0, 0, 0});
  EXPECT_EQ(status(3), 0x05);
}

TEST_F(Drives, BusOff) {
  command(1) = kDriveEnable;
  run();
  EXPECT_EQ(devices.busEvent(1, true), "");
  run(100);
  EXPECT_EQ(status(1), 0);
  EXPECT_EQ(devices.control().channel(1).send(packetOf(1, {})), CanError::SendQueueFull);
  EXPECT_EQ(devices.busEvent(1, false), "");
  run();
  EXPECT_EQ(status(1), 0x33) << "enabled again by a new command";
}

TEST_F(Drives, PowerOff) {
  command(1) = kDriveEnable;
  run();
  EXPECT_EQ(devices.driveEvent(1, {.fault = 0x3110, .hold = true}), "");
  devices.power();
  in = {};
  out = {};
  run();
  EXPECT_EQ(status(1), 0x33);
  EXPECT_EQ(devices.control().driveBusy(), 0);
}

TEST(DriveConfiguration, Mistakes) {
  CanRig rig;
  EXPECT_NE(rig.devices.configure("drive.1.type", "unidrive").value_or(""), "") << "there is no drive yet";
  rig.configure("CAN[0].Drives", "16");
  const std::pair<std::string_view, std::string_view> mistakes[] = {{"CAN[0].Drives", "17"},
                                                                    {"drive.17.type", "unidrive"},
                                                                    {"drive.0.type", "unidrive"},
                                                                    {"drive.1.type", "other"},
                                                                    {"drive.1.speed", "1"},
                                                                    {"drive.1.sdo.0x2003", "1/2"},
                                                                    {"drive.1.sdo.0x10000.1", "1/2"},
                                                                    {"drive.1.sdo.0x2003.256", "1/2"},
                                                                    {"drive.1.sdo.0x2003.1", "1"},
                                                                    {"drive.1.sdo.0x2003.1", "1/3"},
                                                                    {"drive.1.sdo.0x2003.1", "256/1"},
                                                                    {"drive.1.sdo.0x2003.1", "-129/1"},
                                                                    {"drive.1.sdo.0x2003.1", "1/2 rw"},
                                                                    {"drive.1.sdo.0x2003.1", "x/2"}};
  for (const auto& [key, value] : mistakes)
    EXPECT_NE(rig.devices.configure(key, value).value_or(""), "") << key << value;
  EXPECT_NE(rig.devices.driveEvent(17, {}), "");
  EXPECT_EQ(rig.devices.driveObject(1, 0x2003, 1), std::nullopt);
}

} // namespace

// INOUT08, panels and handwheels on CAN channel 2 (man. ch. 9).
#include <gmock/gmock.h>

#include "machine/io/can/unit.h"
#include "rtlib/nc/technol/signals.h"
#include "tests/unit/io/can_rig.h"

namespace {

using namespace rung::io;
using namespace rung::io::inouts;
using rung::test::CanRig;

struct Units : testing::Test, CanRig {
  Units() {
    configure("CAN[1].InOut08Cnt", "2");
    configure("CAN[1].Kla50Cnt", "1");
    configure("CAN[1].KnobCnt", "1");
    devices.power();
    run(40); // they are mapped, started and asked what they are
  }
  // The answer to a packet of the program.
  CanPacket ask(const CanPacket& packet) {
    EXPECT_EQ(devices.control().channel(2).send(packet), CanError::Ok);
    run(2);
    return received(2);
  }
  void tell(std::initializer_list<uint8_t> order) { // network management
    EXPECT_EQ(devices.control().channel(2).send(packetOf(0, order)), CanError::Ok);
    run(1);
  }
  CanPacket readObject(uint32_t node, sdo::Object object) { return ask(sdo::read(node, object)); }
  GroupCodes codes(uint32_t group) const { return out.units.groups[group - 1]; }
};

// Offsets are those of the signals' table, which a program's items are read from.
TEST(Inouts, OffsetsAreThoseOfTheSignals) {
  const std::pair<std::string_view, InoutsItem> expected[] = {{"SIZE", kSize},
                                                              {"PRESENT", kPresent},
                                                              {"MODE", kMode},
                                                              {"VENDORID", kVendor},
                                                              {"DEVICENAME", kDeviceName},
                                                              {"HWVERSION", kHardwareVersion},
                                                              {"IN0", {kIn}},
                                                              {"IN3", {kIn + 3}},
                                                              {"OUT0", {kOut}},
                                                              {"OUT2", {kOut + 2}},
                                                              {"ANL0", {kAnalogue}},
                                                              {"ANL7", {kAnalogue + 7}},
                                                              {"ERROR", kError},
                                                              {"ERR_CODE", kErrorCode},
                                                              {"ERR_STAT", kErrorStatus},
                                                              {"CONTROL", kControl},
                                                              {"COUNT", kCount},
                                                              {"SEND_REQ", kSendRequest},
                                                              {"SEND", {kSend, 12}},
                                                              {"RESP", {kAnswer, 12}},
                                                              {"SHORT_OUT0", {kShort}},
                                                              {"PxIN", kFirstIn},
                                                              {"PxOUT", kFirstOut},
                                                              {"RPDO_COUNT", kRpdoCount},
                                                              {"MODE_ACT", kModeNow},
                                                              {"TL0", {kKeys}},
                                                              {"IRC1", {kEncoder + 2, 2}},
                                                              {"TPDO_COUNT", kTpdoCount},
                                                              {"RESP_COUNT", kAnswerCount},
                                                              {"SWVERSION", kSoftwareVersion},
                                                              {"MODE_FAZE", kModePhase},
                                                              {"SHORT_SEND_REQ", kShortRequest}};
  uint32_t found = 0, size = 0;
  for (const rung::nc::Signal& signal : rung::nc::technolSignals()) {
    if (std::string_view(signal.area) != "INOUTS") continue;
    size = std::max(size, signal.byteOffset + signal.strideBytes * signal.count);
    for (const auto& [name, item] : expected) {
      if ("INOUTS." + std::string(name) != signal.symbol) continue;
      EXPECT_EQ(signal.byteOffset, item.offset) << name;
      EXPECT_EQ(signal.strideBytes, item.bytes) << name;
      ++found;
    }
  }
  EXPECT_EQ(found, std::size(expected));
  EXPECT_EQ(size, kBytes);
}

TEST_F(Units, NodeNumbers) { // l.3287-3291
  EXPECT_EQ(devices.unit(1, 1)->node(), 0x21);
  EXPECT_EQ(devices.unit(1, 2)->node(), 0x22);
  EXPECT_EQ(devices.unit(2, 1)->node(), 0x41);
  EXPECT_EQ(devices.unit(3, 1)->node(), 0x45);
}

TEST_F(Units, InputsAndOutputs) { // l.3341-3352
  in.terminals[0] = 0x0F;         // P1IN
  in.terminals[6] = 0x55;         // P7IN
  in.units.out[0] = 0x81;         // P0OUT
  in.units.out[4] = 0x18;         // P4OUT
  run();
  EXPECT_EQ(out.units.in[0], 0x0F);
  EXPECT_EQ(out.units.in[6], 0x55);
  EXPECT_EQ(item(1, 1, {kIn}), 0x0Fu);
  EXPECT_EQ(item(1, 2, {kIn + 2}), 0x55u);
  EXPECT_EQ(devices.unit(1, 1)->output(0), 0x81);
  EXPECT_EQ(devices.unit(1, 2)->output(1), 0x18);
  EXPECT_EQ(item(1, 2, {kOut + 1}), 0x18u);
}

TEST_F(Units, WhatTheStructureSays) {
  EXPECT_EQ(item(1, 2, kSize), kBytes);
  EXPECT_EQ(item(1, 2, kPresent), 1u);
  EXPECT_EQ(item(1, 1, kFirstIn), 1u);
  EXPECT_EQ(item(1, 2, kFirstIn), 5u);
  EXPECT_EQ(item(1, 1, kFirstOut), 0u);
  EXPECT_EQ(item(1, 2, kFirstOut), 3u);
  EXPECT_EQ(item(1, 1, kDeviceName), 0x554F4E49u) << "INOU";
  EXPECT_EQ(item(2, 1, kDeviceName), 0x35414C4Bu) << "KLA5";
  EXPECT_EQ(item(1, 1, kHardwareVersion), 0u) << "it has no object 1009h";
  EXPECT_EQ(item(1, 1, kVendor), 1u);
  const uint32_t before = item(1, 1, kTpdoCount);
  run(20);
  EXPECT_EQ(item(1, 1, kTpdoCount), before + 20);
  EXPECT_EQ(item(1, 1, kRpdoCount), before + 20);
}

TEST_F(Units, ItemsOfUnitsThatAreNotThere) { // l.4296, l.4330
  uint32_t value = 0;
  EXPECT_FALSE(devices.control().readItem(2, 1, 3, kMode, value));
  EXPECT_FALSE(devices.control().readItem(2, 4, 1, kMode, value));
  EXPECT_FALSE(devices.control().readItem(2, 0, 1, kMode, value));
  EXPECT_FALSE(devices.control().readItem(2, 1, 0, kMode, value));
  EXPECT_FALSE(devices.control().readItem(1, 1, 1, kMode, value)) << "channel 1 is not active";
  EXPECT_FALSE(devices.control().readItem(2, 1, 1, {kBytes, 1}, value));
  EXPECT_FALSE(devices.control().readItem(2, 1, 1, {kBytes - 1, 2}, value));
  EXPECT_FALSE(devices.control().readItem(2, 1, 1, {UINT32_MAX, 4}, value));
  EXPECT_FALSE(devices.control().writeItem(2, 1, 3, kMode, 1));
  EXPECT_EQ(value, 0u);
}

TEST_F(Units, AnalogueInputsCountInTheirMode) { // l.4345-4354
  devices.wires(1, 2)->analogue[0] = 128;
  run();
  EXPECT_EQ(item(1, 2, {kAnalogue}), 0u);
  setItem(1, 2, kMode, kModeAnalogue);
  EXPECT_EQ(item(1, 2, kModeNow), 0u);
  run();
  EXPECT_EQ(item(1, 2, kModeNow), 1u);
  EXPECT_EQ(item(1, 2, {kAnalogue}), 128u);
  EXPECT_EQ(item(1, 1, {kAnalogue}), 0u);
  setItem(1, 2, kMode, kModeStandard);
  run();
  EXPECT_EQ(item(1, 2, {kAnalogue}), 0u);
}

TEST_F(Units, MatrixKeysCountInTheirMode) { // l.4567-4587
  devices.wires(1, 1)->keys = {0x12, 0xFF, 0xFF, 0xFF};
  run();
  EXPECT_EQ(item(1, 1, {kKeys}), 0u);
  setItem(1, 1, kMode, kModeMatrix);
  run();
  EXPECT_EQ(item(1, 1, {kKeys}), 0x12u);
  EXPECT_EQ(item(2, 1, {kKeys}), 0xFFu) << "panels have keys in every mode";
}

TEST_F(Units, HandwheelKeysAndEncoders) { // l.7483
  devices.wires(3, 1)->in = {0x04, 0x80};
  devices.wires(3, 1)->encoders = {0xFFFE, 7};
  run();
  EXPECT_EQ(out.units.keys[0][0], 0x04);
  EXPECT_EQ(out.units.keys[0][1], 0x80);
  EXPECT_EQ(item(3, 1, {kEncoder, 2}), 0xFFFEu);
  EXPECT_EQ(item(3, 1, {kEncoder + 2, 2}), 7u);
}

// A field has eight bits: only the low bytes come (l.4705).
TEST_F(Units, EncodersCountOn) {
  const InoutsItem counter{kEncoder, 2};
  for (const uint16_t now : {100, 200, 300, 399, 300, 200, 100, 0, 0xFFF0, 0x10}) {
    devices.wires(3, 1)->encoders[0] = now;
    run();
    EXPECT_EQ(item(3, 1, counter), now);
  }
}

// The units' part of it: l.4401-4406, l.4699-4714, l.4774-4790.
TEST_F(Units, TheControlMapsTheProcessData) {
  const auto mapping = [&](uint32_t node, uint16_t index) {
    std::vector<uint32_t> fields;
    for (uint8_t i = 1; i <= kPdoFields; ++i) fields.push_back(sdo::value(readObject(node, {index, i})));
    return fields;
  };
  using testing::ElementsAre;
  EXPECT_THAT(mapping(0x22, 0x1600), ElementsAre(0x62000108, 0x62000208, 0x62000308, 0x00050008, 0x00050008, 0x00050008,
                                                 0x00050008, 0x00050008));
  EXPECT_THAT(mapping(0x22, 0x1A00), ElementsAre(0x60000108, 0x60000208, 0x60000308, 0x60000408, 0x21080108, 0x21080208,
                                                 0x21080308, 0x21080408));
  EXPECT_THAT(mapping(0x45, 0x1600), ElementsAre(0x210F0608, 0x210F0708, 0x210F0C08, 0x210F0D08, 0x210F0E08, 0x210F0F08,
                                                 0x210F0A08, 0x210F0908));
  EXPECT_THAT(mapping(0x45, 0x1A00), ElementsAre(0x21110108, 0x21110208, 0x210D0108, 0x210D0208, 0x00050008, 0x00050008,
                                                 0x00050008, 0x00050008));
  EXPECT_EQ(sdo::value(readObject(0x45, {0x2110, 0})), 1u) << "wheel mode";
  EXPECT_EQ(sdo::value(readObject(0x22, {0x1801, 1})), 0x800002A2) << "TPDO2 only in the analogue mode";
}

// The simulated unit: what it takes, and that it does what it was told.
TEST_F(Units, MappingsByTheProgram) {
  const auto map = [&](uint32_t field) { return sdo::value(ask(sdo::write(0x21, {0x1A00, 1}, 4, field))); };
  EXPECT_EQ(map(0x60000208), sdo::kWrongState) << "it is operational";
  tell({0x80, 0x21});
  EXPECT_EQ(map(0x60000210), sdo::kNotMappable) << "16 bits";
  EXPECT_EQ(map(0x62000108), sdo::kNotMappable) << "an output";
  EXPECT_EQ(map(0x60000508), sdo::kNotMappable) << "there are four inputs";
  EXPECT_EQ(map(0x60000208), 0u);
  EXPECT_EQ(sdo::value(ask(sdo::write(0x21, {0x1600, 0}, 1, 4))), sdo::kReadOnly) << "eight is the number of fields";
  EXPECT_EQ(sdo::value(ask(sdo::write(0x21, {0x1801, 2}, 1, 0))), sdo::kWrongValue);
  tell({1, 0x21});
  in.terminals[1] = 0x77;
  run();
  EXPECT_EQ(item(1, 1, {kIn}), 0x77u);
}

TEST_F(Units, HandwheelDisplayWaitsForTheProgram) { // l.7507-7531
  in.units.displayBusy[0] = true;
  in.units.display[0] = {0, 16, 'A', 'b', 'c', 0xFF, 0, 0};
  run();
  EXPECT_EQ(devices.unit(3, 1)->display()->text(0, 16), "");
  in.units.displayBusy[0] = false;
  run();
  EXPECT_EQ(devices.unit(3, 1)->display()->text(0, 16), "Abc");
  EXPECT_EQ(devices.unit(1, 1)->display(), nullptr);
}

TEST_F(Units, SeriousErrorZeroesAllOutputs) { // l.3541, l.3655-3674, l.4252-4263
  in.units.out[0] = in.units.out[3] = 0xFF;
  run();
  unitEvent(1, 2, {.error = kErrorSupply});
  run();
  EXPECT_EQ(item(1, 2, kError), 0x05u);
  EXPECT_EQ(item(1, 2, kErrorCode), 0x05u);
  EXPECT_EQ(item(1, 2, kErrorStatus), uint32_t{kErrorNow | kErrorMemory | kZeroAll});
  EXPECT_EQ(codes(1), (GroupCodes{.errorCode = 5, .errorNumber = 2}));
  EXPECT_EQ(codes(2), GroupCodes{});
  EXPECT_TRUE(out.units.zeroed);
  EXPECT_EQ(devices.unit(1, 1)->output(0), 0);
  EXPECT_EQ(item(1, 1, {kOut}), 0u);

  unitEvent(1, 2, {.error = 0});
  run();
  EXPECT_EQ(item(1, 2, kError), 0u);
  EXPECT_EQ(item(1, 2, kErrorCode), 0x05u) << "remembered";
  EXPECT_EQ(item(1, 2, kErrorStatus), uint32_t{kErrorMemory});
  EXPECT_EQ(codes(1), GroupCodes{});
  EXPECT_EQ(devices.unit(1, 1)->output(0), 0xFF);
  setItem(1, 2, kErrorStatus, 0);
  setItem(1, 2, kErrorCode, 0);
  run();
  EXPECT_EQ(item(1, 2, kErrorStatus), 0u);
  EXPECT_EQ(item(1, 2, kErrorCode), 0u);
}

TEST_F(Units, AUnitMayKeepItsErrorToItself) { // IO_DIS_NULL, l.3541
  in.units.out[0] = 0xFF;
  setItem(1, 2, kControl, kNoZeroing);
  unitEvent(1, 2, {.error = kErrorTemperature});
  run();
  EXPECT_EQ(item(1, 2, kErrorStatus), uint32_t{kErrorNow | kErrorMemory});
  EXPECT_FALSE(out.units.zeroed);
  EXPECT_EQ(devices.unit(1, 1)->output(0), 0xFF);
}

TEST_F(Units, TheLowestBoardIsReported) {
  unitEvent(1, 2, {.error = kErrorInput});
  unitEvent(1, 1, {.error = kErrorSupply});
  unitEvent(3, 1, {.error = kErrorTemperature});
  run();
  EXPECT_EQ(codes(1), (GroupCodes{.errorCode = 5, .errorNumber = 1}));
  EXPECT_EQ(codes(3), (GroupCodes{.errorCode = 9, .errorNumber = 1}));
  unitEvent(1, 1, {.error = 0});
  run();
  EXPECT_EQ(codes(1), (GroupCodes{.errorCode = 0x81, .errorNumber = 2}));
}

TEST_F(Units, ShortHoldsTheOutputUntilItIsConfirmed) { // l.3526-3548, l.3674-3678
  in.units.out[0] = in.units.out[3] = 0xFF;
  run();
  unitEvent(1, 1, {.shorts = {0x08}});
  run();
  EXPECT_EQ(item(1, 1, kError), 0x03u);
  EXPECT_EQ(item(1, 1, {kShort}), 0x08u);
  EXPECT_EQ(out.units.errors[0], 0x08);
  EXPECT_EQ(devices.unit(1, 1)->output(0), 0xF7);
  EXPECT_EQ(item(1, 1, {kOut}), 0xF7u);
  EXPECT_FALSE(out.units.zeroed) << "a short is not a serious error";
  EXPECT_EQ(devices.unit(1, 2)->output(0), 0xFF);

  unitEvent(1, 1, {.shorts = {0}}); // gone, but not confirmed
  run();
  EXPECT_EQ(item(1, 1, kError), 0u);
  EXPECT_EQ(item(1, 1, {kShort}), 0u);
  EXPECT_EQ(out.units.errors[0], 0x08);
  EXPECT_EQ(devices.unit(1, 1)->output(0), 0xF7);
  out.units.errors[0] = 0;
  run();
  EXPECT_EQ(out.units.errors[0], 0);
  EXPECT_EQ(devices.unit(1, 1)->output(0), 0xFF);
}

TEST_F(Units, AConfirmedShortThatLastsComesBackWithTheOutput) {
  in.units.out[1] = 0x01;
  unitEvent(1, 1, {.shorts = {std::nullopt, 0x01}});
  run();
  EXPECT_EQ(out.units.errors[1], 1);
  in.units.out[1] = 0;
  out.units.errors[1] = 0;
  run();
  EXPECT_EQ(out.units.errors[1], 0);
  in.units.out[1] = 1;
  run();
  EXPECT_EQ(out.units.errors[1], 1);
}

TEST_F(Units, ShortsThatTheProgramDoesNotWantToKnow) { // IO_DIS_ERPIS, l.3526
  setItem(1, 1, kControl, kNoShortReports);
  in.units.out[0] = 0xFF;
  unitEvent(1, 1, {.shorts = {0x81}});
  run();
  EXPECT_EQ(item(1, 1, {kShort}), 0x81u);
  EXPECT_EQ(out.units.errors[0], 0);
  EXPECT_EQ(devices.unit(1, 1)->output(0), 0x7E) << "the unit itself switches it off";
  unitEvent(1, 1, {.shorts = {0}});
  run();
  EXPECT_EQ(devices.unit(1, 1)->output(0), 0xFF);
}

TEST_F(Units, SilentUnit) { // l.3534-3539
  in.terminals[0] = 0x0F;
  run();
  unitEvent(1, 1, {.silent = true});
  run(99);
  EXPECT_EQ(item(1, 1, kError), 0u);
  EXPECT_EQ(item(1, 1, kCount), 99u);
  run(1);
  EXPECT_EQ(item(1, 1, kError), uint32_t{kErrorAny | kErrorCommunication});
  EXPECT_EQ(item(1, 1, kErrorStatus), uint32_t{kTimeoutNow | kTimeoutMemory | kZeroAll});
  EXPECT_EQ(codes(1), (GroupCodes{0x11, 1, 1, 1}));
  EXPECT_TRUE(out.units.zeroed);
  EXPECT_EQ(item(1, 1, {kIn}), 0x0Fu) << "what came last";

  unitEvent(1, 1, {.silent = false});
  in.terminals[0] = 0x01;
  run();
  EXPECT_EQ(item(1, 1, kError), 0u);
  EXPECT_EQ(item(1, 1, kErrorStatus), uint32_t{kTimeoutMemory});
  EXPECT_EQ(codes(1), GroupCodes{});
  EXPECT_EQ(item(1, 1, {kIn}), 0x01u);
}

TEST_F(Units, TimeOutsMayBeSwitchedOff) { // IO_DIS_TMOUT
  setItem(2, 1, kControl, kNoTimeout);
  unitEvent(2, 1, {.silent = true});
  run(1000);
  EXPECT_EQ(item(2, 1, kErrorStatus), 0u);
  EXPECT_EQ(codes(2), GroupCodes{});
  setItem(2, 1, kControl, 0);
  run(1);
  EXPECT_EQ(codes(2), (GroupCodes{0x11, 1, 1, 1}));
}

TEST_F(Units, AnErrorThatCameWhileTheUnitWasSilentIsSeenAfterwards) {
  unitEvent(1, 1, {.silent = true});
  run(200);
  unitEvent(1, 1, {.error = kErrorSupply});
  run(20);
  unitEvent(1, 1, {.silent = false});
  run();
  EXPECT_EQ(item(1, 1, kError), 0x05u);
}

TEST_F(Units, BusOff) {
  EXPECT_EQ(devices.busEvent(2, true), "");
  EXPECT_EQ(devices.control().channel(2).send(packetOf(0x10, {})), CanError::SendQueueFull);
  run(100);
  EXPECT_EQ(codes(1), (GroupCodes{0x11, 1, 1, 1}));
  EXPECT_EQ(codes(3), (GroupCodes{0x11, 1, 1, 1}));
  EXPECT_EQ(devices.busEvent(2, false), "");
  EXPECT_EQ(devices.control().channel(2).send(packetOf(0x10, {})), CanError::Ok);
  run();
  EXPECT_EQ(codes(1), GroupCodes{});
}

TEST_F(Units, PowerOffForgets) {
  setItem(1, 1, kMode, 1);
  unitEvent(1, 1, {.error = 4});
  run();
  unitEvent(1, 1, {.error = 0});
  devices.power();
  out = {};
  run();
  EXPECT_EQ(item(1, 1, kErrorStatus), 0u);
  EXPECT_EQ(item(1, 1, kErrorCode), 0u);
  EXPECT_EQ(item(1, 1, kModeNow), 0u);
  EXPECT_EQ(item(1, 1, kPresent), 1u);
}

// ---- packets --------------------------------------------------------------------------------------------------------

TEST_F(Units, ThePdosOfUnitsAreTheControls) {
  run(100);
  EXPECT_EQ(received(2).id, 0xFFFF);
}

TEST_F(Units, SdoByTheProgram) { // l.4358-4463
  EXPECT_EQ(ask(packetOf(0x621, {0x40, 0x00, 0x10, 0, 0, 0, 0, 0})),
            packetOf(0x5A1, {0x43, 0x00, 0x10, 0, 0x91, 0x01, 0x03, 0x00}));
  EXPECT_EQ(ask(packetOf(0x621, {0x40, 0x01, 0x10, 0, 0, 0, 0, 0})),
            packetOf(0x5A1, {0x4F, 0x01, 0x10, 0, 0, 0, 0, 0}));
  EXPECT_EQ(ask(packetOf(0x621, {0x40, 0x08, 0x10, 0, 0, 0, 0, 0})), packetOf(0x5A1, {0x41, 0x08, 0x10, 0, 7, 0, 0, 0}))
      << "seven characters in segments";
  EXPECT_EQ(ask(packetOf(0x621, {0x60, 0, 0, 0, 0, 0, 0, 0})),
            packetOf(0x5A1, {0x01, 'I', 'N', 'O', 'U', 'T', '0', '8'}));
  in.terminals[2] = 0x3C;
  EXPECT_EQ(ask(packetOf(0x621, {0x40, 0x00, 0x60, 3, 0, 0, 0, 0})),
            packetOf(0x5A1, {0x4F, 0x00, 0x60, 3, 0x3C, 0, 0, 0}));
  EXPECT_EQ(ask(packetOf(0x622, {0x40, 0x09, 0x10, 0, 0, 0, 0, 0})),
            packetOf(0x5A2, {0x80, 0x09, 0x10, 0, 0, 0, 0x02, 0x06}));
  EXPECT_EQ(ask(packetOf(0x622, {0x2F, 0x00, 0x60, 1, 5, 0, 0, 0})),
            packetOf(0x5A2, {0x80, 0x00, 0x60, 1, 2, 0, 0x01, 0x06}))
      << "read only";
}

TEST_F(Units, RequestsByTheStructure) { // SEND_REQ, l.4105
  for (uint32_t i = 0; i < 3; ++i) setItem(1, 1, {kSend + 4 + i}, i == 0 ? 0x40 : i == 1 ? 0x00 : 0x10);
  setItem(1, 1, kSendRequest, 1);
  run();
  EXPECT_EQ(item(1, 1, kSendRequest), 0u);
  EXPECT_EQ(item(1, 1, kAnswerCount), 1u);
  EXPECT_EQ(item(1, 1, {kAnswer, 2}), 0x5A1u);
  EXPECT_EQ(item(1, 1, {kAnswer + 8, 4}), 0x00030191u);
}

TEST_F(Units, PacketsFromOutsideAndFromTheProgram) {
  EXPECT_EQ(devices.packetEvent(2, packetOf(0x11, {1, 0xAA})), "");
  EXPECT_EQ(devices.control().channel(2).send(packetOf(0x10, {2, 0x55})), CanError::Ok);
  CanPacket packet;
  EXPECT_FALSE(devices.control().takeSent(2, packet)) << "the bus takes it in the next tick";
  run(1);
  EXPECT_EQ(received(2), packetOf(0x11, {1, 0xAA}));
  ASSERT_TRUE(devices.control().takeSent(2, packet));
  EXPECT_EQ(packet, packetOf(0x10, {2, 0x55}));
  EXPECT_FALSE(devices.control().takeSent(2, packet));
  EXPECT_NE(devices.packetEvent(1, packet), "") << "not active";
  EXPECT_NE(devices.packetEvent(3, packet), "");
  EXPECT_NE(devices.packetEvent(2, {.id = 0x800}), "");
}

TEST_F(Units, OrdersEndWithThePlcProgram) {
  ASSERT_EQ(devices.control().channel(2).order({.objectLow = 0, .objectHigh = 0, .nodeLow = 0x11, .nodeHigh = 0x11}),
            1u);
  EXPECT_EQ(devices.packetEvent(2, packetOf(0x11, {1})), "");
  run(1);
  EXPECT_EQ(devices.control().channel(2).deliver(received(2)).count, 1u);
  devices.control().startProgram();
  EXPECT_EQ(devices.control().channel(2).deliver(packetOf(0x11, {1})).count, 0u);
  EXPECT_FALSE(devices.control().orders().remove(1));
}

TEST_F(Units, EmergenciesAreTheProgramsToo) {
  unitEvent(1, 1, {.error = 4});
  run();
  EXPECT_EQ(received(2), packetOf(0xA1, {0x00, 0x10, 0x05, 0, 0, 0, 0, 0}));
}

TEST_F(Units, SyncPeriod) {
  configure("CAN[1].SyncPeriod", "5");
  const uint32_t before = item(1, 1, kTpdoCount);
  run(20);
  EXPECT_EQ(item(1, 1, kTpdoCount), before + 4);
}

TEST(UnitsAlone, ABusWithoutUnits) {
  CanRig rig;
  rig.devices.power();
  EXPECT_EQ(rig.devices.control().channel(2).send(packetOf(1, {})), CanError::SendQueueFull) << "not active";
  rig.configure("CAN[1].Active", "1");
  rig.devices.power();
  EXPECT_EQ(rig.devices.control().channel(2).send(packetOf(1, {})), CanError::Ok);
  EXPECT_EQ(rig.devices.control().channel(1).send(packetOf(1, {})), CanError::SendQueueFull);
}

TEST(UnitsAlone, AllOfThem) {
  CanRig rig;
  rig.configure("CAN[1].InOut08Cnt", "32");
  rig.configure("CAN[1].Kla50Cnt", "4");
  rig.configure("CAN[1].KnobCnt", "2");
  rig.devices.power();
  rig.in.terminals[127] = 0x80;
  rig.in.units.out[95] = 0x40;
  rig.run(20);
  EXPECT_EQ(rig.out.units.in[127], 0x80);
  EXPECT_EQ(rig.devices.unit(1, 32)->output(2), 0x40);
  for (const GroupCodes& codes : rig.out.units.groups) EXPECT_EQ(codes, GroupCodes{});
}

TEST(UnitsConfiguration, Keys) {
  CanRig rig;
  rig.configure("can[1].inout08cnt", "1");
  rig.configure("CAN[1].INOUT08[0].CONTROL", "64");
  rig.configure("CAN[1].Kla50[3].CONTROL", "0x04");
  rig.configure("CAN[1].Knob[1].Control", "4");
  rig.configure("CAN[1].CanSpeed", "500000");
  rig.configure("CAN[1].PhysicalCanChannel", "1");
  rig.configure("CAN[1].ServicePeriod", "250");
  rig.configure("CAN[1].Kla50Cnt", "4");
  rig.devices.power();
  EXPECT_EQ(rig.item(1, 1, kControl), 64u);
  EXPECT_EQ(rig.item(2, 4, kControl), 4u);
  EXPECT_EQ(rig.devices.configure("COM[0].Active", "1"), std::nullopt);
  EXPECT_EQ(rig.devices.configure("axes", "XYZ"), std::nullopt);
}

TEST(UnitsConfiguration, Mistakes) {
  CanRig rig;
  const std::pair<std::string_view, std::string_view> mistakes[] = {{"CAN[1].InOut08Cnt", "33"},
                                                                    {"CAN[1].InOut08Cnt", "-1"},
                                                                    {"CAN[1].InOut08Cnt", "two"},
                                                                    {"CAN[1].Kla50Cnt", "5"},
                                                                    {"CAN[1].KnobCnt", "3"},
                                                                    {"CAN[1].Active", "2"},
                                                                    {"CAN[1].SyncPeriod", "0"},
                                                                    {"CAN[1].SyncPeriod", "16"},
                                                                    {"CAN[1].CanSpeed", "9600"},
                                                                    {"CAN[1].ServicePeriod", "100"},
                                                                    {"CAN[0].InOut08Cnt", "1"},
                                                                    {"CAN[1].Drives", "1"},
                                                                    {"CAN[1].INOUT08[32].CONTROL", "0"},
                                                                    {"CAN[1].INOUT08[0].CONTROL", "256"},
                                                                    {"CAN[1].KLA50[4].CONTROL", "0"},
                                                                    {"CAN[1].Panel[0].CONTROL", "0"},
                                                                    {"CAN[1].Speed", "1"}};
  for (const auto& [key, value] : mistakes)
    EXPECT_NE(rig.devices.configure(key, value).value_or(""), "") << key << value;
  EXPECT_NE(rig.devices.unitEvent(1, 1, {}), "");
  EXPECT_NE(rig.devices.busEvent(2, true), "");
  EXPECT_NE(rig.devices.busEvent(0, true), "");
}

} // namespace

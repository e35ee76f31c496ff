// The control's side of units and drives against nodes that are silent, refuse, or send nonsense: each packet by hand.
#include <gmock/gmock.h>

#include <deque>
#include <functional>

#include "machine/io/can/controller.h"
#include "machine/io/can/unit.h"

namespace {

using namespace rung::io;
using testing::Contains;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::Not;

// A bus whose nodes are the test's.
struct Bus final : CanPort {
  BusState state() const override { return BusState::Active; }
  bool transmit(const CanPacket& packet) override {
    sent.push_back(packet);
    if (packet.isObject(kSdoRequest) && answers) incoming.push_back(answers(packet));
    return true;
  }
  bool receive(CanPacket& packet) override {
    if (incoming.empty()) return false;
    packet = incoming.front();
    incoming.pop_front();
    return true;
  }

  std::vector<CanPacket> sent;
  std::deque<CanPacket> incoming;
  std::function<CanPacket(const CanPacket&)> answers; // to requests by SDO; empty: nobody answers
};

CanPacket carriedOut(const CanPacket& request) {
  return sdo::isWrite(request) ? sdo::written(request.node(), sdo::object(request))
                               : sdo::answer(request.node(), sdo::object(request), 1, 0);
}

class Nodes : public testing::Test {
protected:
  explicit Nodes(uint32_t channel) {
    control.connect(channel, bus);
    bus.answers = carriedOut;
  }
  void run(uint32_t ms) {
    while (ms-- > 0) {
      control.transmit(orders, units, driveOrders, drives);
      control.receive();
    }
  }
  void put(uint32_t id, std::initializer_list<uint8_t> data) { bus.incoming.push_back(packetOf(id, data)); }
  bool hasSent(const CanPacket& packet) const { return std::ranges::find(bus.sent, packet) != bus.sent.end(); }
  std::vector<std::string> messages() {
    std::vector<std::string> all;
    for (UnitMessage message; control.takeMessage(message);) all.push_back(textOf(message));
    for (DriveMessage message; control.takeMessage(message);) all.push_back(textOf(message));
    return all;
  }

  Bus bus;
  CanController control;
  UnitOrders orders;
  UnitStates units;
  DriveOrders driveOrders;
  DriveStates drives;
};

const CanPacket kPrepare = packetOf(0, {0x80, 0x21}), kStart = packetOf(0, {1, 0x21}),
                kStartWheel = packetOf(0, {1, 0x45});

struct BadUnits : Nodes {
  BadUnits() : Nodes(2) {
    control.units().configure(kInOut08, 1);
    control.units().configure(kHandwheel, 1);
    control.power();
  }
  uint32_t item(InoutsItem item, uint32_t group = kInOut08) {
    uint32_t value = 0xDEAD;
    EXPECT_TRUE(control.readItem(2, group, 1, item, value));
    return value;
  }
  void isAlive() { put(0x1A1, {0, 0, 0, 0, 0xFF, 0xFF, 0xFF, 0xFF}), put(0x1C5, {0, 0, 0, 0, 0, 0, 0, 0}); }
};

TEST_F(BadUnits, AreMappedBeforeTheyStart) {
  run(40);
  std::vector<CanPacket> ofUnit;
  for (const CanPacket& packet : bus.sent)
    if (packet == kPrepare || packet == kStart || (packet.id == 0x621 && sdo::object(packet).index / 0x100 != 0x10))
      ofUnit.push_back(packet);
  ASSERT_EQ(ofUnit.size(), 20u);
  EXPECT_EQ(ofUnit[0], kPrepare);
  EXPECT_EQ(ofUnit[1], sdo::write(0x21, {0x1600, 1}, 4, 0x62000108));
  EXPECT_EQ(ofUnit[8], sdo::write(0x21, {0x1600, 8}, 4, 0x00050008));
  EXPECT_EQ(ofUnit[9], sdo::write(0x21, {0x1A00, 1}, 4, 0x60000108));
  EXPECT_EQ(ofUnit[16], sdo::write(0x21, {0x1A00, 8}, 4, 0x21080408));
  EXPECT_EQ(ofUnit[17], sdo::write(0x21, {0x1801, 1}, 4, 0x800002A1));
  EXPECT_EQ(ofUnit[18], kStart);
  EXPECT_EQ(ofUnit[19], sdo::write(0x21, {0x2109, 0}, 2, 0));
  const auto first = [&](uint32_t id) {
    return std::ranges::find(bus.sent, static_cast<uint16_t>(id), &CanPacket::id) - bus.sent.begin();
  };
  EXPECT_GT(first(0x221), std::ranges::find(bus.sent, kStart) - bus.sent.begin()) << "outputs come after the start";
  EXPECT_THAT(messages(), IsEmpty());
}

// Its inputs and outputs are there by default; the bytes of a handwheel's display would be outputs.
TEST_F(BadUnits, WhoRefusesTheMapping) {
  bus.answers = [](const CanPacket& request) {
    return sdo::object(request) == sdo::Object{0x1600, 3}
               ? sdo::abort(request.node(), sdo::object(request), sdo::kNotMappable)
               : carriedOut(request);
  };
  run(40);
  EXPECT_TRUE(hasSent(kStart));
  EXPECT_FALSE(hasSent(kStartWheel));
  EXPECT_THAT(messages(),
              ElementsAre("CAN unit INOUT08 1 (node 21h) rejects the value of object 1600h:3, abort code 06040041h",
                          "CAN unit Knob 1 (node 45h) rejects the value of object 1600h:3, abort code 06040041h"));
  run(120);
  EXPECT_EQ(units.groups[kHandwheel - 1].timeoutNumber, 1) << "for the program it is not there";
  messages();
  for (int i = 0; i < 100; ++i) isAlive(), run(10);
  EXPECT_THAT(messages(), Not(Contains(testing::HasSubstr("refuses")))) << "it has been said";
}

TEST_F(BadUnits, WhoDoesNotAnswerBySdo) {
  bus.answers = {};
  for (int i = 0; i < 40; ++i) isAlive(), run(10);
  EXPECT_TRUE(hasSent(kStart));
  EXPECT_FALSE(hasSent(kStartWheel));
  EXPECT_THAT(messages(), ElementsAre("CAN unit INOUT08 1 (node 21h) does not answer the request for object 1001h:0",
                                      "CAN unit Knob 1 (node 45h) does not answer the request for object 1001h:0"));
  put(0x1A1, {0x5A, 1, 2, 3, 4, 5, 6, 7});
  run(2);
  EXPECT_EQ(units.in[0], 0x5A);
  bus.answers = carriedOut;
  for (int i = 0; i < 40; ++i) isAlive(), run(10);
  EXPECT_TRUE(hasSent(kStartWheel)) << "what was not answered is asked again";
  EXPECT_TRUE(hasSent(sdo::write(0x21, {0x1A00, 8}, 4, 0x21080408)));
  EXPECT_THAT(messages(), IsEmpty());
}

// One that never answers does not keep the others from being asked.
TEST_F(BadUnits, AnObjectThatIsNotAnswered) {
  bus.answers = [](const CanPacket& request) {
    return sdo::object(request).index == 0x1001 ? packetOf(0x7FF, {}) : carriedOut(request);
  };
  for (int i = 0; i < 20; ++i) isAlive(), run(10);
  const auto mapped = std::ranges::find(bus.sent, sdo::write(0x21, {0x1A00, 8}, 4, 0x21080408));
  EXPECT_LT(mapped, std::ranges::find(bus.sent, kStart));
  EXPECT_TRUE(hasSent(kStart));
  EXPECT_TRUE(hasSent(sdo::read(0x21, {0x100A, 0})));
}

TEST_F(BadUnits, WhoIsNotThere) {
  bus.answers = {};
  run(99);
  EXPECT_THAT(messages(), IsEmpty());
  run(500);
  EXPECT_THAT(messages(), ElementsAre("CAN unit INOUT08 1 (node 21h) does not answer",
                                      "CAN unit Knob 1 (node 45h) does not answer"));
  EXPECT_EQ(units.groups[0].timeoutCode, 1);
  EXPECT_FALSE(hasSent(kStart));
  EXPECT_FALSE(hasSent(packetOf(0x221, {0, 0, 0, 0, 0, 0, 0, 0}))) << "nobody gets outputs";
  EXPECT_EQ(std::ranges::count(bus.sent, uint16_t{0x621}, &CanPacket::id), 6) << "asked now and then";
  bus.answers = carriedOut;
  run(400);
  EXPECT_TRUE(hasSent(kStart));
  EXPECT_THAT(messages(), IsEmpty()) << "without inputs it is as good as not there";
  EXPECT_EQ(units.groups[0].timeoutCode, 1);
  isAlive();
  run(2);
  EXPECT_THAT(messages(),
              ElementsAre("CAN unit INOUT08 1 (node 21h) answers again", "CAN unit Knob 1 (node 45h) answers again"));
  EXPECT_EQ(units.groups[0].timeoutCode, 0);
}

// It has lost its mapping.
TEST_F(BadUnits, WhoHasBootedIsMappedAgain) {
  run(40);
  bus.sent.clear();
  put(0x721, {5}); // a heartbeat alone changes nothing
  run(20);
  EXPECT_FALSE(hasSent(kPrepare));
  put(0x721, {0});
  run(25);
  EXPECT_TRUE(hasSent(kPrepare));
  EXPECT_TRUE(hasSent(sdo::write(0x21, {0x1600, 1}, 4, 0x62000108)));
  EXPECT_TRUE(hasSent(kStart));
  EXPECT_FALSE(hasSent(kStartWheel));
}

// Its boot-up was lost, and it answers whoever asks.
TEST_F(BadUnits, WhoSendsNoInputsIsMappedAgain) {
  run(40);
  bus.sent.clear();
  for (int i = 0; i < 12; ++i) put(0x5A1, {0x60, 0, 0, 0, 0, 0, 0, 0}), run(10);
  EXPECT_TRUE(hasSent(kPrepare));
  EXPECT_EQ(units.groups[0].timeoutCode, 1);
  run(25);
  EXPECT_TRUE(hasSent(kStart));
}

TEST_F(BadUnits, InputsThatDoNotComeStay) {
  run(40);
  put(0x1A1, {1, 2, 3, 4, 0xFF, 0xFF, 0xFF, 0xFF});
  put(0x1C5, {1, 2, 3, 4, 0, 0, 0, 0});
  run(2);
  put(0x1A1, {0x81});
  put(0x1C5, {9, 9, 9});
  put(0x1A1, {});
  bus.incoming.push_back({.id = 0x1A1, .remote = 1, .length = 8}); // somebody asks for them
  run(2);
  EXPECT_THAT(std::vector(units.in.begin(), units.in.begin() + 4), ElementsAre(0x81, 2, 3, 4));
  EXPECT_EQ(units.keys[0][0], 1);
  EXPECT_EQ(item({inouts::kEncoder, 2}, kHandwheel), 3u);
}

TEST_F(BadUnits, ShortAnswersAndEmergencies) {
  bus.answers = [](const CanPacket& request) {
    CanPacket answer = carriedOut(request);
    if (sdo::object(request).index == 0x1001) answer.data[4] = 4, answer.length = 5;
    return answer;
  };
  run(30);
  put(0xA1, {0x00, 0x10});
  put(0x5A1, {});
  run(5);
  EXPECT_EQ(item(inouts::kError), 0u);
  EXPECT_THAT(messages(), IsEmpty());
  put(0xA1, {0x00, 0x10, 0x85, 0, 0, 0, 0, 0});
  run(5);
  EXPECT_EQ(item(inouts::kError), 0x85u);
  EXPECT_THAT(messages(), ElementsAre("CAN unit INOUT08 1 (node 21h) reports an error, register 1001h is 85h"));
}

TEST_F(BadUnits, ErrorsThatPeopleAreNotToSee) { // IO_DIS_ERR, l.3514-3519
  run(40);
  EXPECT_TRUE(control.writeItem(2, kInOut08, 1, inouts::kControl, kHideErrors));
  put(0xA1, {0x00, 0x10, 0x85, 0, 0, 0, 0, 0});
  run(5);
  EXPECT_EQ(item(inouts::kError), 0x85u);
  EXPECT_THAT(messages(), IsEmpty());
}

// What is sent to a unit, by the control's own echo or by another master, is no sign of life.
TEST_F(BadUnits, PacketsToAUnitAreNotFromIt) {
  bus.answers = {};
  for (int i = 0; i < 50; ++i) {
    put(0x221, {1, 2, 3});
    put(0x621, {0x40, 0, 0x10, 0, 0, 0, 0, 0});
    put(0x321, {1});
    put(0x0A0, {1}); // of no unit
    put(0x7A1, {1});
    run(10);
  }
  EXPECT_EQ(item(inouts::kPresent), 0u);
  EXPECT_THAT(messages(), Contains("CAN unit INOUT08 1 (node 21h) does not answer"));
}

struct BadDrives : Nodes {
  BadDrives() : Nodes(1) {
    control.drives().configure(1);
    control.power();
  }
};

TEST_F(BadDrives, StatusThatIsTooShort) {
  put(0x181, {0x37, 0, 4, 1});
  run(2);
  put(0x181, {0x08});
  put(0x181, {});
  bus.incoming.push_back({.id = 0x181, .remote = 1, .length = 4});
  put(0x081, {0x11});
  run(2);
  EXPECT_EQ(drives.status[0], 0x37);
  EXPECT_EQ(drives.manufacturer[0], 0x0104);
  EXPECT_THAT(messages(), IsEmpty());
}

TEST_F(BadDrives, PacketsToADriveAreNotFromIt) {
  bus.answers = {};
  for (int i = 0; i < 20; ++i) put(0x201, {0x0F, 0}), put(0x601, {0x40, 0, 0x10, 0, 0, 0, 0, 0}), run(10);
  EXPECT_THAT(messages(), ElementsAre("4219: time-out of drive 1"));
  EXPECT_EQ(drives.status[0], 0);
}

// Identifiers of no node, of nodes that there are not, and of all objects: whatever comes is the program's at most.
TEST_F(BadDrives, AnyIdentifier) {
  for (uint32_t id = 0; id < kCanIds; ++id) {
    bus.incoming.push_back({.id = static_cast<uint16_t>(id), .remote = static_cast<uint8_t>(id & 1), .length = 8});
    run(1);
  }
  CanPacket packet;
  uint32_t count = 0;
  while (control.takeReceived(1, packet)) ++count;
  EXPECT_EQ(count, 256u) << "the newest ones";
  EXPECT_EQ(packet.id, kCanIds - 1);
}

TEST_F(BadUnits, AnyIdentifier) {
  for (uint32_t id = 0; id < kCanIds; ++id) {
    bus.incoming.push_back({.id = static_cast<uint16_t>(id), .remote = static_cast<uint8_t>(id & 1), .length = 8});
    run(1);
  }
  EXPECT_EQ(item(inouts::kPresent), 1u);
}

} // namespace

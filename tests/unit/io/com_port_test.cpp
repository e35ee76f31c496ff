// Serial ports of a program: settings, queues, state, the simulated line (TECHNOL manual 23.3, l.20998-21199).
#include <gmock/gmock.h>

#include <string_view>

#include "sim/technol/devices/com.h"

namespace {

using namespace rung::io::com;
using rung::sim::technol::ComPorts;
using testing::HasSubstr;
using Bytes = std::vector<uint8_t>;

Bytes bytesOf(std::string_view text) { return {text.begin(), text.end()}; }

// ---- settings ----------------------------------------------------------------------------------------------------

TEST(ComSettings, AreThoseOfTheManual) {
  Settings settings;
  EXPECT_FALSE(settings.isActive); // l.21016
  EXPECT_EQ(settings.speed, 115200u);
  EXPECT_EQ(settings.bitsOfByte(), 1u + 8 + 2); // two stop bits, no parity (l.21029-21034)
  // The example of l.21002.
  for (const auto& [attribute, value] :
       {std::pair{"Active", "1"}, {"PhysicalComNo", "2"}, {"ComDataBits", "8"}, {"ComSpeed", "19200"}})
    EXPECT_EQ(settings.set(attribute, value), "");
  EXPECT_TRUE(settings.isActive);
  EXPECT_EQ(settings.physical, 2u);
  EXPECT_EQ(settings.speed, 19200u);
  EXPECT_EQ(settings.set("comparity", "even"), "");
  EXPECT_EQ(settings.set("ComStopBits", "1"), "");
  EXPECT_EQ(settings.set("ComDataBits", "7"), "");
  EXPECT_EQ(settings.set("ServiceMethod", "Buffered"), "");
  EXPECT_EQ(settings.bitsOfByte(), 1u + 7 + 1 + 1);
  EXPECT_EQ(settings.mask(), 0x7F);
}

TEST(ComSettings, MistakesAreExplained) {
  Settings settings;
  EXPECT_THAT(settings.set("ComSpeed", "0"), HasSubstr("50 to 4000000"));
  EXPECT_THAT(settings.set("ComSpeed", "fast"), HasSubstr("found 'fast'"));
  EXPECT_THAT(settings.set("ComDataBits", "9"), HasSubstr("7 to 8"));
  EXPECT_THAT(settings.set("ComStopBits", "3"), HasSubstr("1 to 2"));
  EXPECT_THAT(settings.set("ComParity", "Any"), HasSubstr("None, Odd"));
  EXPECT_THAT(settings.set("Active", "yes"), HasSubstr("0 or 1"));
  EXPECT_THAT(settings.set("ServiceMethod", "DMA"), HasSubstr("Buffered or RT"));
  EXPECT_THAT(settings.set("Speed", "1"), HasSubstr("not 'Speed'"));
}

// ---- the program's side ------------------------------------------------------------------------------------------

struct Com : testing::Test {
  Com() {
    configure("Active", "1");
    configure("ComSpeed", "19200");
  }
  void configure(const char* attribute, const char* value) {
    EXPECT_EQ(ports.configure(std::string("COM[1].") + attribute, value), "");
  }
  void ticks(int count) {
    for (int i = 0; i < count; ++i) ports.tick();
  }
  ComPorts ports;
  Port& port = ports.port(1);
  rung::sim::technol::ComLine& line = ports.line(1);
};

TEST_F(Com, AQueueHolds1024Bytes) {
  for (int i = 0; i < 1024; ++i) ASSERT_TRUE(port.send('x'));
  EXPECT_EQ(port.takeState(), 0u);
  EXPECT_FALSE(port.send('y'));
  EXPECT_EQ(port.takeState(), kSendOverflow);
  EXPECT_EQ(port.takeState(), 0u); // read once
  ticks(1000);
  EXPECT_EQ(line.sent(), 1024u);
  EXPECT_EQ(line.sentByte(1023), 'x');
}

TEST_F(Com, ABlockIsSentWholeOrNotAtAll) {
  EXPECT_TRUE(port.send(Bytes(1000, 'a')));
  EXPECT_FALSE(port.send(Bytes(25, 'b')));
  EXPECT_EQ(port.takeState(), kSendOverflow);
  EXPECT_TRUE(port.send(Bytes(24, 'c')));
  EXPECT_TRUE(port.send(Bytes{}));
  EXPECT_FALSE(port.send(Bytes(1025, 'd')));
  ticks(1000);
  EXPECT_EQ(line.sent(), 1024u);
  EXPECT_EQ(line.sentByte(1000), 'c');
}

TEST_F(Com, BytesAreReceivedInTheirOrder) {
  EXPECT_EQ(port.receive(), std::nullopt);
  EXPECT_EQ(port.received(), 0u);
  EXPECT_EQ(ports.receive(1, bytesOf("AB")), "");
  EXPECT_EQ(port.received(), 2u);
  EXPECT_EQ(port.receive(), 'A');
  EXPECT_EQ(port.receive(), 'B');
  EXPECT_EQ(port.receive(), std::nullopt);
  EXPECT_EQ(ports.receive(1, bytesOf("CD")), "");
  EXPECT_TRUE(port.clear());
  EXPECT_EQ(port.received(), 0u);
}

TEST_F(Com, WhatFindsTheQueueFullIsLost) {
  EXPECT_EQ(ports.receive(1, Bytes(1024, 'a')), "");
  EXPECT_EQ(port.takeState(), 0u);
  EXPECT_EQ(ports.receive(1, bytesOf("b")), "");
  EXPECT_EQ(port.takeState(), kReceiveOverflow);
  EXPECT_EQ(port.takeState(), 0u);
  EXPECT_EQ(port.receive(), 'a');
  EXPECT_EQ(ports.receive(1, bytesOf("c")), "");
  EXPECT_EQ(port.takeState(), 0u);
  uint8_t last = 0;
  while (const auto byte = port.receive()) last = *byte;
  EXPECT_EQ(last, 'c');
}

TEST_F(Com, APortThatIsNotActiveRefusesAll) {
  Port& none = ports.port(2);
  EXPECT_FALSE(none.send(1));
  EXPECT_FALSE(none.send(Bytes{}));
  EXPECT_EQ(none.receive(), std::nullopt);
  EXPECT_FALSE(none.clear());
  EXPECT_EQ(none.received(), std::nullopt);
  EXPECT_EQ(none.takeState(), kNotConfigured);
  EXPECT_THAT(ports.receive(2, bytesOf("a")), HasSubstr("not active"));
  EXPECT_THAT(ports.receive(16, bytesOf("a")), HasSubstr("not active"));
  EXPECT_THAT(ports.setError(2, true), HasSubstr("not active"));
}

TEST_F(Com, SevenBitsBothWays) {
  configure("ComDataBits", "7");
  EXPECT_TRUE(port.send(Bytes{0xC1, 0x42}));
  EXPECT_EQ(ports.receive(1, Bytes{0xFF}), "");
  EXPECT_EQ(port.receive(), 0x7F);
  ticks(2);
  EXPECT_TRUE(line.takeSent(bytesOf("AB")));
}

// ---- the simulated line ------------------------------------------------------------------------------------------

// 11 bits at 19200 bit/s: the n-th byte has left after n * 11/19.2 ms, seen at the end of that millisecond.
TEST_F(Com, BytesLeaveAtTheirSpeed) {
  ASSERT_TRUE(port.send(Bytes(1000, 'x')));
  for (uint32_t ms = 1; ms <= 500; ++ms) {
    ticks(1);
    ASSERT_EQ(line.sent(), ms * 19200 / 11000) << ms;
  }
}

TEST_F(Com, SpeedAndFormCount) {
  const auto leftIn = [&](const char* speed, const char* data, const char* stop, const char* parity, int ms) {
    configure("ComSpeed", speed);
    configure("ComDataBits", data);
    configure("ComStopBits", stop);
    configure("ComParity", parity);
    ports.powerOn();
    EXPECT_TRUE(port.send(Bytes(1024, 'x')));
    ticks(ms);
    return line.sent();
  };
  EXPECT_EQ(leftIn("115200", "8", "2", "None", 20), 209u); // 11 bits
  EXPECT_EQ(leftIn("115200", "8", "1", "None", 20), 230u); // 10
  EXPECT_EQ(leftIn("115200", "8", "2", "Mark", 20), 192u); // 12
  EXPECT_EQ(leftIn("9600", "7", "1", "Odd", 100), 96u);    // 10
  EXPECT_EQ(leftIn("50", "8", "1", "None", 199), 0u);
  EXPECT_EQ(leftIn("50", "8", "1", "None", 200), 1u);
}

// A line that was idle begins with the byte: nothing is saved up, and none is late.
TEST_F(Com, AnIdleLineSavesNothing) {
  ticks(1000);
  ASSERT_TRUE(port.send('a'));
  EXPECT_EQ(line.sent(), 0u);
  ticks(1);
  EXPECT_EQ(line.sent(), 1u);
  ASSERT_TRUE(port.send(Bytes(2, 'b')));
  ticks(1);
  EXPECT_EQ(line.sent(), 2u); // 19.2 of 22 bits
  ticks(1);
  EXPECT_EQ(line.sent(), 3u);
}

TEST_F(Com, WhatHasLeftIsSeenOnce) {
  ASSERT_TRUE(port.send(bytesOf("OK\r")));
  EXPECT_FALSE(line.takeSent(bytesOf("O"))); // still in the queue
  ticks(10);
  EXPECT_FALSE(line.takeSent(bytesOf("OK\n")));
  EXPECT_FALSE(line.takeSent(bytesOf("OK\r\r")));
  EXPECT_TRUE(line.takeSent(bytesOf("OK")));
  EXPECT_EQ(line.sent(), 1u);
  EXPECT_TRUE(line.takeSent(bytesOf("\r")));
  EXPECT_EQ(line.sent(), 0u);
  EXPECT_TRUE(line.takeSent({}));
}

TEST_F(Com, TheOldestAreLostWhereNobodyLooks) {
  configure("ComSpeed", "4000000");
  for (int block = 0; block < 65; ++block) {
    ASSERT_TRUE(port.send(Bytes(1024, static_cast<uint8_t>(block))));
    ticks(3);
  }
  EXPECT_EQ(line.sent(), 65536u);
  EXPECT_EQ(line.sentByte(0), 1);
  EXPECT_EQ(line.sentByte(65535), 64);
}

TEST_F(Com, ALineWithAnErrorRests) {
  ASSERT_TRUE(port.send(bytesOf("ab")));
  ASSERT_EQ(ports.setError(1, true), "");
  EXPECT_EQ(port.takeState(), kPortError);
  EXPECT_EQ(port.takeState(), kPortError); // as long as it lasts
  ticks(100);
  EXPECT_EQ(line.sent(), 0u);
  EXPECT_EQ(ports.receive(1, bytesOf("x")), "");
  EXPECT_EQ(port.received(), 0u);
  EXPECT_TRUE(port.send('c'));
  ASSERT_EQ(ports.setError(1, false), "");
  EXPECT_EQ(port.takeState(), 0u);
  ticks(2);
  EXPECT_TRUE(line.takeSent(bytesOf("abc")));
}

TEST_F(Com, PowerOff) {
  ASSERT_TRUE(port.send(Bytes(100, 'x')));
  EXPECT_FALSE(port.send(Bytes(1000, 'x')));
  ASSERT_EQ(ports.receive(1, Bytes(1030, 'y')), "");
  ticks(10);
  ASSERT_EQ(ports.setError(1, true), "");
  ports.powerOn();
  EXPECT_EQ(port.takeState(), 0u);
  EXPECT_EQ(port.received(), 0u);
  EXPECT_EQ(line.sent(), 0u);
  ticks(100);
  EXPECT_EQ(line.sent(), 0u);
  EXPECT_TRUE(port.send(Bytes(1024, 'z')));
}

TEST(ComPortsConfiguration, Keys) {
  ComPorts ports;
  for (const char* key : {"COM[0].Active", "COM[15].ComSpeed", "com.Active"}) EXPECT_TRUE(ComPorts::owns(key)) << key;
  for (const char* key : {"COMMAND", "CAN[1].Active", "COMX[1].Active"}) EXPECT_FALSE(ComPorts::owns(key)) << key;
  EXPECT_EQ(ports.configure("COM[0].Active", "1"), ""); // an index of 0 is the same as none
  EXPECT_TRUE(ports.port(0).settings().isActive);
  EXPECT_EQ(ports.configure("COM[15].Active", "1"), "");
  EXPECT_THAT(ports.configure("COM[16].Active", "1"), HasSubstr("COM[15]"));
  EXPECT_THAT(ports.configure("COM[x].Active", "1"), HasSubstr("COM[15]"));
  EXPECT_THAT(ports.configure("COM[1]", "1"), HasSubstr("COM[15]"));
  EXPECT_THAT(ports.configure("COM[1].Speed", "1"), HasSubstr("COM[1].Speed"));
}

} // namespace

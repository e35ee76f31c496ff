// The tables of connections in a mapping file: what is read. What is said about each mistake is a golden
// (golden_test.cpp).
#include <gtest/gtest.h>

#include "machine/host/mapping_file.h"
#include "tests/support/faultless_map.h"
#include "tests/support/words.h"
#include "tests/unit/host/connected_pins.h"

namespace rung::host {
namespace {

File faultless(std::string_view text) { return test::faultlessMap(std::string(testing::kPins) + std::string(text)); }

TEST(Connections, HaveWhatIsUsual) {
  const File map =
      faultless("[modbus-server]\n[[modbus-client]]\nhost = \"10.0.0.1\"\n[shared-memory]\nname = \"mill\"\n");
  ASSERT_EQ(map.connections.size(), 3u);
  const Connection& server = map.connections[0];
  EXPECT_EQ(server.title(), "modbus-server 127.0.0.1:502");
  EXPECT_EQ(server.connections, 8u);
  EXPECT_EQ(server.requests, 1000u);
  EXPECT_EQ(server.timeoutNs, 1'000'000'000);
  EXPECT_FALSE(server.statusPin);
  EXPECT_EQ(map.connections[1].title(), "modbus-client 10.0.0.1:502");
  EXPECT_EQ(map.connections[1].unit, 1);
  EXPECT_EQ(map.connections[1].periodNs, 10'000'000);
  EXPECT_EQ(map.connections[2].title(), "shared-memory mill");
}

TEST(Connections, AreReadWithEveryKey) {
  const File map = faultless(R"([[modbus-client]]
host = "::1"
port = 1502
unit = 7
period = 0.05
timeout = 0.2
status = "ok"
[modbus-client.coils]
lamp = 3
[modbus-client.discrete-inputs]
start = { at = 9, safe = true }
[modbus-client.holding-registers]
speed = { at = 1, format = "s32", order = "low-first", safe = -4 }
turns = { at = 65535 }
[modbus-client.input-registers]
load = { at = 4, format = "f32", order = "high-first", safe = "hold" }
keys = 0
)");
  ASSERT_EQ(map.connections.size(), 1u);
  const Connection& client = map.connections[0];
  EXPECT_EQ(client.title(), "modbus-client [::1]:1502");
  EXPECT_EQ(client.unit, 7);
  EXPECT_EQ(client.periodNs, 50'000'000);
  EXPECT_EQ(client.timeoutNs, 200'000'000);
  EXPECT_EQ(map.pins[*client.statusPin].name, "ok");
  ASSERT_EQ(client.pins.size(), 6u);
  EXPECT_EQ(client.pins[0].area, Area::Coil);
  EXPECT_EQ(client.pins[0].place, 3u);
  EXPECT_EQ(client.pins[1].safe, 1);
  EXPECT_EQ(client.pins[2].format, Format::S32);
  EXPECT_TRUE(client.pins[2].lowFirst);
  EXPECT_EQ(client.pins[2].safe, -4);
  EXPECT_EQ(client.pins[3].format, Format::S16);
  EXPECT_EQ(client.pins[4].format, Format::F32);
  EXPECT_TRUE(client.pins[4].holds);
  EXPECT_EQ(client.pins[5].format, Format::U16);
}

TEST(Connections, OfMemoryHaveTheTypesOfTheirPins) {
  const File map = faultless("[shared-memory]\nname = \"a\"\npins = { start = 1, speed = 4, load = 8, lamp = 1 }\n");
  const std::vector<ConnectedPin>& pins = map.connections[0].pins;
  ASSERT_EQ(pins.size(), 4u) << "the two directions have places of their own";
  EXPECT_EQ(pins[0].format, Format::Bit);
  EXPECT_EQ(pins[1].format, Format::S32);
  EXPECT_EQ(pins[2].format, Format::F64);
}

TEST(Connections, FindPinsThatComeAfterThem) {
  std::vector<std::string> errors;
  const File map =
      parseMap("[modbus-server]\ncoils = { a = 0 }\n[in]\na = { type = \"bit\", name = \"X0.0\" }\n", "m.map", errors);
  EXPECT_EQ(test::joined(errors), "");
  EXPECT_EQ(map.connections[0].pins.size(), 1u);
}

TEST(Connections, AreSeveralAndShareOutputs) {
  const File map =
      faultless("[[modbus-server]]\ncoils = { lamp = 0 }\n[[modbus-server]]\nport = 503\ncoils = { lamp = 5 }\n");
  EXPECT_EQ(map.connections.size(), 2u);
}

} // namespace
} // namespace rung::host

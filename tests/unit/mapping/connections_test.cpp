// The tables of connections in a mapping file: what is read, and what is said about each mistake.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/faultless_map.h"
#include "tools/mapping/file.h"

namespace rung::mapping {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr std::string_view kPins = R"([in]
start = { type = "bit", name = "X0.0" }
speed = { type = "s32", name = "D0:2" }
load = { type = "float", name = "D4:4" }
keys = { type = "u32", name = "X10" }
ok = { type = "bit", name = "X0.1" }
[out]
lamp = { type = "bit", name = "Y0.0" }
turns = { type = "s32", name = "D8:2" }
[io]
mode = { type = "s32", name = "D20:4" }
[param]
delay = { type = "u32", name = "D30:2" }
)";
constexpr int kFirstLine = 14; // of what follows

File faultless(std::string_view text) { return test::faultlessMap(std::string(kPins) + std::string(text)); }

// Without the name of the file, and with lines counted from the first one of `text`.
std::vector<std::string> errorsOf(std::string_view text) {
  std::vector<std::string> errors;
  parseMap(std::string(kPins) + std::string(text), "m.map", errors);
  for (std::string& error : errors) {
    error.erase(0, std::string_view("m.map:").size());
    size_t digits = 0;
    const int line = std::stoi(error, &digits);
    error.replace(0, digits, std::to_string(line - kFirstLine + 1));
  }
  return errors;
}

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
  EXPECT_THAT(errors, IsEmpty());
  EXPECT_EQ(map.connections[0].pins.size(), 1u);
}

TEST(Connections, AreSeveralAndShareOutputs) {
  const File map =
      faultless("[[modbus-server]]\ncoils = { lamp = 0 }\n[[modbus-server]]\nport = 503\ncoils = { lamp = 5 }\n");
  EXPECT_EQ(map.connections.size(), 2u);
}

TEST(Connections, WithWrongKeysSayWhatIsExpected) {
  EXPECT_THAT(errorsOf("modbus-server = 5\n"),
              ElementsAre("1:17: param.modbus-server: found 5, expected a table; write for example modbus-server = { "
                          "type = \"bit\", name = \"X0.0\" }"));
  EXPECT_THAT(
      errorsOf("[modbus-server]\nhost = \"localhost\"\nport = 65536\ntimeout = 0\nconnections = 65\nrequests = "
               "0\nstatus = \"\"\nunit = 1\ncoils = 5\n"),
      ElementsAre(
          "2:8: modbus-server.host: found \"localhost\", expected an IP address, because a name would have to be "
          "looked up while the program runs; write for example host = \"127.0.0.1\"",
          "3:8: modbus-server.port: found 65536, expected the number of a port, 1 to 65535; write for example port = "
          "502",
          "4:11: modbus-server.timeout: found 0, expected seconds, 0.001 to 3600; write for example timeout = 0.5",
          "5:15: modbus-server.connections: found 65, expected how many clients are served at a time, 1 to 64; write "
          "for example connections = 8",
          "6:12: modbus-server.requests: found 0, expected how many requests of a client are answered in a second, 1 "
          "to 100000; write for example requests = 1000",
          "7:10: modbus-server.status: found \"\", expected the name of a pin; write for example status = \"panel-ok\"",
          "8:1: modbus-server: found an unknown key unit, expected host, port, timeout, connections, requests, status, "
          "coils, discrete-inputs, holding-registers, input-registers",
          "9:9: modbus-server.coils: found 5, expected a table; write for example coils = { start = 0 }"));
  EXPECT_THAT(
      errorsOf("[[modbus-client]]\nunit = 248\nperiod = 2\ntimeout = 2\n"),
      ElementsAre(
          "1:1: modbus-client: found no key host, expected an IP address, because a name would have to be looked up "
          "while the program runs; write for example host = \"192.168.0.10\"",
          "2:8: modbus-client.unit: found 248, expected the number of a unit, 0 to 247, or 255; write for example unit "
          "= 1"));
  EXPECT_THAT(errorsOf("[[modbus-client]]\nhost = \"10.0.0.1\"\nperiod = 2\ntimeout = 2\n"),
              ElementsAre("4:11: modbus-client.timeout: found no more than the period, expected a longer time; write "
                          "for example twice the period"));
  EXPECT_THAT(errorsOf("[shared-memory]\nname = \"../a\"\n"),
              ElementsAre("2:8: shared-memory.name: found \"../a\", expected a name of letters, digits, '-', '_' and "
                          "'.', at most 64; write for example name = \"mill\""));
}

TEST(Connections, WithWrongPinsSayWhatIsExpected) {
  EXPECT_THAT(
      errorsOf(R"([modbus-server]
[modbus-server.coils]
strat = 0
speed = 1
mode = 2
start = 65536
[modbus-server.discrete-inputs]
ok = 0
[modbus-server.holding-registers]
lamp = 0
delay = 3
)"),
      ElementsAre("3:1: modbus-server.coils.strat: found no pin strat, expected a pin of this map; did you mean start?",
                  "4:1: modbus-server.coils.speed: found a pin of type s32, expected type bit in coils; move it to the "
                  "registers",
                  "5:1: modbus-server.coils.mode: found a pin of [io], expected one of [in] or [out], which have one "
                  "source; write two pins, one each way",
                  "6:9: modbus-server.coils.start: found 65536, expected a number from 0 to 65535, or a table; write "
                  "for example start = 10",
                  "8:1: modbus-server.discrete-inputs.ok: found an input pin in discrete-inputs, expected one in "
                  "coils, because clients write no discrete-inputs; move it there",
                  "10:1: modbus-server.holding-registers.lamp: found a pin of type bit, expected type s32, u32 or "
                  "float in holding-registers; name the cell of the bits, and write type = \"u32\"",
                  "11:1: modbus-server.holding-registers.delay: found a pin of [param], expected one of [in] or [out], "
                  "which have one source; write two pins, one each way"));
  EXPECT_THAT(
      errorsOf("[[modbus-client]]\nhost = \"10.0.0.1\"\ninput-registers = { turns = 0 }\n"),
      ElementsAre("3:21: modbus-client.input-registers.turns: found an output pin in input-registers, expected one in "
                  "holding-registers, because nobody writes the input-registers of a device; move it there"));
}

TEST(Connections, WithWrongFormatsSayWhatIsExpected) {
  EXPECT_THAT(errorsOf(R"([modbus-server.holding-registers]
speed = { at = 0, format = "s64" }
load = { at = 1, format = "s32" }
keys = { at = 9, order = "low-first" }
turns = { at = 5, format = "f32", order = "high-first" }
)"),
              ElementsAre("2:28: modbus-server.holding-registers.speed.format: found \"s64\", expected \"s16\", "
                          "\"u16\", \"s32\", \"u32\" or \"f32\"; write for example format = \"s32\"",
                          "3:27: modbus-server.holding-registers.load: found two registers without an order, expected "
                          "\"high-first\" or \"low-first\"; write for example order = \"high-first\"",
                          "4:26: modbus-server.holding-registers.keys.order: found an order of one register, expected "
                          "a format of 32 bits; remove it, or write for example format = \"s32\"",
                          "5:28: modbus-server.holding-registers.turns.format: found \"f32\" for a pin of type s32, "
                          "expected a pin of type float; write another format"));
}

TEST(Connections, WithWrongSafeValuesSayWhatIsExpected) {
  EXPECT_THAT(errorsOf(R"([modbus-server]
coils = { start = { at = 0, safe = 1 }, lamp = { at = 1, safe = true } }
[modbus-server.holding-registers]
speed = { at = 0, safe = 1.5 }
load = { at = 1, safe = "stay" }
)"),
              ElementsAre("2:36: modbus-server.coils.start.safe: found 1, expected true or false, because the type is "
                          "bit; write such a value, or another type",
                          "2:65: modbus-server.coils.lamp.safe: found one of an output pin, expected it of an input "
                          "pin alone; write it where the pin is, in [out]",
                          "4:26: modbus-server.holding-registers.speed.safe: found 1.5, expected an integer from "
                          "-2147483648 to 2147483647, because the type is s32; write such a value, or another type",
                          "5:25: modbus-server.holding-registers.load.safe: found \"stay\", expected true, false, a "
                          "number or \"hold\"; write for example safe = true"));
}

TEST(Connections, HaveAPlaceForEachPin) {
  EXPECT_THAT(
      errorsOf(R"([modbus-server.holding-registers]
speed = { at = 4, format = "s32", order = "low-first" }
turns = 5
load = { at = 65535, format = "f32", order = "low-first" }
[shared-memory]
name = "a"
pins = { keys = 2, lamp = 0, turns = 65533 }
)"),
      ElementsAre(
          "3:9: modbus-server.holding-registers.turns: found 5, which is taken by pin speed in line 15, "
          "expected a place of its own; write another number",
          "4:15: modbus-server.holding-registers.load: found 65535, expected room for 2 registers below 65536; write a "
          "lower number",
          "7:17: shared-memory.pins.keys: found 2, expected a multiple of 4, the length of its type; write 0",
          "7:38: shared-memory.pins.turns: found 65533, expected room for 4 bytes below 65536; write a lower number"));
}

TEST(Connections, AreTheOnlySourceOfAnInput) {
  EXPECT_THAT(errorsOf(R"([modbus-server]
status = "ok"
coils = { start = 0, ok = 1 }
[[modbus-client]]
host = "10.0.0.1"
status = "lamp"
coils = { start = 0 }
)"),
              ElementsAre("3:22: modbus-server.coils.ok: found an input pin that is connected in line 15 already, "
                          "expected one source for it; remove one of them",
                          "6:10: modbus-client.status: found pin lamp of type bit in [out], expected a bit in [in]; "
                          "write such a pin for it",
                          "7:11: modbus-client.coils.start: found an input pin that is connected in line 16 already, "
                          "expected one source for it; remove one of them"));
}

TEST(Connections, AreRefusedByOtherHosts) {
  std::vector<std::string> errors;
  refuseConnections(faultless("[modbus-server]\n[shared-memory]\nname = \"a\"\n"), "LinuxCNC", errors);
  EXPECT_THAT(errors, ElementsAre("m.map:14:1: modbus-server: found a connection that only rung-run serves, expected "
                                  "none in LinuxCNC; remove the table [modbus-server]",
                                  "m.map:15:1: shared-memory: found a connection that only rung-run serves, expected "
                                  "none in LinuxCNC; remove the table [shared-memory]"));
}

} // namespace
} // namespace rung::mapping

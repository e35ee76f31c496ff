// Network services of the simulated NCT control where scenarios do not reach: failing sockets, several controls at a
// time, partners outside of the model.
#include <gtest/gtest.h>

#include "sim/nct/socket.h"
#include "tests/unit/sim/nct_machine.h"

namespace {

using namespace rung::sim;
using nct::Socket;
using test::NctMachine;

const NctMachine::Config kLoopback = {{"network", "loopback"}};
constexpr uint32_t kHome = 0x7F000001;
constexpr int32_t kOutside = static_cast<int32_t>(0xC0A8010C);
constexpr int kPatienceMs = 1000;

// A port that is free at the moment.
uint16_t freePort() {
  Socket socket;
  EXPECT_EQ(socket.openUdp({kHome, 0}), 0);
  return socket.port();
}

TEST(NctSocket, NothingLeavesTheLoopback) {
  Socket socket;
  EXPECT_EQ(socket.openUdp({0xC0A8010C, 0}), nct::kWindowsUnreachable);
  EXPECT_FALSE(socket.isOpen());
  EXPECT_EQ(socket.listen({0, 0}), nct::kWindowsUnreachable);
  EXPECT_EQ(socket.connect({kHome, 0}, {0x08080808, 80}), nct::kWindowsUnreachable);
  ASSERT_EQ(socket.openUdp({kHome, 0}), 0);
  const uint8_t byte[4] = {};
  EXPECT_EQ(socket.sendTo(byte, {0xC0A8010C, 49202}).error, nct::kWindowsUnreachable);
}

TEST(NctSocket, APortThatIsTakenIsAnError) {
  Socket first;
  ASSERT_EQ(first.listen({kHome, 0}), 0);
  Socket second;
  EXPECT_EQ(second.listen({kHome, first.port()}), 10048);
  EXPECT_FALSE(second.isOpen());
}

TEST(NctSocket, AnAnswerOfNobodyIsARefusal) {
  Socket socket;
  const int32_t error = socket.connect({kHome, 0}, {kHome, freePort()});
  if (error == 0) {
    ASSERT_TRUE(socket.writable(kPatienceMs));
    EXPECT_EQ(socket.connected(), 10061);
  } else {
    EXPECT_EQ(error, 10061);
  }
  EXPECT_FALSE(socket.isOpen());
}

TEST(NctNetwork, ControlsWithTheSamePortDoNotMeet) {
  std::vector<std::unique_ptr<NctMachine>> machines;
  for (int i = 0; i < 8; ++i) {
    machines.push_back(std::make_unique<NctMachine>());
    EXPECT_EQ(machines.back()->ask(true, 60, {5, 1, 0, 1 + i % 2, kOutside, 49202}), 0) << i;
  }
  const NcArgument open{.key = "open", .isText = true, .text = "udp"};
  const NcArgument port{.key = "port", .integer = 49202};
  const NcArgument words{.key = "send", .integer = 1};
  for (int i = 0; i < 8; i += 2) {
    const NcArgument value{.key = "w0", .integer = 100 + i};
    auto& machine = *machines[static_cast<size_t>(i)];
    EXPECT_EQ(machine.nc().event(machine.instance(), "device", {open, port}), "");
    EXPECT_EQ(machine.nc().event(machine.instance(), "device", {words, value}), "");
  }
  for (int i = 0; i < 8; i += 2) {
    auto& machine = *machines[static_cast<size_t>(i)];
    EXPECT_EQ(machine.ask(false, 62, {3, 1, 6000, 1}), 0);
    EXPECT_EQ(machine.word(6000), 100 + i);
    EXPECT_EQ(machine.ask(false, 62, {3, 1, 6000, 1}), 65); // one message each
  }
}

NcArgument number(std::string_view key, int64_t value) { return {.key = std::string(key), .integer = value}; }
NcArgument word(std::string_view key, std::string_view text) {
  return {.key = std::string(key), .isText = true, .text = std::string(text)};
}

std::string device(NctMachine& machine, const std::vector<NcArgument>& keys) {
  return machine.nc().event(machine.instance(), "device", keys);
}

// What has no room in memory waits, and nothing is lost or exchanged.
TEST(NctNetwork, TheDeviceIsNotTakenMoreFromThanTheProgramReceives) {
  NctMachine machine;
  ASSERT_EQ(machine.ask(true, 60, {5, 1, 0, 2, kOutside, 49202}), 0);
  ASSERT_EQ(device(machine, {word("open", "client"), number("port", 49202)}), "");
  int sent = 0;
  while (sent < 100 && device(machine, {number("send", 350), number("w0", sent)}).empty()) ++sent;
  EXPECT_EQ(sent, 11);
  for (int i = 0; i < sent; ++i) {
    ASSERT_EQ(machine.ask(false, 62, {3, 1, 6000, 350}), 0);
    EXPECT_EQ(machine.word(6000), i);
  }
}

TEST(NctNetwork, OneClientWaitsForTheNextConnection) {
  NctMachine machine;
  ASSERT_EQ(machine.ask(true, 60, {5, 1, 0, 2, kOutside, 49202}), 0);
  for (int i = 0; i < 2; ++i) {
    ASSERT_EQ(device(machine, {word("open", "client"), number("port", 49202)}), "");
    ASSERT_EQ(device(machine, {number("send", 1), number("w0", i)}), "");
    ASSERT_EQ(device(machine, {number("close", 1)}), "");
  }
  EXPECT_EQ(device(machine, {word("open", "client"), number("port", 49202)}), "no server listens on port 49202");
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(machine.ask(false, 62, {4, 1, 6000, 1}), 0);
    EXPECT_EQ(machine.word(6000), i);
    EXPECT_EQ(machine.ask(false, 62, {4, 1, 6000, 1}), 62);
    EXPECT_EQ(machine.blockWord(5), nct::kWindowsDisconnected);
  }
  EXPECT_EQ(machine.ask(false, 62, {4, 1, 6000, 1}), 65); // the server listens
  EXPECT_EQ(device(machine, {word("open", "client"), number("port", 49202)}), "");
}

TEST(NctNetwork, ADatagramForAClosedPortIsLost) {
  NctMachine machine;
  ASSERT_EQ(machine.ask(true, 60, {5, 1, 0, 1, kOutside, 49202}), 0);
  ASSERT_EQ(device(machine, {word("open", "udp"), number("port", 49300)}), "");
  EXPECT_EQ(machine.ask(true, 63, {3, 1, 6000, 1}), 0); // to 49202
  EXPECT_EQ(machine.nc().quantity("DEVICE.WORDS"), 0);
  EXPECT_EQ(machine.ask(true, 63, {6, 1, 6000, 1, 0, 0, 49300}), 0);
  EXPECT_EQ(machine.nc().quantity("DEVICE.WORDS"), 1);
}

TEST(NctNetwork, AStreamThatTheDeviceHasClosedTakesNothing) {
  NctMachine machine;
  ASSERT_EQ(device(machine, {word("open", "server"), number("port", 49202)}), "");
  ASSERT_EQ(machine.ask(true, 60, {5, 1, 0, 3, kOutside, 49202}, 2), 0);
  ASSERT_EQ(device(machine, {number("close", 1)}), "");
  EXPECT_EQ(machine.ask(true, 63, {4, 1, 6000, 1}), 62);
  EXPECT_EQ(machine.blockWord(5), nct::kWindowsReset);
}

TEST(NctNetwork, LoopbackReachesOtherPrograms) {
  NctMachine machine(kLoopback);
  Socket partner;
  ASSERT_EQ(partner.openUdp({kHome, 0}), 0);
  const uint16_t own = freePort();
  ASSERT_EQ(machine.ask(true, 60, {5, 1, 0, 1, static_cast<int32_t>(kHome), own}), 0);
  machine.setWord(6000, 0x04030201);
  ASSERT_EQ(machine.ask(true, 63, {6, 1, 6000, 1, 0, 0, partner.port()}), 0);
  ASSERT_TRUE(partner.readable(kPatienceMs));
  std::array<uint8_t, 8> bytes{};
  const nct::Received received = partner.receive(bytes);
  EXPECT_EQ(received.bytes, 4u);
  EXPECT_EQ(bytes[0], 1);
  EXPECT_EQ(bytes[3], 4);
  EXPECT_EQ(received.from.port, own);

  const uint8_t answer[6] = {1, 0, 0, 0, 2, 0}; // not a whole word
  ASSERT_EQ(partner.sendTo(answer, {kHome, own}).bytes, 6u);
  EXPECT_EQ(machine.ask(false, 62, {6, 1, 6100, 350}), 0);
  EXPECT_EQ(machine.word(6100), 1);
  EXPECT_EQ(machine.word(6101), 2);
  EXPECT_EQ(machine.blockWord(6), static_cast<int32_t>(kHome));
  EXPECT_EQ(machine.blockWord(7), partner.port());
}

TEST(NctNetwork, LoopbackReachesNothingElse) {
  NctMachine machine(kLoopback);
  EXPECT_EQ(machine.ask(true, 60, {5, 1, 0, 3, kOutside, 49202}), 61);
  EXPECT_EQ(machine.blockWord(3), nct::kWindowsUnreachable);
  ASSERT_EQ(machine.ask(true, 60, {5, 1, 0, 1, kOutside, freePort()}), 0);
  EXPECT_EQ(machine.ask(true, 63, {4, 1, 6000, 1}), 62);
  EXPECT_EQ(machine.blockWord(5), nct::kWindowsUnreachable);
}

TEST(NctNetwork, APortThatIsTakenFailsTheOpening) {
  NctMachine machine(kLoopback);
  Socket taken;
  ASSERT_EQ(taken.listen({kHome, 0}), 0);
  EXPECT_EQ(machine.ask(true, 60, {5, 1, 0, 2, static_cast<int32_t>(kHome), taken.port()}), 61);
  EXPECT_EQ(machine.blockWord(3), 10048);
  EXPECT_EQ(machine.ask(false, 62, {3, 1, 6000, 1}), 63);
}

// A partner that resets the connection: closed with data unread.
TEST(NctNetwork, ABrokenStreamIsAnErrorAndClosed) {
  NctMachine machine(kLoopback);
  Socket listener;
  ASSERT_EQ(listener.listen({kHome, 0}), 0);
  ASSERT_EQ(machine.ask(true, 60, {5, 1, 0, 3, static_cast<int32_t>(kHome), listener.port()}, 2), 0);
  ASSERT_TRUE(listener.readable(kPatienceMs));
  Socket partner = listener.accept();
  ASSERT_EQ(machine.ask(true, 63, {4, 1, 6000, 100}), 0);
  ASSERT_TRUE(partner.readable(kPatienceMs));
  partner.close();
  int64_t code = 65;
  for (int i = 0; i < 100 && code == 65; ++i) code = machine.ask(false, 62, {4, 1, 6000, 1});
  EXPECT_EQ(code, 62);
  EXPECT_EQ(machine.blockWord(5), 10054);
  EXPECT_EQ(machine.ask(false, 62, {4, 1, 6000, 1}), 63);
}

// A stream that nobody reads: what has no room waits, the requests behind it too, and nothing is lost.
TEST(NctNetwork, AFullStreamHoldsUpOnlyItself) {
  NctMachine machine(kLoopback);
  Socket listener;
  ASSERT_EQ(listener.listen({kHome, 0}), 0);
  ASSERT_EQ(machine.ask(true, 60, {5, 1, 0, 3, static_cast<int32_t>(kHome), listener.port()}, 2), 0);
  ASSERT_TRUE(listener.readable(kPatienceMs));
  Socket partner = listener.accept();
  uint64_t sent = 0;
  uint32_t ticket = 0;
  for (int i = 0; i < 20000 && ticket == 0; ++i) {
    machine.setWord(6000, i);
    const uint32_t request = machine.request(true, 63, {3, 1, 6000, 350});
    machine.scan();
    if (machine.answer(request) == 0)
      sent += 1400;
    else
      ticket = request;
  }
  ASSERT_NE(ticket, 0u) << "the stream never became full";
  uint64_t received = 0;
  uint32_t expected = 0;
  std::vector<uint8_t> bytes(1400);
  std::vector<uint8_t> rest;
  for (int i = 0; i < 100000 && received < sent + 1400; ++i) {
    machine.scan();
    const nct::Received got = partner.receive(bytes);
    for (size_t k = 0; k < got.bytes; ++k) {
      const uint64_t at = (received + k) % 1400;
      if (at < 4) rest.push_back(bytes[k]);
      if (rest.size() < 4) continue;
      uint32_t number = 0;
      std::memcpy(&number, rest.data(), 4);
      EXPECT_EQ(number, expected++);
      rest.clear();
    }
    received += got.bytes;
  }
  EXPECT_EQ(received, sent + 1400);
  EXPECT_EQ(machine.answer(ticket), 0);
}

TEST(NctNetwork, ClosedByARestart) {
  NctMachine machine;
  ASSERT_EQ(machine.ask(true, 60, {5, 1, 0, 1, kOutside, 49202}), 0);
  ASSERT_EQ(machine.ask(false, 62, {3, 1, 6000, 1}), 65);
  machine.machine().powerOn(rung::nc::PowerOn::Warm);
  EXPECT_EQ(machine.ask(false, 62, {3, 1, 6000, 1}), 63);
}

} // namespace

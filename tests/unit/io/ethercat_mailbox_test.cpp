// Mailboxes of simulated EtherCAT slaves: ECAT_COE_READ, _WRITE, ECAT_SOE_READ, _WRITE (TECHNOL manual 26.4, l.17985-
// 18166), and codes of what cannot be done.
#include <gmock/gmock.h>

#include "tests/unit/io/ethercat_net.h"

namespace {

using namespace rung::io::ethercat;
using rung::test::EthercatNet;
using testing::ElementsAre;
using Bytes = std::vector<uint8_t>;

struct EthercatMailbox : testing::Test {
  EthercatMailbox() { EXPECT_EQ(net.problems, ""); }

  EthercatNet net{{"ethercat.0", "coe+soe"},
                  {"ethercat.0.coe.0x6041.0", "0x237/2 ro"},
                  {"ethercat.0.coe.0x6040.0", "0/2"},
                  {"ethercat.0.coe.0x1010.1", "5 wo"},
                  {"ethercat.0.soe.99.0", "0/2"},
                  {"ethercat.0.soe.47.1", "100/4 min=-100 max=1000"},
                  {"ethercat.0.soe.48.0", "7/4 ro"},
                  {"ethercat.0.soe.49.0", "7/1 min=5 max=9"},
                  {"ethercat.1", "soe"}};
};

// The example of l.18070-18082: the status word, two bytes wanted. 5 ms: in the next scan.
TEST_F(EthercatMailbox, AnObjectIsRead) {
  const Answer answer = net.finish(net.net.upload({0, 0}, 0x6041, 0, 2));
  EXPECT_EQ(answer.code, 0u);
  EXPECT_EQ(answer.length, 2u);
  EXPECT_THAT(net.data, ElementsAre(0x37, 0x02));
  EXPECT_EQ(net.tookMs, 5);
}

TEST_F(EthercatMailbox, NoMoreThanWantedAndNoMoreThanThereIs) {
  EXPECT_EQ(net.finish(net.net.upload({0, 0}, 0x6041, 0, 1)).length, 1u);
  EXPECT_THAT(net.data, ElementsAre(0x37));
  EXPECT_EQ(net.finish(net.net.upload({0, 0}, 0x6041, 0, 4)).length, 2u);
  EXPECT_EQ(net.finish(net.net.upload({0, 0}, 0x6041, 0, 0)).length, 0u);
}

TEST_F(EthercatMailbox, AnObjectIsWritten) {
  const Answer answer = net.finish(net.net.download({0, 0}, 0x6040, 0, Bytes{0x0F, 0x01}));
  EXPECT_EQ(answer.code, 0u);
  EXPECT_EQ(answer.length, 2u);
  EXPECT_TRUE(answer.data.empty());
  EXPECT_EQ(net.net.object(0, 0x6040, 0), 0x10Fu);
}

TEST_F(EthercatMailbox, AccessToObjectsIsChecked) {
  EXPECT_EQ(net.upload(0, 0x6042, 0), 0x06020000u);
  EXPECT_EQ(net.upload(0, 0x6041, 1), 0x06090011u);
  EXPECT_EQ(net.upload(0, 0x1010, 1), 0x06010001u);
  EXPECT_EQ(net.download(0, 0x6041, 0, {1, 0}), 0x06010002u);
  EXPECT_EQ(net.download(0, 0x6040, 0, {1}), 0x06070010u);
  EXPECT_EQ(net.download(0, 0x6040, 0, {1, 2, 3}), 0x06070010u);
  EXPECT_EQ(net.download(0, 0x6040, 0, Bytes(2000)), 0x06070010u);
  EXPECT_EQ(net.download(0, 0x6040, 0, {}), 0x06070010u);
  EXPECT_EQ(net.download(0, 0x1010, 1, {1, 2, 3, 4}), 0u);
  EXPECT_EQ(net.net.object(0, 0x6041, 0), 0x237u);
  EXPECT_EQ(net.net.object(0, 0x1010, 1), 0x04030201u);
}

// The example of l.18127-18151: errors are cleared by IDN S-0-0099, 3 in two bytes.
TEST_F(EthercatMailbox, AnIdnIsWritten) {
  const Answer answer = net.finish(net.net.writeIdn({0, 0}, 0, kOperationData, 99, Bytes{3, 0}));
  EXPECT_EQ(answer.code, 0u);
  EXPECT_EQ(answer.length, 2u);
  EXPECT_EQ(answer.elements, kOperationData);
  EXPECT_EQ(net.net.idn(0, 99, 0), 3u);
}

TEST_F(EthercatMailbox, ElementsOfAnIdnAreRead) {
  ASSERT_TRUE(net.net.setIdn(0, 47, 1, 0xFFFFFFFF)); // -1
  const auto read = [&](uint8_t elements) { return net.finish(net.net.readIdn({0, 0}, 1, elements, 47, 64)); };
  EXPECT_EQ(read(0x40).elements, 0x40);
  EXPECT_THAT(net.data, ElementsAre(0xFF, 0xFF, 0xFF, 0xFF));
  EXPECT_EQ(read(0x80).length, 4u);
  EXPECT_THAT(net.data, ElementsAre(100, 0, 0, 0));
  EXPECT_EQ(read(0x30).length, 8u); // minimum, then maximum
  EXPECT_THAT(net.data, ElementsAre(0x9C, 0xFF, 0xFF, 0xFF, 0xE8, 0x03, 0, 0));
  EXPECT_EQ(read(0x02).length, 12u);
  EXPECT_EQ(std::string(net.data.begin() + 4, net.data.end()), "IDN00047");
  EXPECT_EQ(read(0xFF).length, 2u + 12 + 4 + 4 + 4 + 4 + 4 + 4);
  EXPECT_EQ(read(0).code, 0x1009u);
  EXPECT_EQ(net.finish(net.net.readIdn({0, 0}, 1, 0x30, 47, 5)).length, 5u);
}

TEST_F(EthercatMailbox, AccessToIdnsIsChecked) {
  const auto write = [&](uint8_t drive, uint16_t idn, const Bytes& data, uint8_t elements = kOperationData) {
    return net.finish(net.net.writeIdn({0, 0}, drive, elements, idn, data)).code;
  };
  EXPECT_EQ(net.finish(net.net.readIdn({0, 0}, 0, 0x40, 47, 4)).code, 0x1001u); // drive 1 has it
  EXPECT_EQ(write(1, 46, {0, 0, 0, 0}), 0x1001u);
  EXPECT_EQ(write(1, 47, {0, 0}), 0x7002u);
  EXPECT_EQ(write(1, 47, {0, 0, 0, 0, 0}), 0x7003u);
  EXPECT_EQ(write(1, 47, Bytes(1025)), 0x7003u);
  EXPECT_EQ(write(0, 48, {0, 0, 0, 0}), 0x7004u);
  EXPECT_EQ(write(1, 47, {0, 0, 0, 0}, 0x10), 0x7004u);
  EXPECT_EQ(write(1, 47, {0, 0, 0, 0}, 0), 0x1009u);
  EXPECT_EQ(write(1, 47, {0x9B, 0xFF, 0xFF, 0xFF}), 0x7006u); // -101
  EXPECT_EQ(write(1, 47, {0x9C, 0xFF, 0xFF, 0xFF}), 0u);
  EXPECT_EQ(write(1, 47, {0xE9, 0x03, 0, 0}), 0x7007u); // 1001
  EXPECT_EQ(write(1, 47, {0xE8, 0x03, 0, 0}), 0u);
  EXPECT_EQ(write(0, 49, {4}), 0x7006u);
  EXPECT_EQ(write(0, 49, {10}), 0x7007u);
  EXPECT_EQ(write(0, 49, {5}), 0u);
  EXPECT_EQ(net.net.idn(0, 49, 0), 5u);
}

TEST_F(EthercatMailbox, WhoIsNotThereDoesNotAnswer) {
  EXPECT_EQ(net.finish(net.net.upload({1, 0}, 0x6041, 0, 2)).code, kNoMaster);
  EXPECT_EQ(net.upload(2, 0x6041, 0), kNoSlave);
  EXPECT_EQ(net.upload(1, 0x6041, 0), kNoMailbox); // soe only
  EXPECT_EQ(net.finish(net.net.readIdn({0, 1}, 0, 0x40, 1, 4)).code, 0x1001u);
  EthercatNet none;
  EXPECT_EQ(none.upload(0, 0x6041, 0), kNoMaster);
  EXPECT_EQ(none.command(kMasterState), kNoMaster);
  EXPECT_EQ(none.command(8), kNoMaster);
  EXPECT_FALSE(none.bits.isOperational);
}

TEST_F(EthercatMailbox, InInitAndBootstrapThereIsNone) {
  for (const uint32_t state : {11, 13}) {
    ASSERT_EQ(net.command(state, 0), 0u);
    EXPECT_EQ(net.upload(0, 0x6041, 0), kNoMailbox) << state;
  }
  ASSERT_EQ(net.command(11, 0), 0u);
  ASSERT_EQ(net.command(12, 0), 0u);
  EXPECT_EQ(net.upload(0, 0x6041, 0), 0u);
}

TEST_F(EthercatMailbox, ErrorsAreInjectedUntilTheyAreTakenAway) {
  ASSERT_EQ(net.net.setError(0, 0x08000022), "");
  EXPECT_EQ(net.upload(0, 0x6041, 0), 0x08000022u);
  EXPECT_EQ(net.download(0, 0x6040, 0, {1, 0}), 0x08000022u);
  EXPECT_EQ(net.net.object(0, 0x6040, 0), 0u);
  ASSERT_EQ(net.net.setError(0, 0), "");
  EXPECT_EQ(net.upload(0, 0x6041, 0), 0u);
}

TEST_F(EthercatMailbox, ASilentSlaveTimesOutAfterASecond) {
  ASSERT_EQ(net.net.setSilent(0, true), "");
  EXPECT_EQ(net.upload(0, 0x6041, 0), kTimedOut);
  EXPECT_EQ(net.tookMs, 1000);
  EXPECT_EQ(net.command(kSlaveState, 0), kTimedOut);
  const uint32_t ticket = net.net.upload({0, 0}, 0x6041, 0, 2);
  net.ticks(500);
  ASSERT_EQ(net.net.setSilent(0, false), ""); // it answers again before the time is over
  EXPECT_EQ(net.finish(ticket).code, 0u);
}

TEST_F(EthercatMailbox, WithoutTheCableNobodyAnswers) {
  const uint32_t ticket = net.net.upload({0, 0}, 0x6041, 0, 2);
  net.ticks(2);
  net.net.setLink(false);
  EXPECT_EQ(net.finish(ticket).code, kNoSlave);
  EXPECT_EQ(net.upload(0, 0x6041, 0), kNoSlave);
  net.net.setLink(true);
  EXPECT_EQ(net.upload(0, 0x6041, 0), kNoMailbox); // in INIT since then
}

// MECH_INIT: the answer of a read is dropped, a write that was begun is carried out.
TEST_F(EthercatMailbox, ForgottenRequestsAreCarriedOut) {
  const uint32_t ticket = net.net.download({0, 0}, 0x6040, 0, Bytes{6, 0});
  net.net.forget(ticket);
  net.ticks(4);
  EXPECT_EQ(net.net.object(0, 0x6040, 0), 0u);
  net.ticks(1);
  EXPECT_EQ(net.net.object(0, 0x6040, 0), 6u);
  EXPECT_EQ(net.net.poll(ticket).code, kNoMaster); // nobody knows it any more
}

TEST_F(EthercatMailbox, WritesOfOneScanKeepTheirOrder) {
  const uint32_t first = net.net.download({0, 0}, 0x6040, 0, Bytes{1, 0});
  const uint32_t second = net.net.download({0, 0}, 0x6040, 0, Bytes{2, 0});
  net.finish(first); // its place is free for the next
  const uint32_t third = net.net.download({0, 0}, 0x6040, 0, Bytes{3, 0});
  const uint32_t fourth = net.net.download({0, 0}, 0x6040, 0, Bytes{4, 0});
  for (const uint32_t ticket : {second, third, fourth}) EXPECT_EQ(net.finish(ticket).code, 0u);
  EXPECT_EQ(net.net.object(0, 0x6040, 0), 4u);
}

TEST_F(EthercatMailbox, SixtyFourRequestsAtATime) {
  std::vector<uint32_t> tickets;
  for (int i = 0; i < 64; ++i) tickets.push_back(net.net.upload({0, 0}, 0x6041, 0, 2));
  EXPECT_EQ(net.net.upload({0, 0}, 0x6041, 0, 2), 0u);
  for (const uint32_t ticket : tickets) EXPECT_EQ(net.finish(ticket).code, 0u);
  EXPECT_NE(net.net.upload({0, 0}, 0x6041, 0, 2), 0u);
}

TEST_F(EthercatMailbox, PowerOffForgetsRequestsAndWhatWasWritten) {
  ASSERT_EQ(net.download(0, 0x6040, 0, {7, 0}), 0u);
  ASSERT_EQ(net.net.setSilent(0, true), "");
  const uint32_t ticket = net.net.download({0, 0}, 0x6040, 0, Bytes{6, 0});
  net.ticks(2);
  net.net.powerOn();
  net.ticks(20);
  EXPECT_EQ(net.net.poll(ticket).code, kNoMaster);
  EXPECT_EQ(net.net.object(0, 0x6040, 0), 0u);
  EXPECT_EQ(net.upload(0, 0x6041, 0), 0u); // not silent any more
}

TEST(EthercatWithoutMaster, AllRequestsEndAtOnce) {
  Master& none = noMaster();
  const Bytes data{1};
  for (const Master::Ticket ticket :
       {none.upload({}, 1, 0, 1), none.download({}, 1, 0, data), none.readIdn({}, 0, 0x40, 1, 1),
        none.writeIdn({}, 0, 0x40, 1, data), none.command({}, kMasterState)}) {
    ASSERT_NE(ticket, 0u);
    EXPECT_TRUE(none.poll(ticket).isDone);
    EXPECT_EQ(none.poll(ticket).code, kNoMaster);
    none.forget(ticket);
  }
  StateRequests requests(none);
  StateBits bits{.operationalRequest = true};
  for (int i = 0; i < 100; ++i) requests.tick(bits);
  EXPECT_TRUE(bits.operationalRequest);
  EXPECT_FALSE(bits.isOperational);
}

} // namespace

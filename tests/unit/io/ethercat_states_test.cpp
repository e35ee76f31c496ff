// States of the simulated EtherCAT master and its slaves: start, request bits, ECAT_COMMAND, process data (TECHNOL
// manual l.17741-17755, l.17906-17985, l.18168-18262).
#include <gmock/gmock.h>

#include "tests/unit/io/ethercat_net.h"

namespace {

using namespace rung::io::ethercat;
using rung::test::EthercatNet;

// ---- start -------------------------------------------------------------------------------------------------------

TEST(EthercatStart, TheMasterIsOperationalInTheFirstScan) {
  EthercatNet net{{"ethercat.0", "coe"}, {"ethercat.1", "soe"}};
  net.scans(1);
  EXPECT_TRUE(net.bits.isOperational);
  EXPECT_EQ(net.net.state(), State::Operational);
  EXPECT_EQ(net.net.slaveState(1), State::Operational);
  EXPECT_EQ(net.net.slaveState(2), std::nullopt);
}

TEST(EthercatStart, OrAfterItsDelay) {
  EthercatNet net{{"ethercat.0", "coe"}, {"EtherCATDelayOP", "500"}};
  net.ticks(499);
  EXPECT_FALSE(net.bits.isOperational);
  EXPECT_EQ(net.net.state(), State::SafeOperational);
  net.ticks(1);
  EXPECT_TRUE(net.bits.isOperational);
}

TEST(EthercatStart, TheDelayEndsWhenTheProgramOrdersAState) {
  EthercatNet net{{"ethercat.0", "coe"}, {"EtherCATDelayOP", "100"}};
  net.bits.initRequest = true;
  net.ticks(200);
  EXPECT_EQ(net.net.state(), State::Init);
}

TEST(EthercatStart, ASlaveThatRefusesHoldsTheMaster) {
  EthercatNet net{{"ethercat.0", "coe"}, {"ethercat.1", "coe"}, {"ethercat.1.refuse", "4"}};
  net.scans(1);
  EXPECT_EQ(net.net.state(), State::PreOperational);
  EXPECT_FALSE(net.bits.isOperational);
}

// INIT until flEcatStartCyclicOperation, then up by itself (l.17918-17930). The bit stays.
TEST(EthercatStart, TheProgramStartsTheExchange) {
  EthercatNet net{{"ethercat.0", "coe"}, {"EtherCATOPViaPLC", "1"}};
  net.scans(5);
  EXPECT_EQ(net.net.state(), State::Init);
  net.bits.startCyclicOperation = true;
  net.scans(1);
  EXPECT_FALSE(net.bits.isOperational);
  net.scans(1);
  EXPECT_TRUE(net.bits.isOperational);
  EXPECT_TRUE(net.bits.startCyclicOperation);
  net.bits.initRequest = true; // the bit that stays does not start it again
  net.scans(10);
  EXPECT_EQ(net.net.state(), State::Init);
  net.net.powerOn();
  net.scans(2);
  EXPECT_TRUE(net.bits.isOperational);
}

TEST(EthercatStart, TheBitCountsForNothingWhereTheControlStarts) {
  EthercatNet net{{"ethercat.0", "coe"}};
  net.bits.initRequest = true;
  net.scans(2);
  net.bits.startCyclicOperation = true;
  net.scans(5);
  EXPECT_EQ(net.net.state(), State::Init);
}

// ---- request bits ------------------------------------------------------------------------------------------------

TEST(EthercatRequestBits, AreResetWhenTheStateIsReached) {
  EthercatNet net{{"ethercat.0", "coe"}, {"ethercat.1", "soe"}};
  net.bits.preOperationalRequest = true;
  net.scans(1);
  EXPECT_FALSE(net.bits.preOperationalRequest);
  EXPECT_FALSE(net.bits.isOperational);
  EXPECT_EQ(net.net.state(), State::PreOperational);
  EXPECT_EQ(net.net.slaveState(0), State::PreOperational);
  net.bits.initRequest = true;
  net.scans(1);
  net.bits.bootstrapRequest = true;
  net.scans(1);
  EXPECT_FALSE(net.bits.bootstrapRequest);
  EXPECT_EQ(net.net.slaveState(1), State::Bootstrap);
  net.bits.initRequest = true;
  net.scans(1);
  net.bits.operationalRequest = true;
  net.scans(1);
  EXPECT_TRUE(net.bits.operationalRequest); // three steps of 10 ms: in the second scan
  net.scans(1);
  EXPECT_FALSE(net.bits.operationalRequest);
  EXPECT_TRUE(net.bits.isOperational);
}

TEST(EthercatRequestBits, StayWhereASlaveRefuses) {
  EthercatNet net{{"ethercat.0", "coe"}, {"ethercat.1", "coe"}, {"ethercat.1.refuse", "8"}};
  net.bits.operationalRequest = true;
  net.scans(20);
  EXPECT_TRUE(net.bits.operationalRequest);
  EXPECT_EQ(net.net.state(), State::SafeOperational);
  EXPECT_EQ(net.net.slaveState(0), State::Operational); // by which the other one is found
  EXPECT_EQ(net.net.slaveState(1), State::SafeOperational);
  net.bits.preOperationalRequest = true; // served all the same
  net.scans(3);
  EXPECT_FALSE(net.bits.preOperationalRequest);
}

TEST(EthercatRequestBits, SeveralAreServedFromInitUp) {
  EthercatNet net{{"ethercat.0", "coe"}};
  net.bits = {.bootstrapRequest = true,
              .initRequest = true,
              .preOperationalRequest = true,
              .safeOperationalRequest = true,
              .operationalRequest = true};
  std::vector<State> seen{net.net.state()};
  for (int i = 0; i < 2000; ++i) {
    net.ticks(1);
    if (net.net.state() != seen.back()) seen.push_back(net.net.state());
  }
  // From BOOTSTRAP nothing but INIT is reached, so that the last three stay.
  EXPECT_THAT(seen, testing::ElementsAre(State::Operational, State::Init, State::Bootstrap));
  EXPECT_FALSE(net.bits.initRequest || net.bits.bootstrapRequest);
  EXPECT_TRUE(net.bits.preOperationalRequest && net.bits.safeOperationalRequest && net.bits.operationalRequest);
  net.bits.initRequest = true;
  net.scans(20);
  EXPECT_TRUE(net.bits.isOperational);
  EXPECT_FALSE(net.bits.preOperationalRequest || net.bits.safeOperationalRequest || net.bits.operationalRequest);
}

TEST(EthercatRequestBits, TheCable) {
  EthercatNet net{{"ethercat.0", "coe"}};
  net.scans(1);
  net.net.setLink(false);
  net.ticks(1);
  EXPECT_FALSE(net.bits.isOperational);
  EXPECT_EQ(net.net.state(), State::Init);
  net.bits.operationalRequest = true;
  net.scans(5);
  EXPECT_TRUE(net.bits.operationalRequest);
  net.net.setLink(true);
  net.scans(3);
  EXPECT_FALSE(net.bits.operationalRequest);
  EXPECT_TRUE(net.bits.isOperational);
}

TEST(EthercatRequestBits, PowerOffInTheMiddle) {
  EthercatNet net{{"ethercat.0", "coe"}, {"EtherCATOPViaPLC", "1"}};
  net.bits.operationalRequest = true;
  net.ticks(15);
  EXPECT_EQ(net.net.state(), State::PreOperational);
  net.net.powerOn();
  EXPECT_EQ(net.net.state(), State::Init);
  net.bits.operationalRequest = false;
  net.scans(10);
  EXPECT_EQ(net.net.state(), State::Init);
}

// ---- ECAT_COMMAND ------------------------------------------------------------------------------------------------

// The example of l.18234-18262: the second slave to SAFE-OPERATIONAL, and its state.
TEST(EthercatCommand, AStateOfOneSlave) {
  EthercatNet net{{"ethercat.0", "coe"}, {"ethercat.1", "coe"}};
  EXPECT_EQ(net.command(14, 1), 0u);
  EXPECT_EQ(net.command(kSlaveState, 1), 0u);
  EXPECT_THAT(net.data, testing::ElementsAre(4));
  EXPECT_EQ(net.command(kSlaveState, 0), 0u);
  EXPECT_THAT(net.data, testing::ElementsAre(8));
  EXPECT_EQ(net.command(kMasterState, 99), 0u); // the slave counts for nothing
  EXPECT_THAT(net.data, testing::ElementsAre(8));
}

TEST(EthercatCommand, UpByStepsDownAtOnce) {
  EthercatNet net{{"ethercat.0", "coe"}};
  EXPECT_EQ(net.command(1), 0u);
  EXPECT_EQ(net.tookMs, 10);
  EXPECT_EQ(net.command(8), 0u);
  EXPECT_EQ(net.tookMs, 30);
  EXPECT_EQ(net.command(8), 0u); // there already
  EXPECT_EQ(net.tookMs, 10);
  EXPECT_EQ(net.command(2), 0u);
  EXPECT_EQ(net.tookMs, 10);
  EXPECT_EQ(net.command(4), 0u);
  EXPECT_EQ(net.command(11, 0), 0u);
  EXPECT_EQ(net.command(18, 0), 0u);
  EXPECT_EQ(net.tookMs, 30);
}

TEST(EthercatCommand, BootstrapOnlyFromInitAndToIt) {
  EthercatNet net{{"ethercat.0", "coe"}};
  EXPECT_EQ(net.command(3), kStateRefused);
  EXPECT_EQ(net.command(13, 0), kStateRefused);
  EXPECT_EQ(net.command(1), 0u);
  EXPECT_EQ(net.command(3), 0u);
  EXPECT_EQ(net.command(8), kStateRefused);
  EXPECT_EQ(net.command(12, 0), kStateRefused);
  EXPECT_EQ(net.command(1), 0u);
}

TEST(EthercatCommand, TheMasterTakesAllSlavesAlong) {
  EthercatNet net{{"ethercat.0", "coe"}, {"ethercat.1", "coe"}};
  EXPECT_EQ(net.command(11, 1), 0u);
  EXPECT_EQ(net.command(8), 0u); // the master is there, its slave is not
  EXPECT_EQ(net.net.slaveState(1), State::Operational);
}

TEST(EthercatCommand, OneAfterTheOther) {
  EthercatNet net{{"ethercat.0", "coe"}};
  ASSERT_EQ(net.command(1), 0u);
  const uint32_t up = net.net.command({0, 0}, 8);
  const uint32_t down = net.net.command({0, 0}, 12);
  net.ticks(31);
  EXPECT_TRUE(net.net.poll(up).isDone);
  EXPECT_FALSE(net.net.poll(down).isDone);
  EXPECT_EQ(net.net.slaveState(0), State::Operational);
  EXPECT_EQ(net.finish(down).code, 0u);
  EXPECT_EQ(net.net.slaveState(0), State::PreOperational);
}

TEST(EthercatCommand, WrongOnes) {
  EthercatNet net{{"ethercat.0", "coe"}, {"ethercat.0.refuse", "8"}};
  for (const uint32_t wrong : {0, 5, 6, 7, 9, 10, 15, 16, 17, 19, 22, 255}) {
    EXPECT_EQ(net.command(wrong), kUnknownCommand) << wrong;
    EXPECT_LE(net.tookMs, 20);
  }
  EXPECT_EQ(net.command(18, 1), kNoSlave);
  EXPECT_EQ(net.command(kSlaveState, 1), kNoSlave);
  EXPECT_EQ(net.command(18, 0), kStateRefused);
  EXPECT_EQ(net.finish(net.net.command({1, 0}, 8)).code, kNoMaster);
  net.net.setLink(false);
  EXPECT_EQ(net.command(8), kNoSlave);
  EXPECT_EQ(net.command(kMasterState), kNoSlave);
}

TEST(EthercatCommand, ASilentSlaveTimesOut) {
  EthercatNet net{{"ethercat.0", "coe"}, {"ethercat.1", "coe"}};
  ASSERT_EQ(net.net.setSilent(1, true), "");
  EXPECT_EQ(net.command(2), kTimedOut);
  EXPECT_EQ(net.tookMs, 1000);
  EXPECT_EQ(net.net.state(), State::Operational);
  ASSERT_EQ(net.net.setSilent(1, false), "");
  EXPECT_EQ(net.command(2), 0u);
}

// ---- process data ------------------------------------------------------------------------------------------------

struct EthercatProcessData : testing::Test {
  EthercatProcessData() {
    EXPECT_EQ(net.problems, "");
    status = net.net.image().find("ECAT.Drive_0.Inputs.Status word");
    control = net.net.image().find("ecat.drive 0.outputs.control_word");
    EXPECT_NE(status, UINT32_MAX);
    EXPECT_NE(control, UINT32_MAX);
  }
  EthercatNet net{{"ethercat.0", "coe"},
                  {"ethercat.0.name", "Drive_0"},
                  {"ethercat.0.coe.0x6041.0", "0x237/2 ro"},
                  {"ethercat.0.coe.0x6040.0", "5/2"},
                  {"ethercat.0.pdo.Inputs.Status_word", "0x6041.0"},
                  {"ethercat.0.pdo.Outputs.Control_word", "0x6040.0"}};
  uint32_t status = 0, control = 0;
};

TEST_F(EthercatProcessData, EntriesAreFoundByTheirNames) {
  const auto& image = net.net.image();
  EXPECT_TRUE(image[status].isInput);
  EXPECT_EQ(image.bytesOf(status), 2u);
  EXPECT_EQ(image.find("ECAT.Drive 0.Outputs.Status word"), UINT32_MAX);
  EXPECT_EQ(image.find("ECAT.Drive 1.Inputs.Status word"), UINT32_MAX);
  EXPECT_EQ(image.find("ECAT"), UINT32_MAX);
}

TEST_F(EthercatProcessData, InputsComeFromSafeOperationalOnOutputsInOperational) {
  net.ticks(1);
  EXPECT_EQ(net.net.image().read(status), 0x237u);
  net.net.image().write(control, 0x1000F);
  net.ticks(1);
  EXPECT_EQ(net.net.object(0, 0x6040, 0), 0xFu); // its two bytes
  ASSERT_EQ(net.command(4), 0u);
  net.net.image().write(control, 7);
  ASSERT_TRUE(net.net.setObject(0, 0x6041, 0, 1));
  net.ticks(1);
  EXPECT_EQ(net.net.image().read(status), 1u);
  EXPECT_EQ(net.net.object(0, 0x6040, 0), 0xFu); // stays
  EXPECT_FALSE(net.net.image().isExchanged(control));
  ASSERT_EQ(net.command(2), 0u);
  ASSERT_TRUE(net.net.setObject(0, 0x6041, 0, 2));
  net.ticks(1);
  EXPECT_EQ(net.net.image().read(status), 1u); // stays
  ASSERT_EQ(net.command(8), 0u);
  net.ticks(1);
  EXPECT_EQ(net.net.image().read(status), 2u);
  EXPECT_EQ(net.net.object(0, 0x6040, 0), 7u);
}

TEST_F(EthercatProcessData, AnOutputThatNobodyWritesLeavesItsObject) {
  net.ticks(10);
  EXPECT_EQ(net.net.object(0, 0x6040, 0), 5u);
  net.net.image().write(status, 1); // an input
  net.ticks(1);
  EXPECT_EQ(net.net.image().read(status), 0x237u);
}

TEST_F(EthercatProcessData, WithoutLinkOrAnswerTheLastValuesStay) {
  net.ticks(1);
  for (const bool byCable : {false, true}) {
    if (byCable) net.net.setLink(false);
    ASSERT_EQ(net.net.setSilent(0, true), "");
    ASSERT_TRUE(net.net.setObject(0, 0x6041, 0, 9));
    net.net.image().write(control, 1);
    net.ticks(1);
    EXPECT_EQ(net.net.image().read(status), 0x237u);
    EXPECT_EQ(net.net.object(0, 0x6040, 0), 5u);
  }
  net.net.powerOn();
  EXPECT_EQ(net.net.image().read(status), 0u);
  net.ticks(1);
  EXPECT_EQ(net.net.image().read(status), 0x237u);
  EXPECT_EQ(net.net.object(0, 0x6040, 0), 5u);
}

} // namespace

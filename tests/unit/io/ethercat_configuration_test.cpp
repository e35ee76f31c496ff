// The configuration of simulated EtherCAT slaves: keys, what is wrong with them, events.
#include <gmock/gmock.h>

#include "tests/unit/io/ethercat_net.h"

namespace {

using rung::sim::technol::EtherCat;
using rung::test::EthercatNet;
using testing::HasSubstr;

TEST(EthercatConfiguration, KeysThatAreOurs) {
  for (const char* key : {"ethercat.0", "ethercat.0.coe.1.0", "EtherCATOPViaPLC", "EtherCATDelayOP"})
    EXPECT_TRUE(EtherCat::owns(key)) << key;
  for (const char* key : {"ethercat", "EtherCATDebug", "nc"}) EXPECT_FALSE(EtherCat::owns(key)) << key;
}

TEST(EthercatConfiguration, NumbersAndWidths) {
  EthercatNet net{{"ethercat.0", "coe+soe"},
                  {"ethercat.0.coe.24641.0", "567"}, // decimal, 4 bytes
                  {"ethercat.0.coe.0x6041.1", "-1/2"},
                  {"ethercat.0.coe.0x6041.2", "0xFFFFFFFFFFFFFFFF/8"},
                  {"ethercat.0.soe.32769.255", "0x0C/1  ro"}}; // P-0-1
  EXPECT_EQ(net.problems, "");
  EXPECT_EQ(net.net.object(0, 0x6041, 0), 567u);
  EXPECT_EQ(net.net.object(0, 0x6041, 1), 0xFFFFu);
  EXPECT_EQ(net.net.object(0, 0x6041, 2), UINT64_MAX);
  EXPECT_EQ(net.net.idn(0, 32769, 255), 12u);
  EXPECT_EQ(net.net.object(0, 0x6042, 0), std::nullopt);
  EXPECT_EQ(net.net.object(1, 0x6041, 0), std::nullopt);
  EXPECT_EQ(net.net.idn(0, 32769, 0), std::nullopt);
  EXPECT_TRUE(net.net.setObject(0, 0x6041, 1, 0x12345));
  EXPECT_EQ(net.net.object(0, 0x6041, 1), 0x2345u);
  EXPECT_FALSE(net.net.setObject(0, 0x6042, 0, 1));
  EXPECT_FALSE(net.net.setIdn(0, 1, 0, 1));
}

TEST(EthercatConfiguration, ALaterKeyCounts) {
  EthercatNet net{{"ethercat.0", "soe"},
                  {"ethercat.0", "coe"},
                  {"ethercat.0.ds402", "1"},
                  {"ethercat.0.coe.0x6041.0", "1/2"},
                  {"ethercat.0.ds402", "0"},
                  {"ethercat.0.refuse", "8"},
                  {"ethercat.0.refuse", "0"},
                  {"ethercat.0.name", "A"},
                  {"ethercat.0.pdo.Inputs.A", "0x6041.0"},
                  {"ethercat.0.pdo.Inputs.A", "0x6040.0"},
                  {"ethercat.0.name", "B.C"}};
  EXPECT_EQ(net.problems, "");
  net.ticks(20);
  EXPECT_EQ(net.net.object(0, 0x6041, 0), 1u); // not a drive
  EXPECT_TRUE(net.bits.isOperational);
  EXPECT_EQ(net.net.image().count(), 1u);
  EXPECT_EQ(net.net.image().find("ECAT.B.C.Inputs.A"), 0u);
  EXPECT_EQ(net.net.image().read(0), 0u);
}

TEST(EthercatConfiguration, SixtyFourSlaves) {
  EtherCat net;
  for (int i = 0; i < 64; ++i) ASSERT_EQ(net.configure("ethercat." + std::to_string(i), "coe"), "");
  EXPECT_THAT(net.configure("ethercat.64", "coe"), HasSubstr("at most 64"));
  net.powerOn();
  EXPECT_EQ(net.slaveState(63), rung::io::ethercat::State::Operational);
}

TEST(EthercatConfiguration, MistakesAreExplained) {
  EtherCat net;
  ASSERT_EQ(net.configure("ethercat.0", "coe"), "");
  ASSERT_EQ(net.configure("ethercat.1", "soe"), "");
  ASSERT_EQ(net.configure("ethercat.1.name", "A"), "");
  const auto wrong = [&](const char* key, const char* value, const char* expected) {
    EXPECT_THAT(net.configure(key, value), testing::AllOf(testing::StartsWith(key), HasSubstr(expected)))
        << key << " " << value;
  };
  wrong("ethercat.3", "coe", "the next one is 2");
  wrong("ethercat.x", "coe", "a number from 0");
  wrong("ethercat.2", "can", "coe, soe");
  wrong("ethercat.2", "coe+voe", "coe, soe");
  wrong("ethercat.2.name", "B", "no such device");
  wrong("ethercat.0.name", "A", "device 1 has this name");
  wrong("ethercat.0.name", "", "a name");
  wrong("ethercat.0.colour", "1", "not 'colour'");
  wrong("ethercat.0.coe.1", "1", "ethercat.DEVICE.coe.INDEX.SUBINDEX");
  wrong("ethercat.0.coe.0x10000.0", "1", "wrong number");
  wrong("ethercat.0.coe.1.256", "1", "wrong number");
  wrong("ethercat.0.coe.1.0", "1/9", "1 to 8 bytes");
  wrong("ethercat.0.coe.1.0", "x", "VALUE");
  wrong("ethercat.0.coe.1.0", "256/1", "more than 8 bits");
  wrong("ethercat.0.coe.1.0", "-129/1", "more than 8 bits");
  wrong("ethercat.0.coe.1.0", "1 rw", "'rw' is not an option");
  wrong("ethercat.0.coe.1.0", "1 min=0", "'min=0' is not an option");
  wrong("ethercat.1.soe.1.0", "1 wo", "'wo' is not an option");
  wrong("ethercat.1.soe.1.0", "1/1 max=256", "the limit");
  wrong("ethercat.1.coe.1.0", "1", "does not have this protocol");
  wrong("ethercat.0.soe.1.0", "1", "does not have this protocol");
  wrong("ethercat.1.ds402", "1", "needs the protocol coe");
  wrong("ethercat.0.ds402", "yes", "0 or 1");
  for (const char* state : {"1", "5", "16", "OP"}) wrong("ethercat.0.refuse", state, "2, 3, 4 or 8");
  wrong("ethercat.0.pdo.Inputs.A", "0x2041.0", "no object 0x2041.0 yet");
  wrong("ethercat.0.pdo.Inputs.A", "0x6041.1", "no object 0x6041.1 yet");
  wrong("ethercat.0.pdo.Inputs.A", "0x6041", "INDEX.SUBINDEX");
  wrong("ethercat.0.pdo.Inputs", "0x6041.0", "pdo.Inputs.ENTRY");
  wrong("ethercat.0.pdo.In.A", "0x6041.0", "pdo.Inputs.ENTRY");
  wrong("EtherCATOPViaPLC", "2", "0 or 1");
  wrong("EtherCATDelayOP", "-1", "milliseconds");
  wrong("EtherCATDebug", "7", "unknown key");
}

TEST(EthercatConfiguration, EventsNeedTheirDevice) {
  EthercatNet net{{"ethercat.0", "coe"}};
  EXPECT_THAT(net.net.setError(1, 5), HasSubstr("no EtherCAT device 1"));
  EXPECT_THAT(net.net.setSilent(1, true), HasSubstr("no EtherCAT device 1"));
  EXPECT_THAT(net.net.fault(1, 5), HasSubstr("no EtherCAT device 1"));
  EXPECT_THAT(net.net.fault(0, 5), HasSubstr("not a drive"));
  ASSERT_EQ(net.net.configure("ethercat.0.ds402", "1"), "");
  EXPECT_THAT(net.net.fault(0, 0x10000), HasSubstr("16 bits"));
}

} // namespace

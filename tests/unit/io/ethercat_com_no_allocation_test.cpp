// Ticks of the EtherCAT net, of its servos and of serial ports, and what instructions ask of them, allocate nothing.
#include <gtest/gtest.h>

#include "sim/technol/devices/com.h"
#include "sim/technol/devices/ethercat_servo.h"
#include "tests/support/count_allocations.h"
#include "tests/unit/io/ethercat_net.h"

namespace {

using namespace rung::sim::technol;
using rung::io::ethercat::kOperationData;
using rung::test::allocationsOf;
using rung::test::EthercatNet;

TEST(DevicesNoAllocation, CounterCounts) {
  EXPECT_GT(allocationsOf([] { EthercatNet net{{"ethercat.0", "coe"}, {"ethercat.0.coe.1.0", "1"}}; }), 0);
}

TEST(DevicesNoAllocation, Ethercat) {
  EthercatNet net{{"ethercat.0", "coe+soe"},
                  {"ethercat.0.name", "Drive"},
                  {"ethercat.0.ds402", "1"},
                  {"ethercat.0.soe.47.0", "1/4"},
                  {"ethercat.0.pdo.Inputs.Status", "0x6041.0"},
                  {"ethercat.0.pdo.Outputs.Control", "0x6040.0"},
                  {"ethercat.1", "coe"}};
  ASSERT_EQ(net.problems, "");
  EthercatServos servos;
  EthercatServos::Cells cells;
  cells[0].isConnected = cells[1].isSimulated = true;
  const uint8_t data[] = {1, 0, 0, 0};
  int answers = 0;
  EXPECT_EQ(allocationsOf([&] {
              for (int i = 0; i < 10'000; ++i) {
                const uint32_t tickets[] = {net.net.upload({0, 0}, 0x6041, 0, 2), net.net.command({0, 1}, 11 + i % 2),
                                            net.net.writeIdn({0, 0}, 0, kOperationData, 47, data),
                                            net.net.readIdn({0, 0}, 0, 0xFF, 47, 64),
                                            net.net.download({0, 1}, 0x6041, 0, data)};
                net.bits.preOperationalRequest |= i % 100 == 0;
                net.bits.operationalRequest |= i % 100 == 50;
                cells[0].on |= i % 200 == 0;
                cells[1].on = true;
                if (i % 1000 == 500) net.net.setSilent(1, i % 2000 == 500);
                if (i % 5000 == 4000) net.net.powerOn();
                net.ticks(1);
                servos.tick(cells);
                net.net.image().write(1, cells[0].control);
                cells[0].status = static_cast<uint16_t>(net.net.image().read(0));
                for (const uint32_t ticket : tickets) {
                  answers += net.net.poll(ticket).isDone ? 1 : 0;
                  net.net.forget(ticket);
                }
              }
            }),
            0);
  EXPECT_GT(answers, 0);
  EXPECT_EQ(cells[1].status, 0x23);
}

TEST(DevicesNoAllocation, Com) {
  ComPorts ports;
  for (const char* key : {"COM[0].Active", "COM[15].Active"}) ASSERT_EQ(ports.configure(key, "1"), "");
  const uint8_t block[100] = {};
  EXPECT_EQ(allocationsOf([&] {
              for (int i = 0; i < 10'000; ++i) {
                ports.port(0).send(block);
                ports.port(15).send(1);
                ports.receive(0, block);
                ports.port(0).receive();
                ports.port(0).takeState();
                ports.tick();
                if (i % 100 == 0) ports.port(0).clear();
                if (i % 5000 == 4000) ports.powerOn();
                ports.line(15).takeSent(std::span(block).first(1));
              }
            }),
            0);
  EXPECT_EQ(ports.line(0).sent(), uint32_t{999} * 1152 / 110);
}

} // namespace

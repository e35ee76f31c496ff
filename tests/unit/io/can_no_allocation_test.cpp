// Ticks of the CAN devices and the instructions between them allocate nothing.
#include "tests/support/count_allocations.h"
#include "tests/unit/io/can_rig.h"

namespace {

using namespace rung::io;
using rung::test::allocationsOf;

TEST(CanNoAllocation, CounterCounts) {
  EXPECT_GT(allocationsOf([] { rung::test::CanRig{}.configure("CAN[1].InOut08Cnt", "2"); }), 0);
}

TEST(CanNoAllocation, TenThousandTicks) {
  rung::test::CanRig rig;
  rig.configure("CAN[1].InOut08Cnt", "8");
  rig.configure("CAN[1].KnobCnt", "2");
  rig.configure("CAN[0].Drives", "3");
  rig.devices.power();
  EXPECT_EQ(allocationsOf([&] {
              for (uint32_t ms = 0; ms < 10'000; ++ms) {
                rig.in.units.out[0] = static_cast<uint8_t>(ms);
                rig.in.units.display[0] = {0, 16, 'A', static_cast<uint8_t>(ms), 'c', 0xFF, 0, 0};
                rig.in.drives.command[0] = static_cast<uint16_t>(ms / 20 % 4);
                rig.devices.wires(1, 1)->shorts[0] = static_cast<uint8_t>(ms / 50 % 2);
                rig.devices.wires(1, 2)->silent = ms / 300 % 2 != 0;
                rig.run(1);
                CanPacket packet = sdo::read(1, {0x1000, 0});
                if (ms % 20 == 0) rig.devices.control().sendToDrive(1, packet);
                rig.devices.control().channel(2).send(packetOf(ms & 0x7FF, {1}));
                while (rig.devices.control().takeReceived(2, packet)) rig.devices.control().channel(2).deliver(packet);
                rig.devices.control().channel(2).receive(packet);
              }
            }),
            0);
}

} // namespace

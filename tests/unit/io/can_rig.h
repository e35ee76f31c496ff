// The simulated CAN devices with a program's cells around them.
#pragma once
#include <gtest/gtest.h>

#include "sim/technol/devices/can_bus.h"

namespace rung::test {

struct CanRig {
  void configure(std::string_view key, std::string_view value) {
    EXPECT_EQ(devices.configure(key, value), std::optional<std::string>("")) << key << " " << value;
  }
  void run(uint32_t ms = 20) {
    while (ms-- > 0) devices.tick(in, out);
  }
  uint32_t item(uint32_t group, uint32_t board, io::InoutsItem item) {
    uint32_t value = 0xDEAD;
    EXPECT_TRUE(devices.control().readItem(2, group, board, item, value));
    return value;
  }
  void setItem(uint32_t group, uint32_t board, io::InoutsItem item, uint32_t value) {
    EXPECT_TRUE(devices.control().writeItem(2, group, board, item, value));
  }
  void unitEvent(uint32_t group, uint32_t board, const sim::technol::CanUnitEvent& event) {
    EXPECT_EQ(devices.unitEvent(group, board, event), "");
  }
  // The next packet for the program; an empty one with the identifier FFFFh where none has come.
  io::CanPacket received(uint32_t channel) {
    io::CanPacket packet{.id = 0xFFFF};
    devices.control().takeReceived(channel, packet);
    return packet;
  }

  sim::technol::CanDevices devices;
  sim::technol::CanInputs in;
  sim::technol::CanOutputs out;
};

} // namespace rung::test

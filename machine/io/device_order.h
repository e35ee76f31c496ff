// Which device a service of a program is for, and what of it.
#pragma once
#include <cstdint>
#include <string_view>
#include <vector>

#include "rung/program.h"

namespace rung::io {

enum class DeviceKind : uint8_t { None, Data, Tables, ReadArea, WriteArea, Axes, Com, Can, Ethercat };

struct DeviceOrder {
  DeviceKind device = DeviceKind::None;
  uint8_t order = 0; // TableOrder, AxisOrder, ComOrder, CanRequest or EthercatOrder
};

// By the signature of a service, as rung_program::services has it.
DeviceOrder deviceOrder(std::string_view signature);
// By the program's numbers of its services.
std::vector<DeviceOrder> deviceOrders(const rung_program& program);

} // namespace rung::io

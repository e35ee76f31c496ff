// Which device a service is for.
#include "machine/io/device_call.h"

#include "machine/io/axes/axis_requests.h"
#include "machine/io/can/can_requests.h"
#include "machine/io/com/port.h"
#include "machine/io/ethercat/ethercat_requests.h"
#include "machine/io/tables/table_requests.h"
#include "rtlib/load/program_info.h"
#include "rtlib/nc/technol/services.h"

namespace rung::io {

namespace {

template <class Order>
DeviceOrder orderFor(DeviceKind device, Order order) {
  return order == Order::None ? DeviceOrder() : DeviceOrder{device, static_cast<uint8_t>(order)};
}

} // namespace

DeviceOrder deviceOrder(std::string_view signature) {
  if (signature == nc::technol::kDataService) return {DeviceKind::Data};
  const std::string_view name = signature.substr(0, signature.find(' '));
  if (name == "SA_READ") return {DeviceKind::ReadArea};
  if (name == "SA_WRITE") return {DeviceKind::WriteArea};
  const DeviceOrder orders[] = {orderFor(DeviceKind::Tables, tableOrder(name)),
                                orderFor(DeviceKind::Axes, axisOrder(name)), orderFor(DeviceKind::Com, comOrder(name)),
                                orderFor(DeviceKind::Can, canRequest(name)),
                                orderFor(DeviceKind::Ethercat, ethercatOrder(name))};
  for (const DeviceOrder& order : orders)
    if (order.device != DeviceKind::None) return order;
  return {};
}

std::vector<DeviceOrder> deviceOrders(const rung_program& program) {
  std::vector<DeviceOrder> orders;
  for (uint32_t i = 0; i < program.service_count; ++i) orders.push_back(deviceOrder(runtime::serviceName(program, i)));
  return orders;
}

} // namespace rung::io

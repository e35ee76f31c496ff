// Which device a service is for (see device_order.h).
#include "tools/device-requests/device_order.h"

#include "rtlib/host/program_info.h"
#include "rtlib/nc/technol/services.h"
#include "tools/device-requests/axis_order.h"
#include "tools/device-requests/can_requests.h"
#include "tools/device-requests/com_requests.h"
#include "tools/device-requests/ethercat_requests.h"
#include "tools/device-requests/table_requests.h"

namespace rung::device_requests {
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
                                orderFor(DeviceKind::Can, canOrder(name)),
                                orderFor(DeviceKind::Ethercat, ethercatOrder(name))};
  for (const DeviceOrder& order : orders)
    if (order.device != DeviceKind::None) return order;
  return {};
}

std::vector<DeviceOrder> deviceOrders(const rung_program& program) {
  std::vector<DeviceOrder> orders;
  for (uint32_t i = 0; i < program.service_count; ++i) orders.push_back(deviceOrder(host::serviceName(program, i)));
  return orders;
}

} // namespace rung::device_requests

// Requests to serial ports (see com_requests.h). RLO, the first result, is 1 for an error.
#include "tools/sim/technol/requests/com_requests.h"

namespace rung::sim::technol {
namespace {

enum Command : int64_t { kClear = nc::technol::kFirstLineCommand, kReceived, kState }; // of COM_CONTROL

void send(devices::com::Port& port, DeviceCall& call) {
  call.set(0, port.send(static_cast<uint8_t>(call.arg(1))) ? 0 : 1);
}

void sendText(devices::com::Port& port, DeviceCall& call) {
  std::array<uint8_t, devices::com::Port::kQueueBytes + 1> room; // one more than the queue takes
  call.set(0, port.send(call.bytes(1, room)) ? 0 : 1);
}

void receive(devices::com::Port& port, DeviceCall& call) {
  const auto byte = port.receive();
  call.set(0, byte ? 0 : 1);
  call.set(1, byte.value_or(0));
}

void control(devices::com::Port& port, DeviceCall& call) {
  if (call.arg(1) == kState) {
    call.set(1, port.takeState());
    return;
  }
  if (call.arg(1) == kClear) {
    call.set(0, port.clear() ? 0 : 1);
    return;
  }
  const auto count = port.received();
  call.set(0, count ? 0 : 1);
  call.set(1, count.value_or(0));
}

// A number beyond the last has a port that nobody has configured.
devices::com::Port& portOf(ComPorts& ports, const DeviceCall& call, devices::com::Port& none) {
  return call.number(0) < ComPorts::kMost ? ports.port(call.number(0)) : none;
}

} // namespace

bool answerCom(ComPorts& ports, std::string_view service, DeviceCall& call) {
  struct Order {
    std::string_view name;
    void (*answer)(devices::com::Port&, DeviceCall&);
  };
  constexpr Order kOrders[] = {
      {"COM_SEND", send}, {"COM_SEND_STR", sendText}, {"COM_RECV", receive}, {"COM_CONTROL", control}};
  for (const Order& order : kOrders) {
    if (order.name != service) continue;
    devices::com::Port none;
    order.answer(portOf(ports, call, none), call);
    return true;
  }
  return false;
}

} // namespace rung::sim::technol

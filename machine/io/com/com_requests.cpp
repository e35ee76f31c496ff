// Requests to serial ports (see com_requests.h). RLO, the first result, is 1 for an error.
#include "machine/io/com/com_requests.h"

namespace rung::io {
namespace {

enum Command : int64_t { kClear = nc::technol::kFirstLineCommand, kReceived, kState }; // of COM_CONTROL

void send(com::Port& port, DeviceCall& call) { call.set(0, port.send(static_cast<uint8_t>(call.arg(1))) ? 0 : 1); }

void sendText(com::Port& port, DeviceCall& call) {
  std::array<uint8_t, com::Port::kQueueBytes + 1> room{}; // one more than the queue takes
  call.set(0, port.send(call.bytes(1, room)) ? 0 : 1);
}

void receive(com::Port& port, DeviceCall& call) {
  const auto byte = port.receive();
  call.set(0, byte ? 0 : 1);
  call.set(1, byte.value_or(0));
}

void control(com::Port& port, DeviceCall& call) {
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

void answerOf(com::Port& port, ComOrder order, DeviceCall& call) {
  switch (order) {
  case ComOrder::None: return;
  case ComOrder::Send: return send(port, call);
  case ComOrder::SendText: return sendText(port, call);
  case ComOrder::Receive: return receive(port, call);
  case ComOrder::Control: return control(port, call);
  }
}

} // namespace

ComOrder comOrder(std::string_view service) {
  constexpr std::string_view kOrders[] = {"", "COM_SEND", "COM_SEND_STR", "COM_RECV", "COM_CONTROL"};
  return orderOf<ComOrder>(kOrders, service);
}

// A null port is answered as one that is not configured.
void answerCom(com::Port* port, ComOrder order, DeviceCall& call) {
  if (port != nullptr) return answerOf(*port, order, call);
  com::Port none;
  answerOf(none, order, call);
}

} // namespace rung::io

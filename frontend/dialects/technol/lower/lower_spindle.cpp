// Analogue outputs, spindles and axes (man. ch. 12, 13.1).
#include "frontend/dialects/technol/lower/device_request.h"
#include "frontend/dialects/technol/lower/lower.h"

namespace rung::frontend::technol {

using ir::Type;
using ir::ValueId;

namespace {

constexpr int64_t kPorts = 16; // number of analogue outputs (man. l.7730)

// Stores an output. It takes effect at once (inventory of the services, 4): the answer reports the port and its value.
void storeOutput(ir::RungBuilder& b, DeviceRequest& request) {
  const nc::Signal& outputs = interfaceSignal("SU_OUT_PLC");
  const ValueId number = b.sub(request.result("port"), b.constant(Type::I64, 1));
  const ValueId value = request.real("out");
  const ValueId at = b.mul(b.zextOrTrunc(Type::I32, number), b.i32(outputs.strideBytes));
  const ir::Window window{
      .space = kInterfaceSpace, .byte = outputs.byteOffset, .count = (outputs.count - 1) * outputs.strideBytes + 1};
  b.when(b.ltU(number, b.constant(Type::I64, kPorts)), [&] { b.storeAt(window, at, value); });
}

// Adds the value; without an operand it is the low 16 bits of DR (man. l.7776).
void addValue(Lowering& l, DeviceRequest& request, const Operand& value) {
  if (value.given())
    request.addOperand(0, value);
  else
    request.add(l.b().sextOrTrunc(Type::I64, l.r().dr(Type::I16)));
}

} // namespace

// Selects the port of ANALOG, in all modules, until the next ANALOG_PORT (man. l.7730, l.7783).
void lowerAnalogPort(Lowering& l, std::span<const Operand> o, int) {
  ir::RungBuilder& b = l.b();
  DeviceRequest request(l);
  const ValueId port = request.addOperand(0, o[0]);
  const ValueId exists = b.ltU(b.sub(port, b.constant(Type::I64, 1)), b.constant(Type::I64, kPorts));
  b.when(exists, [&] { b.store(place(HostCell::AnalogPort), b.zextOrTrunc(Type::I32, port)); });
  request.send();
}

// ANALOG [val] writes to the port, ANALOG val|-, axis [,spi] to a spindle. Before the first ANALOG_PORT no port is
// selected and nothing happens.
void lowerAnalog(Lowering& l, std::span<const Operand> o, int) {
  ir::RungBuilder& b = l.b();
  using enum nc::technol::ServiceKind;
  DeviceRequest request(l, o[1].given() ? AnalogOfAxis : Analog);
  addValue(l, request, o[0]);
  if (o[1].given()) {
    request.addOperand(1, o[1]);
    request.addOperand(2, o[2]);
    request.send();
    return storeOutput(b, request);
  }
  const ValueId port = b.zextOrTrunc(Type::I64, b.load(Type::I32, place(HostCell::AnalogPort)));
  request.add(port);
  b.when(b.ne(port, b.constant(Type::I64, 0)), [&] {
    request.send();
    storeOutput(b, request);
  });
}

// ANALOG_SPI val|-, axis
void lowerAnalogSpindle(Lowering& l, std::span<const Operand> o, int) {
  DeviceRequest request(l);
  addValue(l, request, o[0]);
  request.addOperand(1, o[1]);
  request.send();
  storeOutput(l.b(), request);
}

// The output of a spindle that is switched off becomes 0 (man. l.7984).
void lowerToSpindle(Lowering& l, std::span<const Operand> o, int) {
  DeviceRequest request(l);
  for (uint32_t i = 0; i < o.size(); ++i) request.addOperand(i, o[i]);
  request.send();
  storeOutput(l.b(), request);
}

// POLOHV_x is 1 until the axis has been positioned; the program ends the positioning by writing 0 (man. l.7964-7973).
// If no device positions axes it stays 0, so that no program waits forever.
void lowerToAxis(Lowering& l, std::span<const Operand> o, int) {
  ir::RungBuilder& b = l.b();
  DeviceRequest request(l);
  ValueId axis;
  for (uint32_t i = 0; i < o.size(); ++i) axis = request.addOperand(i, o[i]);
  const ValueId refused = b.eq(b.servicePoll(request.send()), b.i32(RUNG_SERVICE_ERROR));
  const ValueId begins = b.and_(isAxis(b, axis), b.not_(refused));
  setBitOfAxis(b, "POLOHV", "POLOHVPI2", axis, begins);
  setBitOfAxis(b, "PB20PI", "PB20PI2", axis, begins);
}

// Moves val one step towards DR, in val's width; DR becomes val (man. l.8274-8299). The difference of two numbers of
// the same width fits into that width as an unsigned number.
void lowerRamp(Lowering& l, std::span<const Operand> o, int) {
  ir::RungBuilder& b = l.b();
  const Type type = o[0].type;
  const MemoryAccess access = l.memory.reach(o[0]);
  const ValueId value = l.memory.load(access, type), wanted = l.r().dr(type);
  const ValueId rises = b.ltS(value, wanted);
  const ValueId distance = b.zextOrTrunc(Type::I64, b.select(rises, b.sub(wanted, value), b.sub(value, wanted)));
  const ValueId most = b.zextOrTrunc(Type::I64, l.memory.value(o[1]));
  const ValueId step = b.zextOrTrunc(type, b.select(b.ltU(distance, most), distance, most));
  const ValueId next = b.select(rises, b.add(value, step), b.sub(value, step));
  l.memory.store(access, next);
  l.r().setDr(next);
}

} // namespace rung::frontend::technol

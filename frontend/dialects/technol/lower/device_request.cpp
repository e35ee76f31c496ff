// Requests to devices.
#include "frontend/dialects/technol/lower/device_request.h"

#include "frontend/dialects/technol/rows/operand_kinds.h"
#include "frontend/lower/operations.h"
#include "ir/support/check.h"

namespace rung::frontend::technol {

using ir::Type;
using ir::ValueId;

namespace {

const nc::technol::DeviceService& serviceOf(std::string_view mnemonic) {
  const nc::technol::DeviceService* service = nc::technol::findDeviceService(mnemonic);
  RUNG_CHECK(service != nullptr, "an instruction without a service");
  return *service;
}

} // namespace

DeviceRequest::DeviceRequest(Lowering& context) : DeviceRequest(context, serviceOf(context.mnemonic())) {}

ValueId DeviceRequest::add(ValueId value) {
  args_.push_back(value);
  return value;
}

// Adds an operand as a word. Numbers have their own width (inventory of the services, 1.4).
ValueId DeviceRequest::addOperand(uint32_t number, const Operand& operand, ValueId guard) {
  ir::RungBuilder& b = l_.b();
  const OperandInfo& info = l_.statement().row->info.operands[number];
  const auto word = [&] {
    switch (operand.form) {
    case Operand::Form::NotGiven: return b.constant(Type::I64, nc::technol::kNotGiven);
    case Operand::Form::Bit: return b.zextOrTrunc(Type::I64, l_.memory.bit(operand));
    case Operand::Form::Cell: {
      const ValueId value = l_.memory.value(operand, guard);
      const auto* taken = std::get_if<NumberKind>(&kindOf(info).takes);
      const bool isSigned = taken != nullptr && taken->twosComplement;
      return isSigned ? b.sextOrTrunc(Type::I64, value) : b.zextOrTrunc(Type::I64, value);
    }
    default: return b.constant(Type::I64, operand.value);
    }
  };
  RUNG_CHECK(device_.service.arguments[static_cast<uint32_t>(args_.size())].name == info.name,
             "an operand at another place than in the service");
  return add(word());
}

ValueId DeviceRequest::send() {
  RUNG_CHECK(args_.size() == device_.service.arguments.count(), "other arguments than the service has");
  const ValueId ticket = l_.b().serviceRequest(l_.emitter.service(device_.kind()), args_);
  use(ticket);
  return ticket;
}

void DeviceRequest::use(ValueId ticket) {
  ticket_ = ticket;
  executed_ = {};
}

ValueId DeviceRequest::answered() {
  ir::RungBuilder& b = l_.b();
  const ValueId state = b.servicePoll(ticket_);
  executed_ = b.eq(state, b.i32(RUNG_SERVICE_DONE));
  forgotten_ = b.eq(state, b.i32(RUNG_SERVICE_NONE));
  return b.not_(b.or_(b.eq(state, b.i32(RUNG_SERVICE_PENDING)), forgotten_));
}

ValueId DeviceRequest::result(std::string_view name) {
  ir::RungBuilder& b = l_.b();
  if (!executed_.valid()) executed_ = isExecuted(b, ticket_);
  const auto number = device_.service.results.find(name);
  RUNG_CHECK(number.has_value(), "a result that the service does not have");
  const auto& answers = device_.answer.refused;
  const int64_t refused = *number < std::size(answers) ? answers[*number] : 0;
  return b.select(executed_, b.serviceResult(ticket_, *number), b.constant(Type::I64, refused));
}

ValueId DeviceRequest::flag(std::string_view name) { return l_.b().ne(result(name), l_.b().constant(Type::I64, 0)); }

ValueId DeviceRequest::real(std::string_view name) { return l_.b().bitsToF(result(name)); }

const Operand* lengthIn(std::span<const OperandInfo> infos, std::span<const Operand> operands) {
  for (size_t i = 0; i < operands.size(); ++i)
    if (text::equalsIgnoringCase(infos[i].name, "Size") || text::equalsIgnoringCase(infos[i].name, "Len"))
      return &operands[i];
  return nullptr;
}

// The address and size of an area as one argument. The number of a space with a text depends on the texts before it;
// where the area begins shows which one it is.
ValueId bytesArgument(Emitter& emitter, const Area& area, ValueId count) {
  ir::RungBuilder& b = emitter.b();
  const ValueId fixed = emitter.given(Type::I64, nc::technol::bytesArgument(area.space.index, 0, 0));
  const ValueId wide = b.zextOrTrunc(Type::I64, count);
  const ValueId size = b.shl(wide, b.i32(32));
  return b.or_(b.or_(fixed, size), b.zextOrTrunc(Type::I64, area.at));
}

void fetchBytes(Emitter& emitter, ValueId ticket, const Area& to, ValueId count, uint32_t most) {
  ir::RungBuilder& b = emitter.b();
  const ValueId number = b.zextOrTrunc(Type::I64, ticket);
  putParts(b, to, count, most, {.bytes = nc::technol::kDataBytes, .firstWord = 0}, [&](ValueId part) {
    return b.serviceRequest(emitter.service(nc::technol::ServiceKind::FetchBytes),
                            std::array{number, b.zextOrTrunc(Type::I64, part)});
  });
}

} // namespace rung::frontend::technol

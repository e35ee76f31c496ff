// Named values of the NC: macro variables (man. §6.16, l.3157-3267) and the quantities of the oscilloscope (§6.17,
// l.3269-3388).
#include <fmt/format.h>

#include "frontend/dialects/nct/lower/lower.h"
#include "ir/support/check.h"
#include "ir/support/diag/operand.h"
#include "rtlib/nc/nct/scope_symbols.h"
#include "rtlib/nc/nct/signals.h"

namespace rung::frontend::nct {

using ir::RungBuilder;
using ir::SlotId;
using ir::Type;
using ir::ValueId;
using nc::nct::ScopeParameter;
using nc::nct::ScopeSource;
using nc::nct::ServiceKind;

namespace {

constexpr int64_t kFirstMacro = 100, kLastMacro = 999; // l.3215
constexpr int64_t kChannels = 8;                       // index 0 to 7

ValueId isBetween(RungBuilder& b, ValueId value, int64_t least, int64_t most) {
  return b.ltU(b.sub(value, b.i32(least)), b.i32(most - least + 1));
}

// A request to the NC. If the NC answers immediately, an enabled box sends a request in every evaluation. If the NC
// takes longer, the box sends one request while EN stays TRUE and sets its output when the answer arrives.
class Inquiry {
public:
  explicit Inquiry(Lowering& box)
      : b_(box.b), memory_(box.memory), waiting_(box.slots.make("waiting", Type::Bit)),
        settled_(box.slots.make("settled", Type::Bit)), shown_(box.slots.make("shown", Type::Bit)),
        ticket_(box.slots.make("ticket", Type::I32)) {}

  // `ask` returns a ticket; `take` is called with it when the answer is available. Returns the output.
  template <class Ask, class Take>
  ValueId run(Ask ask, Take take);
  // Emitted for EN = FALSE or an invalid operand. Discards a pending answer.
  void forget() {
    for (SlotId slot : {waiting_, settled_, shown_}) b_.slotStore(slot, b_.bit(false));
  }

private:
  template <class Ask>
  ValueId ticketOf(Ask ask);
  void end(bool good) {
    b_.slotStore(shown_, b_.bit(good));
    b_.slotStore(settled_, b_.slotLoad(waiting_));
    b_.slotStore(waiting_, b_.bit(false));
  }

  RungBuilder& b_;
  Memory& memory_;
  SlotId waiting_; // for the answer to `ticket_`
  SlotId settled_; // the answer was delayed: no further request
  SlotId shown_;   // the output
  SlotId ticket_;
};

template <class Ask>
ValueId Inquiry::ticketOf(Ask ask) {
  return b_.choose(
      b_.slotLoad(waiting_), [&] { return b_.slotLoad(ticket_); },
      [&] {
        const ValueId made = ask();
        b_.slotStore(ticket_, made);
        return made;
      });
}

template <class Ask, class Take>
ValueId Inquiry::run(Ask ask, Take take) {
  b_.if_(b_.not_(b_.slotLoad(settled_)));
  const ValueId ticket = ticketOf(ask);
  const ValueId state = b_.servicePoll(ticket);
  b_.if_(b_.eq(state, b_.i32(RUNG_SERVICE_DONE)));
  take(ticket);
  end(true);
  b_.else_();
  b_.if_(b_.eq(state, b_.i32(RUNG_SERVICE_ERROR)));
  memory_.setErrorFlag(true);
  end(false);
  b_.else_();
  b_.slotStore(waiting_, b_.eq(state, b_.i32(RUNG_SERVICE_PENDING))); // otherwise the queue is full
  b_.endIf();
  b_.endIf();
  b_.endIf();
  return b_.slotLoad(shown_);
}

// Common frame of the three instructions: `valid` returns the condition on the operands, `body` the output.
template <class Valid, class Body>
ValueId inquire(Lowering& box, Inquiry& inquiry, Valid valid, Body body) {
  RungBuilder& b = box.b;
  const auto ask = [&] {
    const ValueId good = valid();
    const ValueId output = guarded(box, good, [&] { return body(); });
    if (good.valid()) b.when(b.not_(good), [&] { inquiry.forget(); });
    return output;
  };
  return b.choose(box.power(), ask, [&] {
    inquiry.forget();
    return b.bit(false);
  });
}

ValueId asReal(RungBuilder& b, ValueId bits) { return b.bitsToF(bits); }
ValueId asArgument(RungBuilder& b, ValueId integer) { return b.sextOrTrunc(Type::I64, integer); }

ValueId macrosLocked(Lowering& box) {
  const nc::Signal* signal = nc::findSignal(nc::nctSignals(), "P_MAC");
  RUNG_CHECK(signal != nullptr, "a signal of the NC");
  const Address address{.word = signal->byteOffset / 4, .bit = signal->bit, .isBit = true};
  return box.memory.loadBit(box.memory.bit(address, AccessBound::Read));
}

} // namespace

// MACR result variable channel; MACW variable operand channel.
ValueId lowerMacro(Lowering& box) {
  RungBuilder& b = box.b;
  Memory& memory = box.memory;
  const bool writes = box.variant == kWriteMacro;
  Inquiry inquiry(box);
  Place place;
  ValueId variable, channel;
  const auto valid = [&] {
    place = memory.twoWords(box.operands[writes ? 1 : 0].address, AccessBound::User);
    ValueId good = place.valid;
    variable = memory.integer(box.operands[writes ? 0 : 1], good);
    channel = memory.integer(box.operands[2], good);
    good = memory.both(good, isBetween(b, variable, kFirstMacro, kLastMacro));
    good = memory.both(good, isBetween(b, channel, 0, kChannels - 1));
    return writes ? memory.both(good, b.not_(macrosLocked(box))) : good; // l.8121
  };
  const auto ask = [&] {
    std::vector<ValueId> args{asArgument(b, variable), asArgument(b, channel)};
    if (writes) args.push_back(memory.loadDouble(place, Type::I64));
    return b.serviceRequest(box.shared.service(writes ? ServiceKind::WriteMacro : ServiceKind::ReadMacro), args);
  };
  const auto take = [&](ValueId ticket) {
    if (!writes) memory.storeDouble(place, asReal(b, b.serviceResult(ticket, 0)));
    memory.setErrorFlag(false);
  };
  return inquire(box, inquiry, valid, [&] { return inquiry.run(ask, take); });
}

// --- SCP ------------------------------------------------------------------------------------------------------------
namespace {

const nc::nct::ScopeSymbol& symbolOf(const Operand& operand) {
  return nc::nct::scopeSymbols()[static_cast<size_t>(operand.constant.integer)];
}

ValueId fits(Lowering& box, const ScopeParameter& parameter, const Operand& operand, ValueId value) {
  const int64_t most = parameter.maximum(box.memory.config().plcNvram);
  if (operand.form == Form::Constant || most == INT32_MAX) return {}; // checked by the compiler, or unlimited
  return isBetween(box.b, value, parameter.min, most);
}

// Loads a value from the PLC's own memory; the place is fixed if both parameters are constants.
ValueId loadOwn(Lowering& box, ScopeSource source, ValueId word, ValueId bit) {
  RungBuilder& b = box.b;
  const bool direct = source == ScopeSource::DirectPlcBit || source == ScopeSource::DirectPlcInt ||
                      source == ScopeSource::DirectPlcDouble;
  const Operand& wordOperand = box.operands[2];
  const Operand& bitOperand = box.operands[3];
  Place place;
  Address address{.word = 0, .bit = 0, .immediate = direct};
  if (wordOperand.form == Form::Constant && bitOperand.form == Form::Constant) {
    address.word = static_cast<uint32_t>(wordOperand.constant.integer);
    address.bit = static_cast<uint32_t>(bitOperand.constant.integer);
    place = box.memory.word(address, AccessBound::Read);
  } else {
    place = box.memory.word(address, AccessBound::Read);
    place.fixed = false;
    place.window = {.space = place.space, .byte = 0, .count = direct ? box.memory.config().plcNvram : kWords};
    place.index = place.wordNo = word;
    place.bitNo = bit;
  }
  if (source == ScopeSource::PlcDouble || source == ScopeSource::DirectPlcDouble) {
    if (!place.fixed) --place.window.count; // the last element must lie wholly inside
    return box.memory.loadDouble(place, Type::F64);
  }
  const bool isBit = source == ScopeSource::PlcBit || source == ScopeSource::DirectPlcBit;
  const ValueId integer = isBit ? b.zextOrTrunc(Type::I32, box.memory.loadBit(place)) : box.memory.loadWord(place);
  return b.intToF(integer);
}

} // namespace

// SCP result symbol parameter1 parameter2. The PLC's own memory is read directly, everything else is requested from the
// NC. A request changes FL_ER only if it cannot be made.
ValueId lowerScope(Lowering& box) {
  RungBuilder& b = box.b;
  Memory& memory = box.memory;
  const nc::nct::ScopeSymbol& symbol = symbolOf(box.operands[1]);
  Place place;
  ValueId param1, param2;
  const auto valid = [&] {
    place = memory.twoWords(box.operands[0].address, AccessBound::User);
    ValueId good = place.valid;
    param1 = memory.integer(box.operands[2], good);
    param2 = memory.integer(box.operands[3], good);
    good = memory.both(good, fits(box, symbol.param1, box.operands[2], param1));
    return memory.both(good, fits(box, symbol.param2, box.operands[3], param2));
  };
  if (symbol.source != ScopeSource::Nc)
    return execute(box, [&] {
      return guarded(box, valid(), [&] {
        memory.storeDouble(place, loadOwn(box, symbol.source, param1, param2));
        return b.bit(true);
      });
    });
  Inquiry inquiry(box);
  const auto ask = [&] {
    const ValueId args[] = {b.constant(Type::I64, box.operands[1].constant.integer), asArgument(b, param1),
                            asArgument(b, param2)};
    return b.serviceRequest(box.shared.service(ServiceKind::ReadScope), args);
  };
  const auto take = [&](ValueId ticket) { memory.storeDouble(place, asReal(b, b.serviceResult(ticket, 0))); };
  return inquire(box, inquiry, valid, [&] { return inquiry.run(ask, take); });
}

// The manual gives limits only for a constant variable (l.3201); a channel that does not exist is an error at run time.
void checkMacro(std::span<const Operand> operands, const Config&, Diagnostics& diagnostics) {
  const Operand& channel = operands.back();
  if (channel.form != Form::Constant || (channel.constant.integer >= 0 && channel.constant.integer < kChannels)) return;
  diagnostics.report(diag::ConstantOutOfRange, channel.source->range)
          .severity(Severity::Warning)
          .note("there is no such channel: FL_ER is 1 and the output FALSE whenever this is executed")
      << channel.source->text << fmt::format("0 to {}", kChannels - 1);
}

void checkScope(std::span<const Operand> operands, const Config& config, Diagnostics& diagnostics) {
  const nc::nct::ScopeSymbol& symbol = symbolOf(operands[1]);
  const auto check = [&](const ScopeParameter& parameter, const Operand& operand) {
    const int64_t most = parameter.maximum(config.plcNvram);
    const int64_t value = operand.constant.integer;
    if (operand.form != Form::Constant || (value >= parameter.min && value <= most)) return;
    diagnostics.report(diag::ConstantOutOfRange, operand.source->range)
            .note(fmt::format("{} of {}", parameter.meaning, symbol.name))
        << operand.source->text
        << (parameter.min == most ? fmt::format("#{}", most) : fmt::format("{} to {}", parameter.min, most));
  };
  check(symbol.param1, operands[2]);
  check(symbol.param2, operands[3]);
}

} // namespace rung::frontend::nct

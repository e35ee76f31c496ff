// Checks of messages, inputs and outputs, sharing and configuration (man. ch. 10, 14, 16, 18, 27).
#include "frontend/dialects/technol/check/check_context.h"
#include "frontend/dialects/technol/check/rules.h"

#include "ir/support/diag/technol.h"
#include "rtlib/nc/technol/exchange.h"
#include "rtlib/nc/technol/services.h"

namespace rung::frontend::technol {

using nc::ExchangeType;
using Form = Operand::Form;

namespace {

bool inRange(const CheckContext& c, const Operand& given, int64_t least, int64_t most) {
  if (given.value >= least && given.value <= most) return true;
  c.report(diag::OperandRange, given.range) << given.value << std::to_string(least) + " to " + std::to_string(most);
  return false;
}

// An identifier that is written has 1 to kDefineBytes characters; one that is `defined` ends without an index (man.
// l.12690).
bool identifierFits(const CheckContext& c, const Operand& id, bool defined) {
  if (id.form != Form::Text) return textFits(c, id);
  if (id.text.empty() || id.text.size() > nc::kDefineBytes) {
    c.report(diag::OperandRange, id.range)
        << std::to_string(id.text.size()) + " characters" << "1 to " + std::to_string(nc::kDefineBytes);
    return false;
  }
  const size_t bracket = id.text.rfind('[');
  const bool index = id.text.back() == ']' && bracket != std::string_view::npos;
  if (!defined || !index || id.text.find_first_not_of('0', bracket + 1) == id.text.size() - 1) return true;
  c.report(diag::WrongOperandKind, id.range) << id.text << "an identifier with an index at its end"
                                             << "an identifier without one";
  return false;
}

// Whether the default is a constant of the variable's type. The default of a mapped real has its decimal point (man.
// l.5880).
bool defaultFits(const CheckContext& c, const Exchanged& variable, const Operand& given) {
  if (variable.type == ExchangeType::Text)
    return given.form == Form::Text || c.wrongKind(given, "not a text", "a text");
  if (variable.type == ExchangeType::Binary) return c.wrongKind(given, "a default", "none with TYPE_BIN");
  if (given.form == Form::Text) return c.wrongKind(given, "a text", "a number");
  if (variable.type == ExchangeType::Real)
    return given.form == Form::Real || !nc::isMapped(variable.kind) ||
           c.wrongKind(given, "an integer", "a real with its decimal point");
  if (given.form == Form::Real) return c.wrongKind(given, "a real", "an integer");
  if (variable.type == ExchangeType::Bit) return inRange(c, given, 0, 1);
  const uint32_t bits = nc::bytesOf(variable.type) * 8;
  return bits == 64 || inRange(c, given, -(int64_t{1} << (bits - 1)), (int64_t{1} << bits) - 1);
}

void warnIfLong(const CheckContext& c, const Operand& text, const Operand& target) {
  if (text.form == Form::Text && text.text.size() > target.size() - 1)
    c.report(diag::StringTooLong, text.range) << text.text.size() << target.size() - 1;
}

bool limitsFit(const CheckContext& c, ExchangeType type, std::span<const Operand> o) {
  const bool text = nc::isText(type);
  const Operand &least = o[3], &most = o[4];
  if (least.form == Form::Real) return c.wrongKind(least, "a constant", "a real cell");
  if (text && most.given()) return c.wrongKind(most, "a limit", "none with a text");
  if (text && least.form == Form::Cell) return c.wrongKind(least, "a cell", "a length, which is a constant");
  if (!text && least.form == Form::Integer) return c.wrongKind(least, "a length", "a real cell");
  return !text || !least.given() || inRange(c, least, 1, o[0].size());
}

// Of EDEF: 00 never, 01 a rising edge, 10 a falling one.
bool isEdge(int64_t code) { return code <= 2; }

} // namespace

void checkMessage(const CheckContext& c, std::span<const Operand>, int) {
  c.calls.addMessage(c.program.procedureOf(c.statement.unit), c.statement.range());
}

void checkBitMessage(const CheckContext& c, std::span<const Operand> o, int) {
  if (!isEdge(o[4].value & 3) || !isEdge(o[4].value >> 2))
    c.report(diag::OperandRange, o[4].range) << spell(o[4]) << "00b, 01b or 10b in bits 0, 1 and in bits 2, 3";
  else if (!o[0].given() && !o[1].place.space.valid())
    c.wrongKind(o[1], "a bit number", "a bit, or its byte before it");
}

void checkDefine(const CheckContext& c, std::span<const Operand> o, int) {
  const Exchanged& variable = c.declarations.exchanged[o[0].index];
  const Operand& given = o[nc::isMapped(variable.kind) ? 2 : 3];
  const bool fits = !given.given() || defaultFits(c, variable, given);
  if (identifierFits(c, o[1], true) && fits) warnIfLong(c, given, o[0]);
}

void checkUpdate(const CheckContext& c, std::span<const Operand> o, int) {
  if (nc::isText(c.declarations.exchanged[o[0].index].type)) c.wrongKind(o[0], "a text", "a bit or a number");
}

void checkShareVariable(const CheckContext& c, std::span<const Operand> o, int) {
  const ExchangeType type = nc::exchangeTypeOf(o[2].value);
  const bool possible =
      type != ExchangeType::Bit || c.wrongKind(o[2], "the type of a bit", "that of a number or a text");
  if (identifierFits(c, o[1], false) && possible) limitsFit(c, type, o);
}

void checkShareBit(const CheckContext& c, std::span<const Operand> o, int) { identifierFits(c, o[1], false); }

void checkConfiguration(const CheckContext& c, std::span<const Operand> o, int kind) {
  const auto wanted = static_cast<nc::ConfigurationKind>(kind);
  const bool text = wanted == nc::ConfigurationKind::Text || wanted == nc::ConfigurationKind::Binary;
  if (text && !textFits(c, o[0])) return;
  textFits(c, o[1]);
  if (!text || !o[2].given() || !textFits(c, o[2]) || o[0].indexed) return;
  warnIfLong(c, o[2], o[0]);
}

} // namespace rung::frontend::technol

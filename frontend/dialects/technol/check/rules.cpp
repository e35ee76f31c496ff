// The checks of instruction rows, by family.
#include "frontend/dialects/technol/check/rules.h"

#include <algorithm>
#include <iterator>

#include "frontend/dialects/technol/check/check_context.h"
#include "frontend/dialects/technol/lower/device_request.h"
#include "frontend/dialects/technol/rows/operand_kinds.h"
#include "ir/support/diag/operand.h"
#include "ir/support/diag/source.h"
#include "ir/support/diag/technol.h"
#include "rtlib/nc/technol/exchange.h"
#include "rtlib/nc/technol/services.h"
#include "rtlib/nc/technol/signals.h"

namespace rung::frontend::technol {

// Checks of messages, inputs and outputs, shared variables and configuration (man. ch. 10, 14, 16, 18, 27).

using nc::ExchangeType;
using Form = Operand::Form;

namespace {

bool inRange(const CheckContext& c, const Operand& given, int64_t least, int64_t most) {
  if (given.value >= least && given.value <= most) return true;
  c.report(diag::OperandRange, given.range) << given.value << std::to_string(least) + " to " + std::to_string(most);
  return false;
}

// A literal identifier has 1 to kDefineBytes characters; one that is `defined` must not end with an index (man.
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

// Whether the default is a constant of the variable's type. The default of a mapped real must have a decimal point
// (man. l.5880).
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

// Codes of EDEF: 00 never, 01 a rising edge, 10 a falling edge.
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

// Checks of data instructions (man. ch. 3.9-3.16).

void checkLoad(const CheckContext& c, std::span<const Operand> o, int) {
  c.mixing.note(o[0].isReal() ? DrUse::LoadReal : DrUse::LoadInteger, c.statement);
}

void checkArithmetic(const CheckContext& c, std::span<const Operand> o, int) {
  c.mixing.note(o[0].isReal() ? DrUse::Real : DrUse::Integer, c.statement);
}

// For an instruction whose use of integers need not be tracked.
void checkRealUse(const CheckContext& c, std::span<const Operand> o, int) {
  if (o[0].isReal()) c.mixing.note(DrUse::Real, c.statement);
}

void checkToReal(const CheckContext& c, std::span<const Operand>, int) { c.mixing.note(DrUse::LoadReal, c.statement); }

void checkToInteger(const CheckContext& c, std::span<const Operand>, int) {
  c.mixing.note(DrUse::LoadInteger, c.statement);
}

void checkMove(const CheckContext& c, std::span<const Operand> o, int) {
  if (o[0].type == o[1].type) return;
  c.report(diag::TypeMismatch, c.statement.range())
      << c.statement.row->info.mnemonic << describe(o[0].type) << describe(o[1].type);
}

// Checks of jump targets, and of instructions whose position matters.

namespace {

std::string describeUnit(const Unit& unit) {
  switch (unit.kind) {
  case UnitKind::Module: return std::string(unit.name);
  case UnitKind::Mechanism: return "mechanism " + std::string(unit.name);
  case UnitKind::Procedure: return "procedure " + std::string(unit.name);
  case UnitKind::Timed: return "a block of " + std::string(unit.name);
  }
  return {};
}

// Checks that a jump stays inside its unit; the end label of a timed block counts as inside.
void checkTarget(const CheckContext& c, const Operand& operand) {
  const SourceProgram& program = c.program;
  const Label& label = program.labels[operand.index];
  const Unit& unit = program.at(c.statement.unit);
  const bool ownEnd = unit.kind == UnitKind::Timed && label.unit == unit.parent &&
                      symbolKey(program.tokens[unit.endLabel].text) == symbolKey(label.name);
  if (label.unit == c.statement.unit || ownEnd) return;
  const bool leadsInto = unit.kind == UnitKind::Module && label.unit.valid();
  c.report(diag::JumpCrossesUnit, operand.range)
      << label.name << describeUnit(leadsInto ? program.at(label.unit) : unit);
}

} // namespace

void checkJump(const CheckContext& c, std::span<const Operand> o, int) { checkTarget(c, o[0]); }
void checkTimedEx(const CheckContext& c, std::span<const Operand> o, int) { checkTarget(c, o[2]); }

void checkEmptyStack(const CheckContext& c, std::span<const Operand>, int) {
  c.equation.checkBalance(c.statement.range(), "CHECK");
}

// A mechanism inside a timed block counts as part of the block.
void checkTimer(const CheckContext& c, std::span<const Operand>, int) {
  UnitId unit = c.statement.unit;
  while (unit.valid() && c.program.at(unit).kind == UnitKind::Mechanism) unit = c.program.at(unit).parent;
  if (!unit.valid() || c.program.at(unit).kind != UnitKind::Timed)
    c.report(diag::TmOutsideDftm, c.statement.range()) << c.statement.row->info.mnemonic;
}

void checkCall(const CheckContext& c, std::span<const Operand> o, int) {
  c.calls.add(c.program.procedureOf(c.statement.unit), o[0].index, o[0].range);
}

// Checks of instructions that exchange data with devices (inventory of the services, 1.4, 3).

namespace {

constexpr uint32_t kIntegerBytes = 4, kRealBytes = 8, kPacketBytes = 12, kRecordBytes = 2;

// Number of bytes of an operand: the width of its type, or those up to the end of its variable.
uint32_t bytesOf(const Operand& operand) { return operand.prefixed ? ir::byteWidth(operand.type) : operand.size(); }

// Reports an operand that has fewer than `bytes` bytes. An indexed operand is checked at run time.
void holds(const CheckContext& c, const Operand& operand, int64_t bytes) {
  if (operand.indexed || operand.form != Operand::Form::Cell || bytes <= bytesOf(operand)) return;
  c.report(diag::AddressOutOfRange, operand.range)
      << spell(operand) + "+" + std::to_string(bytes - 1) << (operand.isText ? "the text" : "the variable");
}

bool isCell(const Operand& operand) { return operand.type != ir::Type::None; }

void checkReal(const CheckContext& c, const Operand& operand) {
  if (isCell(operand) && ir::byteWidth(operand.type) != kRealBytes)
    c.wrongKind(operand, describe(operand.type), "a REAL of 8 bytes or a text");
  else
    holds(c, operand, kRealBytes);
}

void checkText(const CheckContext& c, const Operand& operand) {
  if (operand.form == Operand::Form::Text) return;
  if (!operand.isText)
    c.wrongKind(operand, "not a text", "a text");
  else
    textFits(c, operand);
}

void checkData(const CheckContext& c, const Operand& operand, DataForm form, int64_t count) {
  switch (form) {
  case DataForm::None: return;
  case DataForm::Integer:
    if (!isCell(operand)) holds(c, operand, kIntegerBytes);
    return;
  case DataForm::Real: return checkReal(c, operand);
  case DataForm::Text: return checkText(c, operand);
  case DataForm::Binary: return;
  case DataForm::Bytes: return holds(c, operand, count);
  }
}

} // namespace

// Checks a constant byte count; one in a cell is checked at run time.
void checkService(const CheckContext& c, std::span<const Operand> o, int form) {
  const std::span<const OperandInfo> infos = c.statement.row->info.operands.all();
  const Operand* length = lengthIn(infos, o);
  const int64_t count = length != nullptr && length->form == Operand::Form::Integer ? length->value : 0;
  for (size_t i = 0; i < o.size(); ++i)
    if (o[i].given() && isMemory(infos[i])) checkData(c, o[i], static_cast<DataForm>(form), count);
}

// The last operand, pmsg, must have 12 bytes (man. l.9497).
void checkPacket(const CheckContext& c, std::span<const Operand> o, int) { holds(c, o.back(), kPacketBytes); }

// The first operand is a record of two bytes; the second byte may belong to another variable (man. l.12061).
void checkRecord(const CheckContext& c, std::span<const Operand> o, int) {
  if (o[0].indexed || o[0].place.byte + kRecordBytes <= c.declarations.bytesOf(o[0].place.space)) return;
  c.report(diag::AddressOutOfRange, o[0].range) << spell(o[0]) + "+1" << "the memory";
}

// ECATCMD_MASTER_STATE and ECATCMD_SLAVE_STATE return a state (man. l.18231).
void checkEtherCatCommand(const CheckContext& c, std::span<const Operand> o, int form) {
  constexpr int64_t kCommands[] = {1, 2, 3, 4, 8, 11, 12, 13, 14, 18, 20, 21}; // man. l.18210-18246
  const bool isNumber = o[2].form == Operand::Form::Integer;
  if (isNumber && std::ranges::find(kCommands, o[2].value) == std::end(kCommands))
    c.report(diag::OperandRange, o[2].range) << o[2].value << "the commands 1 to 4, 8, 11 to 14, 18, 20 and 21";
  const bool asks =
      isNumber && (o[2].value == nc::technol::kMasterStateCommand || o[2].value == nc::technol::kSlaveStateCommand);
  if (asks && !(o[3].given() && o[4].given()))
    c.report(diag::OperandCount, c.statement.range())
        << "ECAT_COMMAND with this command" << "5 operands"
        << static_cast<int64_t>(std::ranges::count_if(o, &Operand::given));
  checkService(c, o, form);
}

// Rejects items that the control keeps in a unit for itself: packets and pointers (inventory of the services, 9).
void checkUnitItem(const CheckContext& c, std::span<const Operand> o, int) {
  const std::string item = spell(o[3]);
  const nc::Signal* member = nc::findSignal(nc::technolSignals(), "INOUTS." + item, "INOUTS");
  if (member == nullptr || (member->type != nc::SignalType::Struct && !item.starts_with("pINOUT"))) return;
  c.wrongKind(o[3], "a structure or an address", "a byte, word or dword of INOUTS");
}

// Checks of memory and texts (man. ch. 3.15, 3.18): accesses outside the variable or its memory.

namespace {

constexpr uint32_t kLongestText = 0xFFFF;

// The number of bytes, at most `count`, from an address to the end of its memory. A write beyond it is an error; a read
// beyond it gives 0 (an example of the manual reads beyond its variable, l.13543).
uint32_t inside(const CheckContext& c, const Operand& operand, uint32_t count, bool written) {
  const uint32_t exist = c.declarations.bytesOf(operand.place.space) - operand.place.byte;
  if (operand.indexed || count <= exist) return count;
  c.report(diag::AddressOutOfRange, operand.range).severity(written ? Severity::Error : Severity::Warning)
      << spell(operand) + "+" + std::to_string(count - 1)
      << (operand.place.space == kInterfaceSpace ? "the interface" : "the program's data");
  return exist;
}

bool textsFit(const CheckContext& c, std::span<const Operand> o) { return textFits(c, o[0]) && textFits(c, o[1]); }

} // namespace

bool textFits(const CheckContext& c, const Operand& operand) {
  if (operand.form == Operand::Form::Text) return true;
  if (operand.end - operand.begin > kLongestText + 1) {
    c.report(diag::TooLarge, operand.range) << "characters in a text" << kLongestText;
    return false;
  }
  if (operand.indexed || (operand.size() != 0 && operand.place.byte >= operand.begin)) return true;
  c.report(diag::AddressOutOfRange, operand.range) << spell(operand) << "the text";
  return false;
}

void checkMoveMemory(const CheckContext& c, std::span<const Operand> o, int) {
  if (!o[2].isConstant()) return;
  const uint32_t written = inside(c, o[1], static_cast<uint32_t>(o[2].value), true);
  inside(c, o[0], written, false);
}

void checkClear(const CheckContext& c, std::span<const Operand> o, int) {
  const bool keywords[] = {o[0].form == Operand::Form::Keyword, o[1].form == Operand::Form::Keyword};
  if (keywords[0] && keywords[1]) return;
  if (keywords[0])
    c.wrongKind(o[1], "an address", "ALL");
  else if (keywords[1])
    c.wrongKind(o[1], "a keyword", "an address");
  else if (o[0].place.space != o[1].place.space)
    c.wrongKind(o[1], "in another memory", "an address after the first");
  else if (!o[0].indexed && !o[1].indexed && o[1].place.byte < o[0].place.byte)
    c.wrongKind(o[1], "before the first", "an address after the first");
}

void checkTexts(const CheckContext& c, std::span<const Operand> o, int) { textsFit(c, o); }

void checkNumberToText(const CheckContext& c, std::span<const Operand> o, int) {
  constexpr uint32_t kMostDigits = 10;
  if (!textFits(c, o[0])) return;
  const uint32_t characters = o[0].size() - 1;
  if (!o[0].indexed && characters >= 1 && characters <= kMostDigits) return;
  c.report(diag::OperandRange, o[0].range)
      << (o[0].indexed ? std::string("+BX") : std::to_string(characters) + " characters") << "1 to 10 characters";
}

void checkCopyBytes(const CheckContext& c, std::span<const Operand> o, int) {
  if (!textsFit(c, o) || o[0].indexed || (o[2].given() && !o[2].isConstant())) return;
  const uint32_t room = o[0].size() - 1;
  inside(c, o[1], o[2].given() ? std::min(room, static_cast<uint32_t>(o[2].value)) : room, false);
}

void checkCompareBytes(const CheckContext& c, std::span<const Operand> o, int) {
  const bool known = o[2].given() ? o[2].isConstant() : !o[1].indexed;
  if (!textsFit(c, o) || !known) return;
  const uint32_t count = o[2].given() ? static_cast<uint32_t>(o[2].value) : o[1].size() - 1;
  inside(c, o[0], count, false);
  inside(c, o[1], count, false);
}

} // namespace rung::frontend::technol

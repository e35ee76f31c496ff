// Checks of instructions that give data to devices or get them (inventory of the services, 1.4, 3).
#include <algorithm>
#include <iterator>

#include "frontend/dialects/technol/check/check_context.h"
#include "frontend/dialects/technol/check/rules.h"
#include "frontend/dialects/technol/lower/device_request.h"
#include "frontend/dialects/technol/rows/operand_kinds.h"
#include "ir/support/diag/operand.h"
#include "ir/support/diag/technol.h"
#include "rtlib/nc/technol/signals.h"

namespace rung::frontend::technol {
namespace {

constexpr uint32_t kIntegerBytes = 4, kRealBytes = 8, kPacketBytes = 12, kRecordBytes = 2;

// Bytes that an operand has: its type's, or those up to the end of its variable.
uint32_t bytesOf(const Operand& operand) { return operand.prefixed ? ir::byteWidth(operand.type) : operand.size(); }

// An index shows when the program runs.
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

// The bytes that a constant asks for; of a cell it shows when the program runs.
void checkService(const CheckContext& c, std::span<const Operand> o, int form) {
  const std::span<const OperandInfo> infos = c.statement.row->info.operands.all();
  const Operand* length = lengthIn(infos, o);
  const int64_t count = length != nullptr && length->form == Operand::Form::Integer ? length->value : 0;
  for (size_t i = 0; i < o.size(); ++i)
    if (o[i].given() && isMemory(infos[i])) checkData(c, o[i], static_cast<DataForm>(form), count);
}

// pmsg, the last operand, has 12 bytes (man. l.9497).
void checkPacket(const CheckContext& c, std::span<const Operand> o, int) { holds(c, o.back(), kPacketBytes); }

// The first operand is a record of two bytes, the second of which may be another variable (man. l.12061).
void checkRecord(const CheckContext& c, std::span<const Operand> o, int) {
  if (o[0].indexed || o[0].place.byte + kRecordBytes <= c.declarations.bytesOf(o[0].place.space)) return;
  c.report(diag::AddressOutOfRange, o[0].range) << spell(o[0]) + "+1" << "the memory";
}

// ECATCMD_MASTER_STATE and ECATCMD_SLAVE_STATE give a state (man. l.18231).
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

// Not what the control itself keeps in a unit: packets and pointers (inventory of the services, 9).
void checkUnitItem(const CheckContext& c, std::span<const Operand> o, int) {
  const std::string item = spell(o[3]);
  const nc::Signal* member = nc::findSignal(nc::technolSignals(), "INOUTS." + item, "INOUTS");
  if (member == nullptr || (member->type != nc::SignalType::Struct && !item.starts_with("pINOUT"))) return;
  c.wrongKind(o[3], "a structure or an address", "a byte, word or dword of INOUTS");
}

} // namespace rung::frontend::technol

// Checks of memory and texts (man. ch. 3.15, 3.18): what lies outside its variable or its memory.
#include <algorithm>

#include "frontend/dialects/technol/check/check_context.h"
#include "frontend/dialects/technol/check/rules.h"
#include "ir/support/diag/operand.h"
#include "ir/support/diag/source.h"
#include "ir/support/diag/technol.h"

namespace rung::frontend::technol {
namespace {

constexpr uint32_t kLongestText = 0xFFFF;

// The bytes from an address on that are in its memory, of `count`. An error where the rest would be written; read, it
// is 0 (an example of the manual reads beyond its variable, l.13543).
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

// Checks the placeholders of message texts against the boxes that send them (see message_texts.h).
#include "frontend/dialects/nct/check/message_texts.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "frontend/dialects/nct/lower/lower.h"
#include "ir/support/diag/nct.h"
#include "rtlib/nc/nct/messages.h"

namespace rung::frontend::nct {

TextKind checkText(const Word& text, Diagnostics& diagnostics) {
  TextKind kind = TextKind::Plain;
  for (std::string_view rest = text.text; !rest.empty();) {
    const size_t brace = rest.find('{');
    if (brace == std::string_view::npos) break;
    rest.remove_prefix(brace);
    const auto place = nc::nct::readPlaceholder(rest);
    const std::string_view shown = rest.substr(0, std::min(rest.find('}'), rest.size() - 1) + 1);
    if (!place) {
      diagnostics.report(diag::MessageFormat, text.range) << shown << "it is written {#0:F0} or {*0:F2}";
      return TextKind::Bad;
    }
    const TextKind own = place->real ? TextKind::Real : TextKind::Integer;
    if (kind != TextKind::Plain && kind != own) {
      diagnostics.report(diag::MessageFormat, text.range) << shown << "a message has either an integer or a double";
      return TextKind::Bad;
    }
    kind = own;
    rest.remove_prefix(place->length);
  }
  return kind;
}

namespace {

void checkBox(const TextKinds& texts, const Row& row, const Operand& number, Diagnostics& diagnostics) {
  if (number.form != Form::Constant) return;
  const auto found = texts.find(static_cast<uint32_t>(number.constant.integer));
  if (found == texts.end()) return;
  const bool real = (row.variant & kMessageOfReal) != 0;
  if (found->second.kind != (real ? TextKind::Integer : TextKind::Real)) return;
  diagnostics.report(diag::MessageFormat, number.source->range).note(found->second.range, "the text")
      << (real ? "{#0:F0}" : "{*0:Fi}")
      << fmt::format("{} takes {}, so the text has {}", row.info.mnemonic, real ? "a double" : "an integer",
                     real ? "{*0:Fi}" : "{#0:F0}");
}

} // namespace

namespace {

// Calls f with the row and the number operand of each message box.
template <class F>
void forEachBox(const TypedModule& module, F f) {
  for (const TypedRung& rung : module.rungs)
    for (const TypedElement& element : rung.elements)
      if (element.row != nullptr && element.row->info.group == "message" && element.operandCount != 0)
        f(*element.row, rung.operandsOf(element)[0]);
}

} // namespace

void checkMessages(const TypedModule& module, const TextKinds& texts, Diagnostics& diagnostics) {
  forEachBox(module, [&](const Row& row, const Operand& number) { checkBox(texts, row, number, diagnostics); });
}

void checkMessageNumbers(std::initializer_list<const TypedModule*> modules, const TextKinds& texts,
                         Diagnostics& diagnostics) {
  std::set<uint32_t> shown;
  bool all = true; // false: some number is computed at run time
  for (const TypedModule* module : modules)
    forEachBox(*module, [&](const Row&, const Operand& operand) {
      all = all && operand.form == Form::Constant;
      if (operand.form != Form::Constant) return;
      const auto number = static_cast<uint32_t>(operand.constant.integer);
      if (shown.insert(number).second && !texts.contains(number))
        diagnostics.report(diag::MessageWithoutText, operand.source->range) << number;
    });
  if (!all) return;
  for (const auto& [number, text] : texts)
    if (!shown.contains(number)) diagnostics.report(diag::MessageUnused, text.range) << number;
}

} // namespace rung::frontend::nct

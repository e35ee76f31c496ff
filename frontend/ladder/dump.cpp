// The text form of a rung's elements and nets, for tests and for looking at.

#include <fmt/format.h>

#include "frontend/ladder/ladder.h"
#include "ir/support/put.h"

namespace rung::ladder {
namespace {

void operands(std::string& out, const Rung& rung, const Element& element) {
  for (const Word& word : rung.operandsOf(element)) {
    const std::string_view quote = word.quoted ? "\"" : "";
    put(out, " {}{}{}", quote, word.text, quote);
  }
}

void symbol(std::string& out, const Rung& rung, const Element& element) {
  const std::string_view edge(&element.edge, element.edge != 0 ? 1 : 0);
  switch (element.kind) {
  case ElementKind::Contact:
    put(out, "[{}{}{}]", element.negated ? "/" : "", edge, rung.operandOf(element).text);
    return;
  case ElementKind::Coil: {
    constexpr std::string_view kKinds[] = {"", "/", "S ", "R "};
    put(out, "({}{}{})", kKinds[static_cast<size_t>(element.coil)], edge, rung.operandOf(element).text);
    return;
  }
  case ElementKind::Box:
    put(out, "{{{}", element.mnemonic);
    operands(out, rung, element);
    put(out, "}}");
    return;
  case ElementKind::Error: put(out, "unread"); return;
  }
}

} // namespace

std::string dumpRung(const Rung& rung) {
  std::string out;
  put(out, "rung{} {}-{}{}\n", rung.hasComment ? fmt::format(" \"{}\"", rung.comment) : "", rung.firstLine,
      rung.lastLine, rung.bad ? " bad" : "");
  for (size_t i = 0; i < rung.elements.size(); ++i) {
    const Element& element = rung.elements[i];
    put(out, "e{} ", i);
    symbol(out, rung, element);
    for (const Pin& pin : rung.pinsOf(element)) {
      put(out, " {}{}n{}", pin.name, pin.name.empty() ? "" : "=", pin.input.index);
    }
    put(out, " -> {}", element.output.valid() ? fmt::format("n{}", element.output.index) : ".");
    if (!element.remark.empty()) put(out, " ; {}", element.remark);
    out += '\n';
  }
  return out;
}

} // namespace rung::ladder

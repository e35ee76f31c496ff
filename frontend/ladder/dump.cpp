// The text form of a rung's elements and nets, for tests and for looking at.
#include <iterator>

#include <fmt/format.h>

#include "frontend/ladder/ladder.h"

namespace rung::ladder {
namespace {

using Out = std::back_insert_iterator<std::string>;

void operands(Out out, const Rung& rung, const Element& element) {
  for (const Word& word : rung.operandsOf(element)) {
    const std::string_view quote = word.quoted ? "\"" : "";
    fmt::format_to(out, " {}{}{}", quote, word.text, quote);
  }
}

void symbol(Out out, const Rung& rung, const Element& element) {
  const std::string_view edge(&element.edge, element.edge != 0 ? 1 : 0);
  switch (element.kind) {
  case ElementKind::Contact:
    fmt::format_to(out, "[{}{}{}]", element.negated ? "/" : "", edge, rung.operandOf(element).text);
    return;
  case ElementKind::Coil: {
    constexpr std::string_view kKinds[] = {"", "/", "S ", "R "};
    fmt::format_to(out, "({}{}{})", kKinds[static_cast<size_t>(element.coil)], edge, rung.operandOf(element).text);
    return;
  }
  case ElementKind::Box:
    fmt::format_to(out, "{{{}", element.mnemonic);
    operands(out, rung, element);
    fmt::format_to(out, "}}");
    return;
  }
}

} // namespace

std::string dumpRung(const Rung& rung) {
  std::string text;
  Out out(text);
  fmt::format_to(out, "rung{} {}-{}{}\n", rung.hasComment ? fmt::format(" \"{}\"", rung.comment) : "", rung.firstLine,
                 rung.lastLine, rung.bad ? " bad" : "");
  for (size_t i = 0; i < rung.elements.size(); ++i) {
    const Element& element = rung.elements[i];
    fmt::format_to(out, "e{} ", i);
    symbol(out, rung, element);
    for (const Pin& pin : rung.pinsOf(element)) {
      fmt::format_to(out, " {}{}n{}", pin.name, pin.name.empty() ? "" : "=", pin.input.index);
    }
    fmt::format_to(out, " -> {}", element.output.valid() ? fmt::format("n{}", element.output.index) : ".");
    if (!element.remark.empty()) fmt::format_to(out, " ; {}", element.remark);
    text += '\n';
  }
  return text;
}

} // namespace rung::ladder

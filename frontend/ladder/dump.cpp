// The text form of a rung's elements and nets, for tests and for looking at.
#include <fmt/format.h>

#include "frontend/ladder/rung.h"
#include "ir/support/put.h"

namespace rung::frontend::ladder {

std::string elementText(const Element& element, std::span<const Word> operands) {
  const std::string_view edge(&element.edge, element.edge != 0 ? 1 : 0);
  switch (element.kind) {
  case ElementKind::Contact: return fmt::format("[{}{}{}]", element.negated ? "/" : "", edge, operands[0].text);
  case ElementKind::Coil: {
    constexpr std::string_view kKinds[] = {"", "/", "S ", "R "};
    return fmt::format("({}{}{})", kKinds[static_cast<size_t>(element.coil)], edge, operands[0].text);
  }
  case ElementKind::Error: return "unread";
  case ElementKind::Box: break;
  }
  std::string out = fmt::format("{{{}", element.mnemonic);
  for (const Word& word : operands) {
    const std::string_view quote = word.quoted ? "\"" : "";
    put(out, " {}{}{}", quote, word.text, quote);
  }
  return out + '}';
}

std::string dumpRung(const Rung& rung) {
  std::string out;
  put(out, "rung{} {}-{}{}\n", rung.hasComment ? fmt::format(" \"{}\"", rung.comment) : "", rung.firstLine,
      rung.lastLine, rung.bad ? " bad" : "");
  for (size_t i = 0; i < rung.elements.size(); ++i) {
    const Element& element = rung.elements[i];
    put(out, "e{} ", i);
    out += elementText(element, rung.operandsOf(element));
    for (const Pin& pin : rung.pinsOf(element)) {
      put(out, " {}{}n{}", pin.name, pin.name.empty() ? "" : "=", pin.input.index);
    }
    put(out, " -> {}", element.output.valid() ? fmt::format("n{}", element.output.index) : ".");
    out += '\n';
  }
  for (const Comment& comment : rung.comments) put(out, "; {}\n", comment.text);
  return out;
}

} // namespace rung::frontend::ladder

// Symbols and typed operands as the analysis has them (see analysis.h).
#include "frontend/dialects/technol/check/analysis.h"

namespace rung::frontend::technol {
namespace {

// In the order of the spaces of a module (symbols.h).
constexpr std::string_view kSpaces[] = {"NCI", "DATA", "MECH", "@REG", "BLK", "IO"};

std::string_view trimmed(std::string_view text) {
  const size_t first = text.find_first_not_of(" \t\r");
  return first == std::string_view::npos ? std::string_view()
                                         : text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

// The comment after a declaration, as written.
std::string_view commentAt(const SourceManager& sources, SourceRange declared) {
  const std::string_view line = sources.lineText(declared.begin);
  const size_t mark = commentOf(line);
  return mark == std::string_view::npos ? std::string_view() : trimmed(line.substr(mark + 1));
}

// Constants, labels and the like have none.
NamedPlace placeOf(const Symbol& symbol) {
  const uint32_t bit = symbol.byte * 8 + symbol.bit;
  if (symbol.broken || !symbol.space.valid()) return {};
  if (symbol.kind == SymbolKind::Bit) return {kSpaces[symbol.space.index], bit, 1};
  const bool isCell = symbol.kind == SymbolKind::Cell || symbol.kind == SymbolKind::Text;
  return isCell ? NamedPlace{kSpaces[symbol.space.index], bit, symbol.size * 8} : NamedPlace{};
}

Definition definitionOf(const SourceManager& sources, const Symbol& symbol) {
  Definition definition{.name = symbol.name};
  definition.place = placeOf(symbol);
  if (symbol.predeclared || !symbol.declared.valid()) return definition;
  definition.range = symbol.declared;
  definition.comment = commentAt(sources, symbol.declared);
  if (symbol.kind == SymbolKind::Constant) definition.value = symbol.name;
  return definition;
}

// Of an operand that names an address: a bit, or as much as its type or size says.
NamedPlace placeOf(const Operand& operand) {
  if (!operand.place.space.valid()) return {};
  const std::string_view space = kSpaces[operand.place.space.index];
  const uint32_t byte = operand.place.byte * 8;
  switch (operand.form) {
  case Operand::Form::Bit: return {space, byte + operand.place.bit, 1};
  case Operand::Form::Cell:
    return {space, byte, operand.type == ir::Type::None ? operand.size * 8 : ir::bitWidth(operand.type)};
  case Operand::Form::Text: return {space, byte, operand.size * 8};
  case Operand::Form::NotGiven:
  case Operand::Form::Integer:
  case Operand::Form::Real:
  case Operand::Form::Label:
  case Operand::Form::Mechanism:
  case Operand::Form::Procedure:
  case Operand::Form::Width:
  case Operand::Form::Register:
  case Operand::Form::Keyword: break;
  }
  return {};
}

void addOperand(const TypedProgram& typed, const Operand& operand, Analysis& analysis) {
  const NamedPlace place = placeOf(operand);
  if (place.bits == 0) return;
  const std::span<const NameUse> names = typed.namesOf(operand);
  analysis.use({.range = operand.range,
                .base = names.empty() ? kNoDefinition : names.front().symbol,
                .place = place,
                .computed = operand.indexed ? "[BX]" : "",
                .access = operand.access});
}

} // namespace

Analysis analysisOf(const Program& program, const TypedProgram& typed) {
  Analysis analysis;
  for (const Symbol& symbol : program.symbols.all()) analysis.define(definitionOf(program.sources, symbol));
  for (const std::vector<NameUse>* names : {&program.symbols.uses(), &typed.names})
    for (const NameUse& name : *names)
      if (name.symbol != kNone) analysis.use(name.range, name.symbol);
  for (const Operand& operand : typed.operands) addOperand(typed, operand, analysis);
  analysis.settle();
  return analysis;
}

} // namespace rung::frontend::technol

// Fills the analysis with symbols and typed operands (see analysis.h).
#include "frontend/dialects/technol/check/analysis.h"

#include <algorithm>

#include "frontend/dialects/technol/rows/operand_kinds.h"
#include "rtlib/text/blanks.h"

namespace rung::frontend::technol {
namespace {

// Names of the module's spaces, in the order of symbols.h.
constexpr std::string_view kSpaces[] = {"NCI", "DATA", "MECH", "@REG", "BLK", "IO"};

// The text after a name on the line of its declaration: the rest of the declaration, and its comment.
struct Declared {
  std::string_view rest;
  std::string_view comment;
};
Declared declaredAt(const SourceManager& sources, SourceRange name) {
  const std::string_view line = sources.lineText(name.begin);
  const size_t mark = std::min(commentOf(line), line.size());
  const size_t end = sources.offsetOf(name.end) - sources.lineStart(name.begin).offset;
  const std::string_view rest = line.substr(std::min(end, mark), mark - std::min(end, mark));
  const size_t value = std::min(rest.find_first_not_of(", \t"), rest.size());
  return {text::trimmed(rest.substr(value)), text::trimmed(line.substr(std::min(mark + 1, line.size())))};
}

// Memory of a symbol; constants, labels and the like have none.
NamedPlace placeOf(const Symbol& symbol) {
  const uint32_t bit = symbol.byte * 8 + symbol.bit;
  if (symbol.broken || !symbol.space.valid()) return {};
  if (symbol.kind == SymbolKind::Bit) return {kSpaces[symbol.space.index], bit, 1};
  const bool isCell = symbol.kind == SymbolKind::Cell || symbol.kind == SymbolKind::Text;
  return isCell ? NamedPlace{kSpaces[symbol.space.index], bit, symbol.size * 8} : NamedPlace{};
}

bool isCalledByControl(const Symbol& symbol) {
  if (symbol.kind != SymbolKind::Procedure) return false;
  const std::string name = symbolKey(symbol.name);
  return name == kOnMessage || std::ranges::find(kOnEvents, name) != std::end(kOnEvents);
}

Definition definitionOf(const SourceManager& sources, const Symbol& symbol) {
  Definition definition{.name = symbol.name};
  definition.place = placeOf(symbol);
  definition.usedByControl = isCalledByControl(symbol);
  // The compiler declares the line cell of a mechanism and the local names of a macro's use: they are in no source.
  const bool written = symbol.declared.valid() && sources.text(symbol.declared) == symbol.name;
  if (symbol.predeclared || !written) return definition;
  const Declared declared = declaredAt(sources, symbol.declared);
  definition.range = symbol.declared;
  definition.comment = declared.comment;
  definition.isPlaced = symbol.isOverlay;
  if (symbol.kind == SymbolKind::Constant) definition.value = declared.rest;
  return definition;
}

// Records a label or procedure, which is also a place in the program.
void addTarget(const Symbols& symbols, uint32_t number, SourceRange range, bool defines, Analysis& analysis) {
  const TargetUse target = targetOf(symbols, number, range, defines);
  if (range.valid() && !target.scope.empty()) analysis.use(target);
}

// Memory of an operand that names an address: a bit, or the width of its type or variable.
NamedPlace placeOf(const Operand& operand) {
  if (!operand.place.space.valid()) return {};
  const std::string_view space = kSpaces[operand.place.space.index];
  const uint32_t bit = static_cast<uint32_t>(operand.byte()) * 8;
  if (operand.form == Operand::Form::Bit) return {space, bit + operand.place.bit, 1};
  return {space, bit, operand.type == ir::Type::None ? operand.size() * 8 : ir::bitWidth(operand.type)};
}

// FL 1 and FL1 1 set their bits.
bool setsBits(const Statement& statement, std::span<const Operand> operands) {
  return !operands.empty() && statement.row->info.operands[0].kind == &kinds::kFlag && operands[0].value == 1;
}

// Whether a prefix may make a write wider than the variable, so that it also changes what follows. A wider read is the
// usual way to combine the bytes of a number (man. l.7796).
bool isWiderWrite(const Operand& operand) {
  return operand.form == Operand::Form::Cell && operand.prefixed && operand.access != Access::Read;
}

} // namespace

OperandUse useOf(const TypedProgram& program, const Operand& operand) {
  const NamedPlace place = placeOf(operand);
  if (place.bits == 0) return {};
  const std::span<const NameUse> names = program.namesOf(operand);
  return {.range = operand.range,
          .base = names.empty() ? kNoDefinition : names.front().definition,
          .place = place,
          .computed = operand.indexed ? "[BX]" : "",
          .access = operand.access,
          .isVariable = isWiderWrite(operand)};
}

// It has the number of its symbol.
TargetUse targetOf(const Symbols& symbols, uint32_t symbol, SourceRange range, bool defines) {
  const bool isLabel = symbols[symbol].kind == SymbolKind::Label;
  if (!isLabel && symbols[symbol].kind != SymbolKind::Procedure) return {};
  return {.range = range, .scope = isLabel ? "label" : "procedure", .number = symbol, .defines = defines};
}

Analysis analysisOf(const TypedProgram& program) {
  Analysis analysis;
  const Symbols& symbols = program.symbols;
  symbols.addTo(analysis, [&](const Symbol& symbol) { return definitionOf(program.source.sources, symbol); });
  for (uint32_t i = 0; i < symbols.all().size(); ++i)
    addTarget(symbols, i, analysis.definitions()[i].range, true, analysis);
  for (const NameUse& name : symbols.uses()) addTarget(symbols, name.definition, name.range, false, analysis);
  for (const Statement& statement : program.source.statements)
    if (statement.row != nullptr) analysis.use(InstructionUse{statement.range(), &statement.row->info});
  for (uint32_t i = 0; i < program.statements.size(); ++i) {
    const std::span<const Operand> operands = program.operandsOf(program.statements[i]);
    const bool isSet = setsBits(program.source.statements[i], operands);
    for (const Operand& operand : operands) {
      OperandUse use = useOf(program, operand);
      use.isSet = isSet;
      if (use.place.bits != 0) analysis.use(use);
    }
  }
  analysis.settle();
  return analysis;
}

} // namespace rung::frontend::technol

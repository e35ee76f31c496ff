// Symbols of a program.
#include "frontend/dialects/nct/read/symbols.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

#include "frontend/dialects/nct/read/operand_parser.h"
#include "frontend/ladder/text/fix.h"
#include "ir/support/diag/nct.h"
#include "ir/support/diag/operand.h"
#include "ir/support/diag/source.h"
#include "rtlib/text/letters.h"
#include "rtlib/text/number.h"
#include "rtlib/text/similar.h"

namespace rung::frontend::nct {
namespace {

// Limit on declarations that refer to each other in a chain; bounds the recursion.
constexpr int kMaxDepth = 200;

struct Alias {
  std::string_view misprint;
  std::string_view name;
};
// Misprints of the manual that programs may have copied (l.8220, l.8796).
constexpr Alias kAliases[] = {{"AP_DISP", "AP_DISPD"}, {"SP_SENDD", "SP_SEND"}};

constexpr std::string_view kNameRule = "a name has letters, digits and _, and begins with a letter or _";
bool isNameChar(char c) { return text::isLetter(c) || text::isDigit(c) || c == '_'; }

bool isName(std::string_view text) {
  return !text.empty() && !text::isDigit(text[0]) && std::ranges::all_of(text, isNameChar);
}

// A valid name similar to a designation of IEC 81346 or another bad name: K1 for -K1, _1M1 for 1M1; empty if there is
// none.
std::string likeName(std::string_view text) {
  std::string name;
  for (const char c : text) {
    if (isNameChar(c))
      name += c;
    else if (!name.empty())
      name += '_';
  }
  if (!name.empty() && text::isDigit(name[0])) name.insert(0, "_");
  return isName(name) ? name : std::string();
}

// Whether the text is an address in the style of IEC 61131, FANUC or Siemens, without its '%': I1, X8, QX0, MW100.
bool isOtherAddress(std::string_view text) {
  const size_t letters = std::min(text.find_first_not_of("ABDEIMQWXYabdeimqwxy"), text.size());
  return letters >= 1 && letters <= 2 && letters < text.size() && text::isDigit(text[letters]);
}

// The correct name for an input or output whose numbers lack leading zeros, such as INP0.5 or OUT12; otherwise empty.
std::string withZeros(std::string_view operand) {
  const std::string_view name = operand.substr(0, operand.find('.'));
  const auto number = text::numberIn<uint32_t>(name.substr(std::min<size_t>(3, name.size())));
  if (!number || *number > 999 || !(name.starts_with("INP") || name.starts_with("OUT"))) return {};
  const std::string word = fmt::format("{}{:03}", name.substr(0, 3), *number);
  const auto bit = text::numberIn<uint32_t>(operand.substr(std::min(name.size() + 1, operand.size())));
  return bit ? fmt::format("{}.{:02}", word, *bit) : word;
}

constexpr std::string_view kAddresses = "inputs and outputs of the control are bits of INP000, INP001, ... and OUT000, "
                                        "OUT001, ...: INP000.04; other memory "
                                        "has word addresses of four digits: 7000.04";

Symbol word(std::string_view name, uint32_t address) {
  Symbol symbol;
  symbol.name = name;
  symbol.kind = SymbolKind::Word;
  symbol.word = address;
  return symbol;
}

} // namespace

std::string_view aliasOf(std::string_view name) {
  for (const Alias& alias : kAliases)
    if (alias.misprint == name) return alias.name;
  return name;
}

Symbols::Symbols(const Config& config, const SourceManager& sources, Diagnostics& diagnostics)
    : config_(config), sources_(sources), diagnostics_(diagnostics) {
  for (const auto& [name, first] : {std::pair("PLCNVRAM", config.plcNvram), std::pair("PLCRAM", config.plcRam)}) {
    Symbol area = word(name, first);
    area.isArea = true;
    enter(area);
  }
  uint32_t bit = 0;
  for (std::string_view name : kFlagNames) {
    Symbol flag = word(name, kFlagsWord);
    flag.kind = SymbolKind::Bit;
    flag.bit = bit++;
    enter(flag);
  }
  direction_.resize(config.plcNvram);
  for (const nc::Signal& signal : nc::nctSignals()) {
    if (signal.direction != nc::Direction::In) continue;
    const uint32_t words = signal.count * signal.strideBytes / 4;
    for (uint32_t i = 0; i < words; ++i) direction_[signal.byteOffset / 4 + i] = kInput;
  }
}

uint32_t Symbols::enterPredefined(std::string_view name) {
  if (name == kFlagsName) return enter(word(name, kFlagsWord));
  const nc::Signal* signal = nc::findSignal(nc::nctSignals(), aliasOf(name));
  if (signal == nullptr) return frontend::kNoName;
  Symbol symbol = word(name, signal->byteOffset / 4);
  if (signal->type == nc::SignalType::Bit) {
    symbol.kind = SymbolKind::Bit;
    symbol.bit = signal->bit;
  }
  symbol.signal = signal;
  symbol.comment = signal->meaning;
  return enter(symbol);
}

uint32_t Symbols::indexOf(std::string_view name) {
  const uint32_t known = SymbolTable::find(name);
  return known != frontend::kNoName ? known : enterPredefined(name);
}

const Symbol* Symbols::find(std::string_view name) {
  const uint32_t index = indexOf(name);
  if (index == frontend::kNoName) return nullptr;
  Symbol& found = edit(index);
  found.index = index;
  if (found.pending) resolve(found);
  return &found;
}

const Symbol* Symbols::use(std::string_view name, SourceRange range) {
  const Symbol* found = find(name);
  if (found != nullptr) SymbolTable::use(range, found->index);
  return found;
}

static frontend::Definition definitionOf(const Symbol& symbol) {
  frontend::Definition definition{.name = symbol.name, .comment = symbol.comment, .range = symbol.declared};
  if (symbol.kind == SymbolKind::Constant) definition.value = symbol.declaration->value.text;
  const bool known = symbol.kind == SymbolKind::Word || symbol.kind == SymbolKind::Bit;
  if (known) definition.place = {"M", symbol.word * 32 + symbol.bit, symbol.kind == SymbolKind::Bit ? 1u : 32u};
  definition.isPlaced = symbol.declaration != nullptr;
  return definition;
}

void Symbols::addTo(frontend::Analysis& analysis) const { SymbolTable::addTo(analysis, definitionOf); }

void Symbols::reportUndeclared() {
  SymbolTable::reportUndeclared(diagnostics_, diag::UndeclaredSymbol,
                                [&](DiagBuilder& report, auto uses) { explain(report, uses); });
}

void Symbols::explain(DiagBuilder& report, std::span<const UndeclaredName> uses) {
  if (!diagnostics_.suggests()) return;
  const UndeclaredName& use = uses.front();
  const std::string_view name = use.name;
  if (const std::string meant = withZeros(use.whole.empty() ? name : use.whole); !meant.empty()) {
    report.note(fmt::format("inputs and outputs are numbered with three digits, their bits with two: {}", meant));
    return;
  }
  const text::Likely similar = similarTo(name);
  ladder::suggest(report, sources_, frontend::placesOf(uses), similar);
  if (isOtherAddress(name)) report.note(kAddresses);
  noteConstant(report, name, sources_, {});
  if (!isName(name)) report.note(kNameRule);
  // (S7001.00) would be a coil named S7001.
  const bool glued = name.size() > 1 && (name[0] == 'S' || name[0] == 'R') && !use.whole.empty() &&
                     (text::isDigit(name[1]) || find(name.substr(1)) != nullptr);
  const bool coloned = (name == "S" || name == "R") && use.whole.size() > 2 && use.whole[1] == ':';
  if (glued || coloned)
    report.note(fmt::format("set and reset have a blank: ({} {})", name[0], use.whole.substr(coloned ? 2 : 1)));
  else if (name == "P" || name == "N")
    report.note(
        fmt::format("a contact for a {} edge is [{}x]", name == "P" ? "rising" : "falling", name == "P" ? '@' : '%'));
  else if (similar.word.empty() && isName(name) && !isOtherAddress(name))
    report.note(fmt::format("a bit is declared by `symbol {0} {1:04}.00`, a word by `symbol {0} {1:04}`", name,
                            config_.plcRam));
}

// Finds the most similar name; the program's own names are preferred.
text::Likely Symbols::similarTo(std::string_view name) const {
  const text::Likely own = text::likeliest(name, all(), &Symbol::name);
  if (!own.word.empty()) return own;
  text::Similar similar(name);
  for (const nc::Signal& signal : nc::nctSignals()) similar.offer(signal.symbol);
  similar.offer(kFlagsName);
  return {similar.best(), similar.certain()};
}

void Symbols::declare(const ladder::Declaration& declaration) {
  const std::string_view name = declaration.name.text;
  if (!isName(name)) {
    refuse(name);
    DiagBuilder report = diagnostics_.report(diag::BadOperand, declaration.name.range);
    report << name << "a name";
    report.note(kNameRule);
    if (const std::string like = likeName(name); !like.empty()) report.note("for instance " + like);
    return;
  }
  indexOf(name); // adds the NC's symbol of this name, if there is one
  Symbol symbol = word(name, 0);
  symbol.declared = declaration.name.range;
  symbol.kind = SymbolKind::Bad;
  symbol.comment = declaration.comment;
  symbol.declaration = &declaration;
  symbol.pending = true;
  SymbolTable::declare(symbol, diagnostics_);
}

void Symbols::declareBad(std::string_view name) {
  if (indexOf(name) != frontend::kNoName) return;
  Symbol symbol = word(name, 0);
  symbol.kind = SymbolKind::Bad;
  enter(symbol);
}

void Symbols::resolveAll() {
  for (uint32_t i = 0; i < all().size(); ++i)
    if (edit(i).pending) resolve(edit(i));
}

void Symbols::resolve(Symbol& symbol) {
  const Word& value = symbol.declaration->value;
  if (symbol.resolving) {
    diagnostics_.report(diag::BadOperand, value.range)
        << value.text << "a fixed address: the declarations form a cycle";
    symbol.pending = false;
    return;
  }
  if (depth_ >= kMaxDepth) {
    diagnostics_.report(diag::TooDeep, value.range) << "declarations that refer to each other are" << kMaxDepth;
    symbol.pending = false;
    return;
  }
  symbol.resolving = true;
  ++depth_;
  if (symbol.declaration->kind == ladder::DeclarationKind::Const)
    resolveConstant(symbol);
  else
    resolveAddress(symbol);
  --depth_;
  symbol.resolving = false;
  symbol.pending = false;
}

void Symbols::resolveConstant(Symbol& symbol) {
  const Word& value = symbol.declaration->value;
  if (!value.text.starts_with('#') && !value.text.starts_with('*')) {
    DiagBuilder report = diagnostics_.report(diag::ConstantFormat, value.range);
    report << value.text;
    noteConstant(report, value.text, sources_, value.range);
    return;
  }
  const std::optional<Constant> constant = parseConstant(value, value.text, sources_, diagnostics_);
  if (!constant) return;
  symbol.kind = SymbolKind::Constant;
  symbol.constant = *constant;
}

void Symbols::resolveAddress(Symbol& symbol) {
  const Word& value = symbol.declaration->value;
  if (value.text.empty() || std::string_view("#*@%!/+-").find(value.text[0]) != std::string_view::npos) {
    DiagBuilder report = diagnostics_.report(diag::BadOperand, value.range);
    report << value.text << "an address";
    if (isOtherAddress(value.text.substr(1))) report.note(kAddresses);
    return;
  }
  const std::optional<ParsedAddress> parsed = parseAddress(value, value.text, *this, diagnostics_);
  // In a cycle the inner call has reported the error and settled the symbol.
  if (!parsed || !symbol.pending) return;
  const Address& address = parsed->address;
  if (!address.isFixed()) {
    diagnostics_.report(diag::BadOperand, value.range) << value.text << "a fixed address";
    return;
  }
  symbol.kind = address.isBit ? SymbolKind::Bit : SymbolKind::Word;
  symbol.word = address.word;
  symbol.bit = address.bit;
  // NC addresses differ between versions of the control (l.6450).
  if (parsed->base == nullptr && address.word > kFlagsWord && address.word < config_.plcNvram)
    diagnostics_.report(diag::SymbolInNcArea, value.range) << symbol.name << value.text;
}

} // namespace rung::frontend::nct

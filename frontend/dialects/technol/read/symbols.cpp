// Symbols of a program.
#include "frontend/dialects/technol/read/symbols.h"

#include <algorithm>
#include <ranges>

#include "frontend/dialects/technol/read/lexer.h"
#include "ir/support/diag/operand.h"
#include "ir/support/diag/technol.h"
#include "ir/support/meant.h"
#include "rtlib/nc/technol/signals.h"
#include "rtlib/text/letters.h"

namespace rung::frontend::technol {
namespace {

// §24 of the inventory; the values of PLCEVENT_* are defined by this project.
constexpr Predefined kPredefined[] = {
    {"BLOCK_IDLE", 0},
    {"BLOCK_INIT", 1},
    {"BLOCK_MOVE", 2},
    {"BLOCK_DELAY", 3},
    {"BLOCK_DONE", 4}, // man. l.6626
    {"PLCEVENT_STOP_REQ", 1},
    {"PLCEVENT_STOP_EMERGENCY_REQ", 2},
    {"PLCEVENT_STOP", 3},
    {"PLCEVENT_START", 4}, // l.1638
    {"PLCEVENT_START_REQ", 5},
    {"CAN_ERR_OK", 0},
    {"CAN_ERR_XMTFULL", 1},
    {"CAN_ERR_RCVEMPTY", 2}, // l.3696
    {"PLC_COM_ERROR", 1},
    {"PLC_COM_REQ", 2},
    {"PLC_COM_SEND_OVER", 4},
    {"PLC_COM_RECV_OVER", 8}, // l.21193
    {"ECAT_INIT", 1},
    {"ECAT_PREOPERATIONAL", 2},
    {"ECAT_BOOTSTRAP", 3},
    {"ECAT_SAFEOPERATIONAL", 4}, // l.17946
    {"ECAT_OPERATIONAL", 8},
    {"ECATCMD_MASTER_INIT", 1},
    {"ECATCMD_MASTER_PREOPERATIONAL", 2},
    {"ECATCMD_MASTER_BOOTSTRAP", 3}, // l.18210
    {"ECATCMD_MASTER_SAFEOPERATIONAL", 4},
    {"ECATCMD_MASTER_OPERATIONAL", 8},
    {"ECATCMD_SLAVE_INIT", 11},
    {"ECATCMD_SLAVE_PREOPERATIONAL", 12},
    {"ECATCMD_SLAVE_BOOTSTRAP", 13},
    {"ECATCMD_SLAVE_SAFEOPERATIONAL", 14},
    {"ECATCMD_SLAVE_OPERATIONAL", 18},
    {"ECATCMD_MASTER_STATE", 20},
    {"ECATCMD_SLAVE_STATE", 21},
    {"EDRV_DONE", 0},
    {"EDRV_INIT", 1},
    {"EDRV_ON", 2},
    {"EDRV_ENABLE", 3}, // l.10352
    {"PLCTABTYPE_INT", 1},
    {"PLCTABTYPE_REAL", 2},
    {"PLCTABTYPE_STR", 3},
    {"PLCTABTYPE_BIN", 4}, // l.18893
    {"PLCTITEMCHANGED", 1},
    {"PLCTSELLLINECHANGED", 2}, // l.19010
};

const Predefined* findPredefined(std::string_view key) {
  for (const Predefined& p : kPredefined)
    if (p.name == key) return &p;
  return nullptr;
}

ir::Type cellType(nc::SignalType type) {
  switch (type) {
  case nc::SignalType::Bit: return ir::Type::Bit;
  case nc::SignalType::Byte: return ir::Type::I8;
  case nc::SignalType::Word: return ir::Type::I16;
  case nc::SignalType::Dword: return ir::Type::I32;
  case nc::SignalType::Qword: return ir::Type::I64;
  case nc::SignalType::Real: return ir::Type::F64;
  case nc::SignalType::Struct:
  case nc::SignalType::String: return ir::Type::None;
  }
  return ir::Type::None;
}

// Cells of chapter 8 that the PLC may only read are protected (man. l.6238, l.6493, l.6517). An example writes a cell
// of another chapter (l.5921), so writes to those only cause a warning. Weights are not cells.
Protection protectionOf(const nc::Signal& signal) {
  if (signal.direction != nc::Direction::In) return Protection::None;
  return std::string_view(signal.group).starts_with("8.") ? Protection::Error : Protection::Warn;
}

Symbol fromSignal(const nc::Signal& signal) {
  Symbol symbol;
  symbol.name = signal.symbol;
  symbol.predeclared = true;
  symbol.kind = signal.type == nc::SignalType::Bit      ? SymbolKind::Bit
                : signal.type == nc::SignalType::String ? SymbolKind::Text
                                                        : SymbolKind::Cell;
  symbol.type = cellType(signal.type);
  symbol.space = kInterfaceSpace;
  symbol.byte = signal.byteOffset;
  symbol.bit = signal.bit;
  symbol.size = signal.count * signal.strideBytes;
  symbol.structure = signal.structure;
  symbol.protection = protectionOf(signal);
  return symbol;
}

} // namespace

std::span<const Predefined> predefinedConstants() { return kPredefined; }

std::string symbolKey(std::string_view name) {
  const size_t mark = std::min(name.find(kUseMark), name.size());
  return text::upper(name.substr(0, std::min(mark, kSignificant))).append(name.substr(mark));
}

void Symbols::checkName(const Symbol& symbol) {
  if (std::min(symbol.name.find(kUseMark), symbol.name.size()) > kSignificant)
    diagnostics_.report(diag::NameTooLong, symbol.declared) << symbol.name;
  switch (reservedWord(symbol.name)) {
  case Reserved::No: break;
  case Reserved::Warn:
    diagnostics_.report(diag::ReservedWord, symbol.declared).severity(Severity::Warning) << symbol.name;
    break;
  case Reserved::Yes: diagnostics_.report(diag::ReservedWord, symbol.declared) << symbol.name; break;
  }
}

// The symbol that a new symbol of this file would collide with; kNone if there is none.
uint32_t Symbols::inOwnFile(const Symbol& symbol) const {
  const uint32_t own = SymbolTable::find(symbol.name, {kFirstFile + symbol.file});
  if (own != kNone) return own;
  const uint32_t global = SymbolTable::find(symbol.name, {kGlobal});
  return global == kNone || !symbol.local || all()[global].file == symbol.file ? global : kNone;
}

// Whether both declarations are allowed: the same constant twice, or a mechanism and a cell with the same name (man.
// l.12304).
bool Symbols::merge(uint32_t earlier, Symbol& symbol) {
  Symbol& first = edit(earlier);
  if (first.kind == SymbolKind::Constant && symbol.kind == SymbolKind::Constant && first.value == symbol.value)
    return true;
  if (first.kind == SymbolKind::Structure && symbol.kind == SymbolKind::Structure && first.value == symbol.value)
    return true;
  if (first.kind == SymbolKind::Cell && symbol.kind == SymbolKind::Mechanism && first.mechanism == kNone) {
    first.mechanism = symbol.index;
  } else if (first.kind == SymbolKind::Mechanism && symbol.kind == SymbolKind::Cell) {
    symbol.mechanism = first.index;
  } else {
    return false;
  }
  diagnostics_.report(diag::SharedName, symbol.declared).note(first.declared, "also declared here") << symbol.name;
  return true;
}

void Symbols::checkPredeclared(const Symbol& symbol) {
  const Predefined* constant = findPredefined(symbolKey(symbol.name));
  const bool sameConstant = constant && symbol.kind == SymbolKind::Constant && symbol.value == constant->value;
  const nc::Signal* signal = nc::findSignal(nc::technolSignals(), symbolKey(symbol.name), "I");
  if (signal || (constant && !sameConstant)) reportDuplicate(diagnostics_, symbol.name, symbol.declared, {});
}

// Reported once per inclusion, however many names the file declares.
void Symbols::reportIncludedAgain(std::string_view name) {
  if (reportedAgain_.insert(again_.begin).second)
    diagnostics_.report(diag::DuplicateSymbol, again_).note("the file is included before this, and declares it there")
        << name;
}

uint32_t Symbols::declare(Symbol symbol) {
  checkName(symbol);
  const uint32_t earlier = inOwnFile(symbol);
  if (earlier == kNone) {
    checkPredeclared(symbol);
    return enter(symbol, scopeOf(symbol));
  }
  const Symbol& first = all()[earlier];
  if (!merge(earlier, symbol)) {
    const bool sameLine = first.declared == symbol.declared;
    if (sameLine && again_.valid()) {
      reportIncludedAgain(symbol.name);
      return add(symbol);
    }
    reportDuplicate(diagnostics_, symbol.name, symbol.declared, first.declared,
                    sameLine ? "by the macro's first use; T_LOCAL gives each use a name of its own" : kFirstDeclared);
    return add(symbol);
  }
  if (symbol.kind == SymbolKind::Constant || symbol.kind == SymbolKind::Structure) return earlier;
  // The cell carries both meanings.
  return symbol.kind == SymbolKind::Cell ? enter(symbol, scopeOf(first)) : add(symbol);
}

uint32_t Symbols::enterPredeclared(std::string_view name) {
  if (const nc::Signal* signal = nc::findSignal(nc::technolSignals(), name, "I"))
    return enter(fromSignal(*signal), kControl);
  const Predefined* constant = findPredefined(symbolKey(name));
  if (!constant) return kNone;
  Symbol symbol;
  symbol.name = constant->name;
  symbol.kind = SymbolKind::Constant;
  symbol.predeclared = true;
  symbol.value = constant->value;
  return enter(symbol, kControl);
}

uint32_t Symbols::find(std::string_view name, uint32_t file) {
  const uint32_t known = SymbolTable::find(name, {kFirstFile + file, kGlobal, kControl});
  return known != kNone ? known : enterPredeclared(name);
}

uint32_t Symbols::require(const Token& name, uint32_t file) {
  const uint32_t index = find(name.text, file);
  if (index == kNone)
    noteUndefined(name, file, {});
  else
    use(name.range(), index);
  return index;
}

// Whether the word is a number that lacks the 0 before its first letter.
static bool looksLikeNumber(std::string_view word) {
  const bool hex = word.ends_with('h') || word.ends_with('H');
  return (hex || word.find_first_of("0123456789") != std::string_view::npos) && parseNumber("0" + std::string(word));
}

std::string_view describe(ir::Type type) {
  switch (type) {
  case ir::Type::Bit: return "a bit";
  case ir::Type::I8: return "a BYTE";
  case ir::Type::I16: return "a WORD";
  case ir::Type::I32: return "a DWORD";
  case ir::Type::I64: return "a QWORD";
  case ir::Type::F64: return "a REAL";
  case ir::Type::None: break;
  }
  return "a cell of several bytes";
}

std::string_view describe(const Symbol& symbol) {
  switch (symbol.kind) {
  case SymbolKind::Constant: return "a constant";
  case SymbolKind::Label: return "a label";
  case SymbolKind::Procedure: return "a procedure";
  case SymbolKind::Macro: return "a macro";
  case SymbolKind::Structure: return "a structure";
  case SymbolKind::Bit: return "a bit";
  case SymbolKind::Text: return "a text";
  case SymbolKind::Mechanism: return "a mechanism";
  case SymbolKind::Cell: break;
  }
  return describe(symbol.type);
}

static text::Likely similarMember(std::string_view name, const char* structure) {
  if (structure == nullptr || *structure == 0) return {};
  const std::string_view type(structure);
  const size_t prefix = (type == "BLK" ? "BLK[]." : std::string(type) + ".").size();
  const auto isMember = [&](const nc::Signal& signal) { return type == signal.area; };
  return text::likeliest(name, nc::technolSignals() | std::views::filter(isMember),
                         [&](const nc::Signal& signal) { return std::string_view(signal.symbol).substr(prefix); });
}

static text::Likely similarOfControl(std::string_view name) {
  text::Similar similar(name);
  for (const nc::Signal& signal : nc::technolSignals())
    if (std::string_view(signal.area) == "I" || std::string_view(signal.area) == "W") similar.offer(signal.symbol);
  for (const Predefined& constant : kPredefined) similar.offer(constant.name);
  return {similar.best(), similar.certain()};
}

void Symbols::reportUndefined() {
  reportUndeclared(diagnostics_, diag::UndefinedSymbol, [&](DiagBuilder& report, std::span<const UndefinedName> uses) {
    const UndefinedName& first = uses.front();
    const text::Likely meant = similar(first);
    suggestAt(report, placesOf(uses), {meant.word, meant.certain && isMeantByAll(uses, meant.word)});
    if (meant.word.empty() && looksLikeNumber(first.name))
      report.note("as a number: 0" + std::string(first.name));
    else if (meant.word.empty() && first.hint.isBit)
      report.note("a bit is declared between DATA and DATA_END: DFM " + std::string(first.name));
  });
}

// Whether all uses mean the same word. Other files have other names, and other structures other members; a name that a
// macro assembled has no place in a source.
bool Symbols::isMeantByAll(std::span<const UndefinedName> uses, std::string_view word) const {
  const UndefinedName& first = uses.front();
  return std::ranges::all_of(uses, [&](const UndefinedName& use) {
    if (use.range.end.value - use.range.begin.value != use.name.size()) return false;
    const bool isAlike = use.file == first.file && use.hint.structure == first.hint.structure &&
                         use.hint.meant.word == first.hint.meant.word;
    if (isAlike) return true;
    const text::Likely meant = similar(use);
    return meant.certain && meant.word == word;
  });
}

// The visible name most similar to a misspelt one; "" if none is close. Members of the structure are preferred, then
// the program's own names, then those of the control, including bits of bytes.
text::Likely Symbols::similar(const UndefinedName& use) const {
  if (!use.hint.meant.word.empty()) return use.hint.meant;
  if (!diagnostics_.suggests()) return {};
  if (const text::Likely member = similarMember(use.name, use.hint.structure); !member.word.empty()) return member;
  const auto isVisible = [&](const Symbol& symbol) {
    const bool isWritten = symbol.name.find(kUseMark) == std::string_view::npos;
    return isWritten && !symbol.predeclared && (!symbol.local || symbol.file == use.file);
  };
  const text::Likely own = text::likeliest(use.name, all() | std::views::filter(isVisible), &Symbol::name);
  return !own.word.empty() ? own : similarOfControl(use.name);
}

uint32_t Symbols::findWeight(std::string_view name, uint32_t file) {
  const uint32_t index = find(name, file);
  if (index != kNone) return index;
  const nc::Signal* signal = nc::findSignal(nc::technolSignals(), name, "W");
  if (!signal) return kNone;
  // A weight is only a bit number; the program adds it to the byte (man. l.9359).
  Symbol symbol = fromSignal(*signal);
  symbol.protection = Protection::None;
  symbol.space = {};
  return enter(symbol, kControl);
}

uint32_t Symbols::findMember(const char* structure, std::string_view member) {
  if (*structure == 0) return kNone;
  const std::string full = std::string(structure) + "." + std::string(member);
  const nc::Signal* signal = nc::findSignal(nc::technolSignals(), full, structure);
  if (signal == nullptr) return kNone;
  const auto [entry, isNew] = members_.emplace(signal, kNone);
  if (isNew) entry->second = add(fromSignal(*signal));
  return entry->second;
}

// Constant expressions.

std::optional<int64_t> ConstantReader::syntax(SourceRange at, const std::string& found) {
  diagnostics_.report(diag::SyntaxError, at) << "a constant" << found;
  return std::nullopt;
}

std::optional<int64_t> ConstantReader::badNumber(const Token& token) {
  reportBadNumber(token, token.text, diagnostics_);
  return std::nullopt;
}

std::optional<int64_t> ConstantReader::named(const Token& name) {
  const uint32_t index = symbols_.require(name, file_);
  if (index == kNone || symbols_[index].broken) return std::nullopt;
  if (symbols_[index].kind != SymbolKind::Constant) {
    diagnostics_.report(diag::WrongOperandKind, name.range()) << name.text << "no constant" << "a constant";
    return std::nullopt;
  }
  return symbols_[index].value;
}

std::optional<int64_t> ConstantReader::term(const Token& token) {
  if (token.kind == TokenKind::Name) return named(token);
  if (token.kind == TokenKind::Number) {
    const std::optional<Number> number = parseNumber(token.text);
    return number && !number->isReal ? number->value : badNumber(token);
  }
  if (const std::optional<uint8_t> character = characterByte(token.text)) return *character;
  return checkCharacters(token, diagnostics_) ? badNumber(token) : std::nullopt;
}

std::optional<int64_t> ConstantReader::value(std::span<const Token> tokens, SourceRange otherwise) {
  if (tokens.empty()) return syntax(otherwise, "nothing");
  uint64_t sum = 0;
  bool minus = false, wantsTerm = true;
  for (size_t i = 0; i < tokens.size(); ++i) {
    const Token& token = tokens[i];
    if (reportForeignNumber(tokens.subspan(i), diagnostics_)) return std::nullopt;
    if (token.is('+') || token.is('-')) {
      minus = (wantsTerm && minus) != token.is('-');
      wantsTerm = true;
      continue;
    }
    if (!wantsTerm || token.kind == TokenKind::Punct) return syntax(token.range(), "'" + std::string(token.text) + "'");
    const std::optional<int64_t> found = term(token);
    if (!found) return std::nullopt;
    const auto bits = static_cast<uint64_t>(*found);
    sum = minus ? sum - bits : sum + bits;
    minus = wantsTerm = false;
  }
  if (wantsTerm) return syntax(tokens.back().range(), "the end of the operand");
  return static_cast<int64_t>(sum);
}

} // namespace rung::frontend::technol

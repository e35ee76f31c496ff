// Parses operands other than addresses.
#include "frontend/dialects/technol/check/operand_parser.h"

#include <algorithm>
#include <ranges>

#include "frontend/dialects/technol/read/lexer.h"
#include "frontend/dialects/technol/read/symbols.h"
#include "frontend/sema/operand_count.h"
#include "ir/support/diag/technol.h"
#include "rtlib/text/letters.h"
#include "rtlib/text/similar.h"

namespace rung::frontend::technol {
namespace {

struct PrefixName {
  std::string_view name;
  uint8_t prefix;
  ir::Type type;
};
constexpr PrefixName kPrefixes[] = {
    {"BYTE", kByte, ir::Type::I8},   {"WORD", kWord, ir::Type::I16}, {"DWRD", kDword, ir::Type::I32},
    {"QWRD", kQword, ir::Type::I64}, {"HIGH", kHigh, ir::Type::I8},  {"REAL", kReal, ir::Type::F64},
    {"CNST", kCnst, ir::Type::I32},
};

const PrefixName* prefixNamed(std::string_view name) {
  for (const PrefixName& p : kPrefixes)
    if (text::equalsIgnoringCase(name, p.name)) return &p;
  return nullptr;
}

// The most similar prefix among those with the same first letter, or among the others.
text::Likely similarPrefix(std::string_view name, bool sameLetter) {
  const auto fits = [&](const PrefixName& p) { return (p.name[0] == text::upper(name[0])) == sameLetter; };
  return text::likeliest(name, kPrefixes | std::views::filter(fits), &PrefixName::name);
}

const PrefixName& prefixOf(uint8_t prefix) {
  for (const PrefixName& p : kPrefixes)
    if (p.prefix == prefix) return p;
  return kPrefixes[0];
}

uint8_t naturalPrefix(ir::Type type) {
  for (const PrefixName& p : kPrefixes)
    if (p.type == type) return p.prefix;
  return 0;
}

std::string widthsOf(ir::TypeSet types) {
  const bool byte = ir::contains(types, ir::Type::I8), word = ir::contains(types, ir::Type::I16);
  if (ir::contains(types, ir::Type::I32)) return byte ? "at most 32 bits" : "32 bits";
  return byte && word ? "8 or 16 bits" : byte ? "8 bits" : "16 bits";
}

bool isOne(TokenKind kind, std::span<const Token> tokens) { return tokens.size() == 1 && tokens[0].kind == kind; }

// Takes one of the words that a kind accepts by itself or instead of an address.
bool takeWord(const Words& words, std::span<const Token> tokens, Operand& out) {
  if (!isOne(TokenKind::Name, tokens)) return false;
  const int64_t number = numberOfWord(words.list, tokens[0].text);
  if (number < 0) return false;
  out.form = Operand::Form::Keyword;
  out.value = words.first + number;
  return true;
}

bool isNotGiven(std::span<const Token> tokens) {
  return tokens.size() == 1 &&
         (tokens[0].is('-') || (tokens[0].kind == TokenKind::Name && text::equalsIgnoringCase(tokens[0].text, "NIL")));
}

} // namespace

bool OperandParser::syntax(std::string_view expected, std::span<const Token> tokens) {
  return syntax(expected, tokens, statement_->range());
}

bool OperandParser::syntax(std::string_view expected, std::span<const Token> tokens, SourceRange otherwise) {
  const std::string found = tokens.empty() ? "nothing" : "'" + std::string(tokens[0].text) + "'";
  diagnostics_.report(diag::SyntaxError, rangeOf(program_.sources, tokens, otherwise)) << expected << found;
  return false;
}

std::string spell(const Operand& operand) {
  std::string text;
  for (const Token& token : operand.tokens)
    text += token.kind == TokenKind::Text ? "'" + std::string(token.text) + "'" : std::string(token.text);
  return text;
}

bool reportWrongKind(Diagnostics& diagnostics, const Operand& operand, std::string_view is, std::string_view wanted) {
  const bool isText = operand.tokens.size() == 1 && operand.tokens[0].kind == TokenKind::Text;
  diagnostics.report(diag::WrongOperandKind, operand.range)
      << (isText ? std::string(operand.tokens[0].text) : spell(operand)) << is << wanted; // the message has quotes
  return false;
}

const Symbol* OperandParser::usable(uint32_t index) const {
  return index == kNone || symbols_[index].broken ? nullptr : &symbols_[index];
}

uint32_t OperandParser::note(const Token& name, uint32_t symbol) {
  if (symbol != kNone) symbols_.use(name.range(), symbol);
  return symbol;
}

bool OperandParser::parse(const Statement& statement, std::vector<Operand>& out) {
  const size_t first = out.size();
  statement_ = &statement;
  file_ = statement.file;
  const auto operands = splitOperands(program_.operandTokens(statement));
  if (!countFits(statement.row->info, operands.size(), statement.range(), diagnostics_)) return false;
  const auto infos = statement.row->info.operands.all();
  bool ok = true;
  for (size_t i = 0; i < operands.size(); ++i) {
    const OperandInfo& info = infos[std::min(i, infos.size() - 1)];
    Operand& operand = out.emplace_back();
    operand.range = rangeOf(program_.sources, operands[i], statement.range());
    operand.tokens = operands[i];
    operand.access = info.access;
    operand.firstName = static_cast<uint32_t>(symbols_.uses().size());
    ok = one(info, operands[i], operand) && ok;
    operand.nameCount = static_cast<uint32_t>(symbols_.uses().size()) - operand.firstName;
    // The type of the count also applies to the time (man. l.2133).
    inherited_ = i == 0 && (statement.row->effects & kWaits) && operand.prefixed ? naturalPrefix(operand.type) : 0;
  }
  inherited_ = 0;
  while (out.size() - first < infos.size()) out.emplace_back().range = statement.range();
  if (ok && infos.size() >= 2 && infos[0].kind == &kinds::kTimerCell) ok = waitOperands(std::span(out).subspan(first));
  return ok;
}

bool OperandParser::one(const OperandInfo& info, std::span<const Token> tokens, Operand& out) {
  const OperandKind& kind = kindOf(info);
  if (tokens.empty())
    return (info.optional && mayBeOmitted(info)) || kind.omission == Omission::Nothing || syntax("an operand", tokens);
  if (mayBeOmitted(info) && isNotGiven(tokens)) return true;
  return std::visit([&](const auto& takes) { return read(takes, info, tokens, out); }, kind.takes);
}

// Already read by the reader.
bool OperandParser::read(const DeclarationKind&, const OperandInfo&, Tokens, Operand&) { return true; }

bool OperandParser::inRange(int64_t value, int64_t least, int64_t most, SourceRange at) {
  if (value >= least && value <= most) return true;
  diagnostics_.report(diag::OperandRange, at) << value << std::to_string(least) + " to " + std::to_string(most);
  return false;
}

// TIM and TEX: an explicit type applies to count and time, so the time must be a cell (man. l.2133); a constant time
// must fit the count.
bool OperandParser::waitOperands(std::span<Operand> operands) {
  const Operand& count = operands[0];
  Operand& time = operands[1];
  if (count.prefixed && time.isConstant()) {
    const std::string prefix = std::string(prefixOf(naturalPrefix(count.type)).name) + ".";
    diagnostics_.report(diag::InvalidTypePrefix, count.range) << prefix << "a constant time";
    return false;
  }
  const int64_t most = count.type == ir::Type::I8 ? 0xFF : 0xFFFF;
  return !time.isConstant() || inRange(time.value, 0, most, time.range);
}

bool OperandParser::checkWrite(const OperandInfo& info, Protection protection, std::string_view name,
                               SourceRange range) {
  const bool writes = isWritten(info.access);
  if (!writes || protection == Protection::None) return true;
  const bool error = protection == Protection::Error;
  diagnostics_.report(diag::WriteToReadonly, range).severity(error ? Severity::Error : Severity::Warning) << name;
  return !error;
}

uint8_t OperandParser::takePrefix(std::span<const Token>& tokens) {
  if (tokens.size() < 2 || tokens[0].kind != TokenKind::Name || !tokens[1].is('.')) return 0;
  if (text::equalsIgnoringCase(tokens[0].text, "CNTS")) {
    diagnostics_.report(diag::CntsPrefix, tokens[0].range()).fix(tokens[0].range(), "CNST");
    tokens = tokens.subspan(2);
    return kCnst;
  }
  const PrefixName* prefix = prefixNamed(tokens[0].text);
  if (prefix == nullptr) return 0;
  tokens = tokens.subspan(2);
  return prefix->prefix;
}

// Detects a misspelt prefix such as WRD.CELL or DWORD.CELL: no symbol has this name, but a prefix is similar.
bool OperandParser::misspeltPrefix(std::span<const Token> tokens) {
  if (tokens.size() < 3 || tokens[0].kind != TokenKind::Name || !tokens[1].is('.')) return false;
  if (symbols_.find(tokens[0].text, file_) != kNone) return false;
  text::Likely meant = similarPrefix(tokens[0].text, true);
  if (meant.word.empty()) meant = similarPrefix(tokens[0].text, false);
  if (!meant.word.empty()) symbols_.noteUndefined(tokens[0], file_, {.meant = meant});
  return !meant.word.empty();
}

bool OperandParser::read(const NumberKind& kind, const OperandInfo& info, Tokens tokens, Operand& out) {
  if (kind.text && isOne(TokenKind::Text, tokens)) return literal(tokens[0], out);
  if (kind.sign && tokens[0].is('-')) {
    out.negated = true;
    tokens = tokens.subspan(1);
  }
  if (tokens.size() > 1 && text::equalsIgnoringCase(tokens[0].text, "BLK") && tokens[1].is('['))
    return block(info, tokens, false, out);
  if (ownWord(kind, tokens, out)) return true;
  const uint8_t prefix = takePrefix(tokens);
  if (prefix != 0 && (kind.prefixes & prefix) == 0) {
    wrongPrefix(prefix, out);
    // STO CNST.5 also stores to a constant: it would stay wrong without the prefix.
    return prefix == kCnst && info.access != Access::Read && wrongKind(out, "a constant", "a variable");
  }
  if (prefix == 0 && misspeltPrefix(tokens)) return false;
  Address address;
  if (tokens.empty()) return syntax("a value", tokens);
  if (!this->address(tokens, address)) return false;
  if (prefix == kCnst && address.hasBase) return wrongKind(out, "no constant", "a constant");
  return address.hasBase ? cell(kind, info, address, prefix != 0 ? prefix : inherited_, out)
                         : constant(kind, info, address, prefix, out);
}

bool OperandParser::constant(const NumberKind& kind, const OperandInfo& info, const Address& address, uint8_t prefix,
                             Operand& out) {
  if (kind.source == Source::Cell) return wrongKind(out, "a constant", "a variable");
  if (prefix == kQword || prefix == kReal || prefix == kHigh) {
    diagnostics_.report(diag::InvalidTypePrefix, out.range) << std::string(prefixOf(prefix).name) + "." << "a constant";
    return false;
  }
  if (address.isReal) {
    if ((kind.prefixes & kReal) == 0 || (prefix != 0 && prefix != kCnst)) return wrongKind(out, "a real", "an integer");
    out.form = Operand::Form::Real;
    out.type = ir::Type::F64;
    out.real = out.negated ? -address.real : address.real;
    out.negated = false;
    return true;
  }
  out.form = Operand::Form::Integer;
  out.prefixed = prefix != 0 && prefix != kCnst;
  out.type = prefix == 0 ? ir::Type::I32 : prefixOf(prefix).type;
  // A sign before digits belongs to the number; before a type or a name it negates the loaded value (man. l.703).
  const bool digits = out.negated && out.tokens[1].kind == TokenKind::Number;
  out.value = digits ? -address.byte : address.byte;
  out.negated = out.negated && !digits;
  const uint32_t width = ir::bitWidth(out.type);
  const bool ranged = info.min <= info.max;
  const int64_t least = ranged ? info.min : -(int64_t{1} << (width - 1));
  const int64_t most = ranged ? info.max : (int64_t{1} << width) - 1;
  return inRange(out.value, least, most, out.range);
}

bool OperandParser::cell(const NumberKind& kind, const OperandInfo& info, const Address& address, uint8_t prefix,
                         Operand& out) {
  if (address.isBit) return wrongKind(out, "a bit", "a variable");
  if (kind.source == Source::Constant) return wrongKind(out, "a variable", "a constant");
  out.form = Operand::Form::Cell;
  out.prefixed = prefix != 0;
  out.type = prefix != 0 ? prefixOf(prefix).type : address.type;
  // If only a REAL is possible, 8 bytes are one.
  const bool real = (kind.prefixes & ~kCnst) == kReal && address.end - address.byte >= 8;
  if (out.type == ir::Type::None && real && !address.isText) out.type = ir::Type::F64;
  if (out.type == ir::Type::None) {
    if (address.isText) return wrongKind(out, "a text", "a cell");
    diagnostics_.report(diag::UntypedOperand, out.range) << address.name;
    return false;
  }
  if (!ir::contains(kind.types, out.type))
    return wrongKind(out, "of another width", "a cell of " + widthsOf(kind.types));
  const uint8_t natural = naturalPrefix(out.type);
  if (kind.prefixes != 0 && prefix == 0 && (kind.prefixes & natural) == 0) return wrongPrefix(natural, out);
  const int64_t byte = address.byte + (prefix == kHigh ? 1 : 0);
  return setPlace(address, byte, ir::byteWidth(out.type), out) &&
         checkWrite(info, address.protection, address.name, out.range);
}

bool OperandParser::read(const NameKind& kind, const OperandInfo& info, Tokens tokens, Operand& out) {
  const std::string wanted = "a " + std::string(info.kind->name);
  if (isOne(TokenKind::Number, tokens)) return wrongKind(out, "a number", wanted);
  if (!isOne(TokenKind::Name, tokens)) return syntax("the name of " + wanted, tokens);
  const Symbol* symbol = usable(require(tokens[0]));
  if (symbol == nullptr) return false;
  const bool shared = kind.symbol == SymbolKind::Mechanism && symbol->mechanism != kNone;
  if (symbol->kind != kind.symbol && !shared) return wrongKind(out, describe(*symbol), wanted);
  out.index = shared ? symbol->mechanism : symbol->index;
  out.form = Operand::Form::Name;
  return true;
}

bool OperandParser::read(const RegisterKind&, const OperandInfo& info, Tokens tokens, Operand& out) {
  if (tokens.size() == 1 && text::equalsIgnoringCase(tokens[0].text, info.name))
    return out.form = Operand::Form::Register, true;
  diagnostics_.report(diag::UnsupportedAssembler, statement_->range()).note("in this language: LOD and STO")
      << statement_->row->info.mnemonic;
  return false;
}

bool OperandParser::read(const WidthKind& kind, const OperandInfo& info, Tokens tokens, Operand& out) {
  const std::string_view doc = info.kind->doc;
  const PrefixName* width = isOne(TokenKind::Name, tokens) ? prefixNamed(tokens[0].text) : nullptr;
  if (width != nullptr && (kind.prefixes & width->prefix) == 0) {
    diagnostics_.report(diag::InvalidTypePrefix, out.range).note(doc) << width->name << statement_->row->info.mnemonic;
    return false;
  }
  if (width != nullptr) {
    out.form = Operand::Form::Width;
    out.type = width->type;
    return true;
  }
  if (!kind.bit) return syntax(doc.substr(0, doc.find(';')), tokens);
  const auto number = ConstantReader(symbols_, diagnostics_, file_).value(tokens, statement_->range());
  if (!number) return false;
  out.form = Operand::Form::Integer;
  out.value = *number;
  return inRange(*number, info.min, info.max, out.range);
}

bool OperandParser::wrongPrefix(uint8_t prefix, const Operand& operand) {
  diagnostics_.report(diag::InvalidTypePrefix, operand.range)
      << std::string(prefixOf(prefix).name) + "." << statement_->row->info.mnemonic;
  return false;
}

// Takes a word of the kind, unless the program uses it as the name of a number.
bool OperandParser::ownWord(const NumberKind& kind, std::span<const Token> tokens, Operand& out) {
  if (kind.words.list.empty() || !isOne(TokenKind::Name, tokens)) return false;
  const uint32_t found = symbols_.find(tokens[0].text, file_);
  const bool fits =
      found != kNone && (symbols_[found].kind == SymbolKind::Cell || symbols_[found].kind == SymbolKind::Constant);
  Words words = kind.words;
  if (kind.axes && !axisNames_.empty()) words.list = axisNames_;
  return !fits && takeWord(words, tokens, out);
}

bool OperandParser::read(const WordKind& kind, const OperandInfo& info, Tokens tokens, Operand& out) {
  return takeWord(kind.words, tokens, out) || noWord(kind.words.list, info, tokens, out);
}

bool OperandParser::read(const MemberKind& kind, const OperandInfo& info, Tokens tokens, Operand& out) {
  const bool isName = isOne(TokenKind::Name, tokens);
  const uint32_t member = isName ? symbols_.findMember(kind.structure, tokens[0].text) : kNone;
  if (member == kNone) return noWord("", info, tokens, out);
  out.form = Operand::Form::Keyword;
  out.value = symbols_[note(tokens[0], member)].byte;
  return true;
}

// Reports a name that is not a word of the kind: it is either unknown or a symbol of another kind.
bool OperandParser::noWord(std::string_view words, const OperandInfo& info, std::span<const Token> tokens,
                           const Operand& out) {
  const std::string wanted(info.kind->name);
  if (tokens.size() != 1) return syntax("a " + wanted, tokens);
  const bool unknown = tokens[0].kind == TokenKind::Name && symbols_.find(tokens[0].text, file_) == kNone;
  if (!unknown) return wrongKind(out, "no " + wanted, "a " + wanted);
  text::Similar meant(tokens[0].text);
  forEachWord(words, [&](std::string_view word, int64_t) { meant.offer(word); });
  symbols_.noteUndefined(tokens[0], file_, {.meant = {meant.best(), meant.certain()}});
  return false;
}

namespace {

// For TEXT+BX or TEXT+2+BX: stores the tokens without `+BX` in `plain`. False without an index.
bool withoutIndex(std::span<const Token> tokens, std::vector<Token>& plain) {
  const auto isBx = [&](size_t i) {
    return i + 1 < tokens.size() && tokens[i].is('+') && text::equalsIgnoringCase(tokens[i + 1].text, "BX") &&
           (i + 2 == tokens.size() || tokens[i + 2].is('+') || tokens[i + 2].is('-') || tokens[i + 2].is(')'));
  };
  size_t at = 1;
  while (at < tokens.size() && !isBx(at)) ++at;
  if (at >= tokens.size()) return false;
  plain.assign(tokens.begin(), tokens.end());
  plain.erase(plain.begin() + static_cast<std::ptrdiff_t>(at), plain.begin() + static_cast<std::ptrdiff_t>(at) + 2);
  return true;
}

} // namespace

bool OperandParser::literal(const Token& text, Operand& out) {
  out.form = Operand::Form::Text;
  out.text = texts_.emplace_back(memoryText(text, diagnostics_));
  return true;
}

bool OperandParser::read(const MemoryKind& kind, const OperandInfo& info, Tokens tokens, Operand& out) {
  using Content = MemoryKind::Content;
  if (isOne(TokenKind::Text, tokens))
    return kind.content == Content::TextOrLiteral ? literal(tokens[0], out) : wrongKind(out, "a text", "a variable");
  if (takeWord(kind.words, tokens, out)) return true;
  if (const uint8_t prefix = takePrefix(tokens); prefix != 0) {
    if ((kind.prefixes & prefix) == 0) return wrongPrefix(prefix, out);
    out.prefixed = true;
    out.type = prefixOf(prefix).type;
  }
  if (tokens.empty()) return syntax("a variable", tokens);
  std::vector<Token> plain;
  const bool indexed = withoutIndex(tokens, plain);
  Address address;
  if (!this->address(indexed ? plain : tokens, address)) return false;
  if (!address.hasBase) return wrongKind(out, "a constant", "a variable");
  const bool wantsText = kind.content != Content::Any;
  if (address.isBit || (wantsText && !address.isText))
    return wrongKind(out, address.isBit ? "a bit" : "not a text", wantsText ? "a text" : "a variable");
  address.indexed = address.indexed || indexed;
  out.form = Operand::Form::Cell;
  out.isText = address.isText;
  if (kind.prefixes != 0 && !out.prefixed && !address.isText) out.type = address.type;
  const uint32_t least = kind.pastEnd && !address.indexed ? 0 : 1; // an end address may be one past its memory
  const uint32_t bytes = out.type == ir::Type::None ? least : ir::byteWidth(out.type);
  return setPlace(address, address.byte, bytes, out) && checkWrite(info, address.protection, address.name, out.range);
}

// Operands that are variables of MAP_* and DEF_*, or bits whose numbers are meant.

// Whether the operand is NAME or NAME[n].
bool OperandParser::isVariable(const OperandInfo& info, bool mayBeIndexed, std::span<const Token> tokens,
                               const Operand& out) {
  const TokenKind kind = tokens[0].kind;
  if (kind == TokenKind::Number || kind == TokenKind::Text)
    return wrongKind(out, kind == TokenKind::Number ? "a number" : "a text", "a " + std::string(info.kind->name));
  if (kind != TokenKind::Name) return syntax("a name", tokens);
  const bool indexed = tokens.size() > 3 && tokens[1].is('[') && tokens.back().is(']');
  return tokens.size() == 1 || (indexed && mayBeIndexed) || syntax("a name alone", tokens);
}

bool OperandParser::read(const BitNumberKind&, const OperandInfo& info, Tokens tokens, Operand& out) {
  const Symbol* symbol = isVariable(info, false, tokens, out) ? usable(bitSymbol(tokens[0])) : nullptr;
  if (symbol == nullptr) return false;
  if (symbol->kind != SymbolKind::Bit) return wrongKind(out, describe(*symbol), "a bit");
  out.form = Operand::Form::Bit;
  out.place.bit = symbol->bit;
  return true;
}

bool OperandParser::read(const NewVariableKind& kind, const OperandInfo& info, Tokens tokens, Operand& out) {
  const Symbol* symbol = isVariable(info, kind.array, tokens, out) ? usable(require(tokens[0])) : nullptr;
  if (symbol == nullptr || symbol->exchanged == kNone) return false;
  const uint32_t declaredBy = declarations_.exchanged[symbol->exchanged].statement;
  // Otherwise the name belongs to another symbol, which has been reported.
  return &program_.statements[declaredBy] == statement_ && exchanged(*symbol, out);
}

bool OperandParser::read(const InputKind&, const OperandInfo& info, Tokens tokens, Operand& out) {
  const Symbol* symbol = isVariable(info, true, tokens, out) ? usable(require(tokens[0])) : nullptr;
  if (symbol == nullptr) return false;
  out.value = -1; // all elements
  if (tokens.size() > 1) {
    const auto number =
        ConstantReader(symbols_, diagnostics_, file_).value(tokens.subspan(2, tokens.size() - 3), statement_->range());
    if (!number) return false;
    out.value = *number;
  }
  const Exchanged* input = symbol->exchanged == kNone ? nullptr : &declarations_.exchanged[symbol->exchanged];
  if (input == nullptr || input->kind != nc::ExchangeKind::DefIn)
    return wrongKind(out, "not an input of DEF_IN", "an input of DEF_IN");
  const int64_t count = nc::isText(input->type) ? 1 : input->count;
  return (tokens.size() == 1 || inRange(out.value, 0, count - 1, out.range)) && exchanged(*symbol, out);
}

bool OperandParser::exchanged(const Symbol& symbol, Operand& out) {
  out.form = symbol.kind == SymbolKind::Bit ? Operand::Form::Bit : Operand::Form::Cell;
  out.type = symbol.type;
  out.place = {.space = symbol.space, .byte = symbol.byte, .bit = symbol.bit};
  out.begin = symbol.byte;
  out.end = out.begin + symbol.size;
  out.index = symbol.exchanged;
  return true;
}

} // namespace rung::frontend::technol

// Structures of a program (see struc.h).
#include "frontend/dialects/technol/read/struc.h"

#include <algorithm>
#include <cstring>

#include "frontend/dialects/technol/read/lexer.h"
#include "frontend/dialects/technol/read/symbols.h"
#include "ir/support/diag/source.h"
#include "ir/support/diag/technol.h"
#include "ir/support/hash.h"
#include "rtlib/text/letters.h"

namespace rung::frontend::technol {
namespace {

using Bytes = std::vector<uint8_t>;

bool isWord(const Token& token, std::string_view word) {
  return token.kind == TokenKind::Name && text::equalsIgnoringCase(token.text, word);
}

// Bytes per element of DB, DW, DD, DQ; 0 for any other word.
uint32_t bytesOf(const Token& keyword) {
  const Row* row = keyword.kind == TokenKind::Name ? findRow(keyword.text) : nullptr;
  return row && row->role == Role::MemberSize ? static_cast<uint32_t>(row->variant) : 0;
}

std::string describe(const Token& token) { return "'" + std::string(token.text) + "'"; }

} // namespace

bool Structures::syntax(std::string_view expected, std::span<const Token> tokens, SourceRange otherwise) {
  c_.report(diag::SyntaxError, rangeOf(c_.sources, tokens, otherwise))
      << expected << (tokens.empty() ? "the end of the line" : describe(tokens[0]));
  return false;
}

bool Structures::room(int64_t bytes, SourceRange at) {
  if (bytes <= kMaxData) return true;
  if (!full_) c_.report(diag::TooLarge, at) << "bytes of data" << kMaxData;
  full_ = true;
  return false;
}

// ---- declarations ---------------------------------------------------------------------------------------------------

bool Structures::line(std::span<const Token> tokens) {
  if (tokens.size() >= 2 && tokens[0].kind == TokenKind::Name && tokens[1].kind == TokenKind::Name) {
    // `DFM struc` and `LDR ends` use these words as names.
    const Row* row = findRow(tokens[0].text);
    if (isWord(tokens[1], "STRUC") && !(row && row->role == Role::Dfm)) return begin(tokens[0], tokens[1]), true;
    if (isWord(tokens[1], "ENDS") && (row == nullptr || open_)) return end(tokens[0]), true;
  }
  if (!open_) return false;
  if (isMember(tokens)) return true;
  const bool label = tokens.size() > 1 && tokens[1].is(':');
  if (label || (tokens[0].kind == TokenKind::Name && findRow(tokens[0].text) != nullptr)) {
    abandon(tokens[0].range(), describe(tokens[0]));
    return false;
  }
  return syntax("a member or ends", tokens, tokens[0].range()), true;
}

// Reads a member: [name] DB|DW|DD|DQ|STRUCTURE value; false if the line is not one.
bool Structures::isMember(std::span<const Token> tokens) {
  const auto elementOf = [&](const Token& word) -> Element {
    const uint32_t bytes = bytesOf(word), structure = bytes == 0 ? find(word) : kNone;
    if (structure == kNone) return {.bytes = bytes};
    return {.bytes = static_cast<uint32_t>(c_.declarations.structures[structure].image.size()), .structure = structure};
  };
  const auto known = [](const Element& element) { return element.bytes != 0 || element.structure != kNone; };
  if (const Element element = elementOf(tokens[0]); known(element))
    return member(nullptr, tokens[0], element, tokens.subspan(1)), true;
  if (tokens.size() < 2 || tokens[0].kind != TokenKind::Name) return false;
  const Element element = elementOf(tokens[1]);
  if (!known(element)) return false;
  return member(&tokens[0], tokens[1], element, tokens.subspan(2)), true;
}

void Structures::begin(const Token& name, const Token& keyword) {
  // They are allowed outside all modules, because include files contain them.
  if (structure_.inModule() && !structure_.inData() && !structure_.localOpen())
    c_.report(diag::DeclarationOutsideData, keyword.range()) << "struc";
  if (open_) abandon(name.range(), std::string(name.text) + " struc");
  open_ = true;
  name_ = name;
  made_ = {};
}

void Structures::abandon(SourceRange at, std::string_view found) {
  c_.report(diag::SyntaxError, at) << std::string(name_.text) + " ends" << found;
  open_ = false;
}

// Declaring an identical structure again is not an error: several files may read the same include file. The symbol's
// value is a hash of the contents, which identifies identical structures.
void Structures::end(const Token& name) {
  const bool matches = open_ && symbolKey(name.text) == symbolKey(name_.text);
  if (!matches)
    c_.report(diag::SyntaxError, name.range())
        << (open_ ? std::string(name_.text) + " ends" : std::string("a statement")) << std::string(name.text) + " ends";
  if (!open_) return;
  open_ = false;
  uint64_t contents = hashBytes({reinterpret_cast<const char*>(made_.image.data()), made_.image.size()});
  for (const StructureMember& m : made_.members)
    contents = hashBytes(m.key + "," + std::to_string(m.offset) + "," + std::to_string(contents));
  Symbol symbol = namedSymbol(name_, SymbolKind::Structure, file_, structure_.isLocal());
  symbol.value = static_cast<int64_t>(contents);
  symbol.index = static_cast<uint32_t>(c_.declarations.structures.size());
  c_.declarations.structures.push_back(std::move(made_));
  c_.declarations.structureNames.insert(symbolKey(name_.text));
  c_.symbols.declare(symbol);
}

void Structures::member(const Token* name, const Token& keyword, Element element, std::span<const Token> value) {
  StructureMember made{.offset = static_cast<uint32_t>(made_.image.size()), .structure = element.structure};
  Bytes bytes;
  if (!values(element, value, keyword.range(), bytes)) bytes.resize(element.bytes);
  if (!room(int64_t{made.offset} + static_cast<int64_t>(bytes.size()), keyword.range())) bytes.clear();
  made.bytes = static_cast<uint32_t>(bytes.size());
  made.elementBytes = element.bytes;
  if (name != nullptr) {
    made.key = symbolKey(name->text);
    Symbol symbol = namedSymbol(*name, SymbolKind::Constant, file_, structure_.isLocal());
    symbol.value = made.offset;
    c_.symbols.declare(symbol);
  }
  made_.image.insert(made_.image.end(), bytes.begin(), bytes.end());
  made_.members.push_back(std::move(made));
}

// ---- values ---------------------------------------------------------------------------------------------------------

uint32_t Structures::find(const Token& word) const {
  if (c_.declarations.structures.empty() || word.kind != TokenKind::Name) return kNone;
  if (!c_.declarations.structureNames.contains(symbolKey(word.text))) return kNone;
  const uint32_t index = c_.symbols.find(word.text, file_);
  if (index == kNone || c_.symbols[index].kind != SymbolKind::Structure) return kNone;
  return c_.symbols[index].index;
}

Bytes Structures::instance(uint32_t structure, std::span<const Token> value, SourceRange otherwise) {
  Bytes out;
  const Bytes& image = c_.declarations.structures[structure].image;
  if (!values({static_cast<uint32_t>(image.size()), structure}, value, otherwise, out)) out = image;
  return out;
}

bool Structures::values(Element element, std::span<const Token> tokens, SourceRange otherwise, Bytes& out) {
  if (tokens.empty()) return syntax("a value or ?", tokens, otherwise);
  bool ok = true;
  for (const std::span<const Token> part : splitOperands(tokens)) ok = value(element, part, otherwise, out) && ok;
  return ok;
}

// Reads one value: ? | n DUP(values) | <fields> | 'text' | constant
bool Structures::value(Element element, std::span<const Token> tokens, SourceRange otherwise, Bytes& out) {
  if (tokens.empty()) return syntax("a value or ?", tokens, otherwise);
  for (size_t i = 0; i < tokens.size() && !tokens[i].is('(') && !tokens[i].is('<'); ++i)
    if (isWord(tokens[i], "DUP")) return repeated(element, tokens, i, out);
  if (!room(static_cast<int64_t>(out.size()) + element.bytes, tokens[0].range())) return false;
  if (tokens.size() == 1 && isWord(tokens[0], "?")) {
    if (element.structure == kNone) return out.resize(out.size() + element.bytes), true;
    const Bytes& image = c_.declarations.structures[element.structure].image;
    return out.insert(out.end(), image.begin(), image.end()), true;
  }
  if (element.structure != kNone) {
    if (!tokens[0].is('<') || !tokens.back().is('>') || tokens.size() < 2)
      return syntax("<values> or ?", tokens, otherwise);
    return fields(element.structure, tokens.subspan(1, tokens.size() - 2), otherwise, out);
  }
  const bool text = tokens.size() == 1 && tokens[0].kind == TokenKind::Text;
  if (text && element.bytes == 1 && !tokens[0].text.empty()) {
    const std::string memory = memoryText(tokens[0], c_.diagnostics);
    return out.insert(out.end(), memory.begin(), memory.end()), true;
  }
  return number(element.bytes, tokens, otherwise, out);
}

bool Structures::repeated(Element element, std::span<const Token> tokens, size_t dup, Bytes& out) {
  const SourceRange at = tokens[dup].range();
  const std::optional<int64_t> count = ConstantReader(c_.symbols, c_.diagnostics, file_).value(tokens.first(dup), at);
  if (!count) return false;
  if (*count < 0 || *count > kMaxData) {
    c_.report(diag::OperandRange, rangeOf(c_.sources, tokens.first(dup), at))
        << *count << "0 to " + std::to_string(kMaxData);
    return false;
  }
  const std::span<const Token> inner = tokens.subspan(dup + 1);
  if (inner.size() < 2 || !inner[0].is('(') || !inner.back().is(')')) return syntax("(value) after DUP", inner, at);
  Bytes once;
  if (!values(element, inner.subspan(1, inner.size() - 2), at, once)) return false;
  if (!room(static_cast<int64_t>(out.size()) + *count * static_cast<int64_t>(once.size()), at)) return false;
  for (int64_t i = 0; i < *count; ++i) out.insert(out.end(), once.begin(), once.end());
  return true;
}

// Reads the members in order; an omitted member keeps its declared value.
bool Structures::fields(uint32_t structure, std::span<const Token> tokens, SourceRange otherwise, Bytes& out) {
  const StructureType& type = c_.declarations.structures[structure];
  Bytes made = type.image;
  const auto parts = splitOperands(tokens);
  bool ok = true;
  for (size_t i = 0; i < parts.size(); ++i) {
    if (i >= type.members.size()) {
      c_.report(diag::OperandRange, rangeOf(c_.sources, parts[i], otherwise))
          << std::to_string(parts.size()) + " values" << "at most " + std::to_string(type.members.size());
      return false;
    }
    if (parts[i].empty()) continue;
    const StructureMember& m = type.members[i];
    Bytes bytes;
    ok = value({m.elementBytes, m.structure}, parts[i], otherwise, bytes) && ok;
    if (bytes.size() > m.bytes) {
      c_.report(diag::OperandRange, rangeOf(c_.sources, parts[i], otherwise))
          << std::to_string(bytes.size()) + " bytes" << "at most " + std::to_string(m.bytes);
      return false;
    }
    std::copy(bytes.begin(), bytes.end(), made.begin() + m.offset);
  }
  out.insert(out.end(), made.begin(), made.end());
  return ok;
}

bool Structures::number(uint32_t bytes, std::span<const Token> tokens, SourceRange otherwise, Bytes& out) {
  const std::span<const Token> digits = tokens.subspan(tokens.size() == 2 && (tokens[0].is('-') || tokens[0].is('+')));
  const std::optional<Number> real = digits.size() == 1 ? parseNumber(digits[0].text) : std::nullopt;
  uint64_t bits = 0;
  if (bytes == 8 && real && real->isReal) {
    const double x = tokens[0].is('-') ? -real->real : real->real;
    std::memcpy(&bits, &x, sizeof bits);
  } else {
    const std::optional<int64_t> whole = ConstantReader(c_.symbols, c_.diagnostics, file_).value(tokens, otherwise);
    if (!whole) return false;
    const int64_t most = bytes == 8 ? INT64_MAX : (int64_t{1} << (8 * bytes)) - 1;
    const int64_t least = bytes == 8 ? INT64_MIN : -(int64_t{1} << (8 * bytes - 1));
    if (*whole < least || *whole > most) {
      c_.report(diag::OperandRange, rangeOf(c_.sources, tokens, otherwise))
          << *whole << std::to_string(least) + " to " + std::to_string(most);
      return false;
    }
    bits = static_cast<uint64_t>(*whole);
  }
  for (uint32_t i = 0; i < bytes; ++i) out.push_back(static_cast<uint8_t>(bits >> (8 * i)));
  return true;
}

} // namespace rung::frontend::technol

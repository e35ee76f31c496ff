// Declarations (see declare.h).
#include "frontend/dialects/technol/read/declare.h"

#include "frontend/dialects/technol/read/lexer.h"
#include "frontend/dialects/technol/read/symbols.h"
#include "frontend/dialects/technol/rows/operand_kinds.h"
#include "frontend/sema/operand_count.h"
#include "ir/support/diag/operand.h"
#include "ir/support/diag/source.h"
#include "ir/support/diag/technol.h"
#include "rtlib/text/letters.h"

#include <algorithm>

#include <fmt/format.h>

namespace rung::frontend::technol {
Symbol DeclarationReader::made(const Token& name, SymbolKind kind) const {
  return namedSymbol(name, kind, file_, structure_.isLocal());
}

void DeclarationReader::data(const Statement& statement, const Token* name, uint32_t index, bool badName) {
  if (statement.row->role != Role::Str) structure_.allowsData(statement);
  DataItem item{.role = statement.row->role, .local = structure_.isLocal(), .statement = index};
  const bool needsName = item.role == Role::Str || item.role == Role::Ds;
  if (needsName && name == nullptr && !badName)
    c_.report(diag::MissingLabel, statement.range()) << statement.row->info.mnemonic;
  if (item.role == Role::Str) item.local = false; // texts are global in all files (man. l.1680)
  if (name != nullptr) {
    Symbol symbol = made(*name, item.role == Role::Str ? SymbolKind::Text : SymbolKind::Cell);
    symbol.local = item.local;
    if (item.role == Role::Dfm) symbol.type = ir::Type::I8, symbol.size = 1;
    symbol.space = kDataSpace;
    item.cell = c_.symbols.declare(symbol);
  }
  if (item.role == Role::Dfm) bits(statement, item);
  c_.declarations.items.push_back(std::move(item));
}

void DeclarationReader::alsoNamed(const Token& name) {
  DataItem& item = c_.declarations.items.back();
  Symbol symbol = c_.symbols[item.cell];
  symbol.name = name.text;
  symbol.declared = name.range();
  item.also.push_back(c_.symbols.declare(symbol));
}

void DeclarationReader::bits(const Statement& statement, DataItem& item) {
  item.firstBit = static_cast<uint32_t>(c_.declarations.itemBits.size());
  c_.declarations.itemBits.resize(c_.declarations.itemBits.size() + 8, kNone);
  uint32_t number = 0;
  const auto operands = splitOperands(program_.operandTokens(statement));
  for (std::span<const Token> operand : operands) {
    if (operand.size() == 2 && takeSign(operand, c_.diagnostics)) operand = operand.subspan(1);
    if (number == 8) {
      DiagBuilder report = c_.report(diag::TooManyBits, rangeOf(program_.sources, operand, statement.range()));
      const auto empty = std::ranges::count_if(operands, [](const auto& one) { return one.empty(); });
      if (empty != 0)
        report.note(fmt::format("an empty place between commas counts, too: {} names and {} empty ones",
                                std::ssize(operands) - empty, empty));
      return;
    }
    if (operand.size() == 1 && operand[0].kind == TokenKind::Name) {
      Symbol symbol = made(operand[0], SymbolKind::Bit);
      symbol.type = ir::Type::Bit;
      symbol.space = kDataSpace;
      symbol.bit = number;
      c_.declarations.itemBits[item.firstBit + number] = c_.symbols.declare(symbol);
    } else if (operand.size() > 1 || (operand.size() == 1 && !operand[0].is('-'))) {
      noName(operand, "the name of a bit", statement);
    }
    ++number;
  }
}

void DeclarationReader::noName(std::span<const Token> tokens, std::string_view expected, const Statement& statement) {
  const SourceRange at = rangeOf(program_.sources, tokens, statement.range());
  if (isOneWord(tokens))
    c_.report(diag::BadIdentifier, at) << spelled(tokens);
  else
    c_.report(diag::SyntaxError, at) << expected << (tokens.empty() ? "nothing" : "'" + spelled(tokens) + "'");
}

void DeclarationReader::constant(const Statement& statement) {
  const auto operands = splitOperands(program_.operandTokens(statement));
  if (!countFits(statement.row->info, operands.size(), statement.range(), c_.diagnostics)) return;
  const std::span<const Token> name = operands[0];
  if (name.size() != 1 || name[0].kind != TokenKind::Name) {
    noName(name, "the name of a constant", statement);
    return;
  }
  const std::optional<int64_t> value =
      ConstantReader(c_.symbols, c_.diagnostics, file_).value(operands[1], statement.range());
  const bool fits = value && *value >= INT32_MIN && *value <= int64_t{UINT32_MAX}; // 32 bits (man. l.712)
  if (value && !fits)
    c_.report(diag::OperandRange, rangeOf(program_.sources, operands[1], statement.range()))
        << *value << "-80000000h to 0FFFFFFFFh";
  Symbol symbol = made(name[0], SymbolKind::Constant);
  symbol.value = fits ? *value : 0;
  symbol.broken = !fits;
  c_.symbols.declare(symbol);
}

namespace {

std::string_view onlyName(std::span<const Token> operand) {
  return operand.size() == 1 && operand[0].kind == TokenKind::Name ? operand[0].text : std::string_view();
}

} // namespace

// Declares the variable even if other operands are wrong; those are reported when the statement is checked.
void DeclarationReader::exchanged(const Statement& statement, uint32_t index) {
  using nc::ExchangeKind;
  using nc::ExchangeType;
  const auto operands = splitOperands(program_.operandTokens(statement));
  if (operands.empty() || operands[0].empty() || operands[0][0].kind != TokenKind::Name) return;
  Exchanged made{.kind = static_cast<ExchangeKind>(statement.row->variant), .statement = index};
  const bool mapped = made.kind != ExchangeKind::DefIn && made.kind != ExchangeKind::DefOut;
  int64_t word = 0;
  if (made.kind == ExchangeKind::MapAin || made.kind == ExchangeKind::MapAout) made.type = ExchangeType::Real;
  if (!mapped) word = operands.size() > 2 ? numberOfWord(nc::kExchangeTypeWords, onlyName(operands[2])) : -1;
  if (!mapped && word >= 0) made.type = nc::exchangeTypeOf(word);
  const size_t periodAt = mapped ? 3 : 4;
  const std::string_view period = operands.size() > periodAt ? onlyName(operands[periodAt]) : std::string_view();
  if (text::equalsIgnoringCase(period, "FAST") || text::equalsIgnoringCase(period, "FASTEST"))
    c_.declarations.exchangesFast = true;
  Symbol symbol = exchangedSymbol(operands[0][0], made.type);
  symbol.broken = word < 0;
  symbol.exchanged = static_cast<uint32_t>(c_.declarations.exchanged.size());
  made.symbol = c_.symbols.declare(symbol);
  c_.declarations.exchanged.push_back(made);
}

Symbol DeclarationReader::exchangedSymbol(const Token& name, nc::ExchangeType type) const {
  using nc::ExchangeType;
  Symbol symbol = made(name, type == ExchangeType::Bit    ? SymbolKind::Bit
                             : type == ExchangeType::Text ? SymbolKind::Text
                                                          : SymbolKind::Cell);
  symbol.local = false;
  symbol.space = kExchangeSpace;
  if (type == ExchangeType::Bit)
    symbol.type = ir::Type::Bit;
  else if (type == ExchangeType::Real)
    symbol.type = ir::Type::F64;
  else if (!nc::isText(type))
    symbol.type = ir::intOfBytes(nc::bytesOf(type));
  return symbol;
}

void DeclarationReader::instance(const Statement& statement, const Token* name, uint32_t index, uint32_t type) {
  structure_.allowsData(statement);
  DataItem item{.role = Role::MemberSize, .local = structure_.isLocal(), .statement = index};
  item.image = structures_.instance(type, program_.operandTokens(statement), statement.range());
  if (name != nullptr) {
    Symbol symbol = made(*name, SymbolKind::Cell);
    symbol.space = kDataSpace;
    symbol.size = static_cast<uint32_t>(item.image.size());
    symbol.index = type;
    item.cell = c_.symbols.declare(symbol);
  }
  c_.declarations.items.push_back(std::move(item));
}

namespace {

class Placer {
public:
  explicit Placer(ReadContext& context) : c_(context), program_(context.program) {}
  void place(DataItem& item);
  // Places a variable of MAP_* or DEF_*.
  void place(Exchanged& variable);
  // Places texts that overlay other memory; called last.
  void placeOverlays();

private:
  void placeBits(DataItem& item);
  void placeArray(DataItem& item, const Statement& statement);
  void placeText(DataItem& item, const Statement& statement);
  void placeInstance(DataItem& item, const Statement& statement);
  void fillText(const Symbol& text, const Token& token);
  bool overlay(Symbol& text, std::span<const Token> tokens, const Statement& statement);
  std::optional<int64_t> size(std::span<const Token> tokens, const Statement& statement);
  uint32_t take(DataItem& item, int64_t bytes, const Statement& statement);

  ReadContext& c_;
  const SourceProgram& program_;
  std::vector<uint32_t> overlays_; // indices of items
  bool full_ = false;
};

uint32_t Placer::take(DataItem& item, int64_t bytes, const Statement& statement) {
  const uint32_t at = c_.declarations.dataBytes;
  if (at + bytes > kMaxData) {
    if (!full_) c_.report(diag::TooLarge, statement.range()) << "bytes of data" << kMaxData;
    full_ = true;
    return 0;
  }
  c_.declarations.dataBytes += static_cast<uint32_t>(bytes);
  item.byte = at;
  item.bytes = static_cast<uint32_t>(bytes);
  return at;
}

std::optional<int64_t> Placer::size(std::span<const Token> tokens, const Statement& statement) {
  const std::optional<int64_t> n =
      ConstantReader(c_.symbols, c_.diagnostics, statement.file).value(tokens, statement.range());
  if (n && (*n < 1 || *n > kMaxData)) {
    c_.report(diag::OperandRange, rangeOf(program_.sources, tokens, statement.range()))
        << *n << "1 to " + std::to_string(kMaxData);
    return std::nullopt;
  }
  return n;
}

void Placer::placeBits(DataItem& item) {
  const uint32_t at = take(item, 1, program_.statements[item.statement]);
  if (item.cell != kNone) c_.symbols.edit(item.cell).byte = at;
  for (uint32_t i = 0; i < 8; ++i)
    if (const uint32_t bit = c_.declarations.itemBits[item.firstBit + i]; bit != kNone) c_.symbols.edit(bit).byte = at;
}

void Placer::placeArray(DataItem& item, const Statement& statement) {
  const auto operands = splitOperands(program_.operandTokens(statement));
  if (!countFits(statement.row->info, operands.size(), statement.range(), c_.diagnostics)) return;
  const int64_t bytes = size(operands[0], statement).value_or(1);
  const uint32_t at = take(item, bytes, statement);
  if (item.cell == kNone) return;
  Symbol& cell = c_.symbols.edit(item.cell);
  cell.byte = at;
  cell.size = static_cast<uint32_t>(bytes);
  cell.type = bytes == 8 ? ir::Type::None : ir::intOfBytes(cell.size);
}

// STR n, var+xy: the text overlays existing memory and reserves none. A variable of the program must be in the same
// file (man. l.1695). Called after everything else has been placed.
bool Placer::overlay(Symbol& text, std::span<const Token> tokens, const Statement& statement) {
  const uint32_t index = c_.symbols.require(tokens[0], statement.file);
  if (index == kNone) return false;
  const Symbol base = c_.symbols[index];
  if (base.broken) return false;
  const bool foreign = !base.predeclared && base.file != statement.file;
  if (base.kind != SymbolKind::Cell || foreign) {
    c_.report(diag::WrongOperandKind, tokens[0].range())
        << tokens[0].text << (foreign ? "a name of another file" : "no variable") << "a variable of this file";
    return false;
  }
  std::optional<int64_t> offset = 0;
  if (tokens.size() > 1) {
    std::vector<Token> terms(tokens.begin() + 1, tokens.end());
    for (Token& token : terms)
      if (token.is('.')) token.text = "+"; // a member is its offset
    const bool plus = terms.size() > 1 && terms[0].is('+');
    offset = ConstantReader(c_.symbols, c_.diagnostics, statement.file)
                 .value(std::span<const Token>(terms).subspan(plus), statement.range());
  }
  if (!offset) return false;
  // In the interface a text must stay inside its cell; in the program's data it may be anywhere.
  const int64_t first = base.predeclared ? base.byte : 0;
  const int64_t end = base.predeclared ? int64_t{base.byte} + base.size : int64_t{c_.declarations.dataBytes};
  if (*offset < first - base.byte || *offset > end - base.byte - text.size) {
    c_.report(diag::AddressOutOfRange, rangeOf(program_.sources, tokens, statement.range()))
        << std::string(tokens[0].text) + (*offset < 0 ? "" : "+") + std::to_string(*offset)
        << (base.predeclared ? std::string(base.name) : std::string("the program's data"));
    return false;
  }
  text.space = base.space;
  text.byte = static_cast<uint32_t>(base.byte + *offset);
  text.protection = base.protection;
  text.isOverlay = true;
  return true;
}

void Placer::fillText(const Symbol& text, const Token& token) {
  const std::string inMemory = memoryText(token, c_.diagnostics);
  std::string_view value = inMemory;
  if (value.size() > text.size - 1) {
    c_.report(diag::StringTooLong, token.range()) << value.size() << text.size - 1;
    value = value.substr(0, text.size - 1);
  }
  if (!value.empty())
    c_.declarations.inits.push_back({.space = text.space, .byte = text.byte, .data = {value.begin(), value.end()}});
}

void Placer::placeText(DataItem& item, const Statement& statement) {
  const auto operands = splitOperands(program_.operandTokens(statement));
  if (!countFits(statement.row->info, operands.size(), statement.range(), c_.diagnostics)) return;
  const int64_t characters = size(operands[0], statement).value_or(1);
  if (item.cell == kNone) return;
  Symbol& text = c_.symbols.edit(item.cell);
  text.size = static_cast<uint32_t>(characters) + 1;
  const bool onMemory = operands.size() == 2 && !operands[1].empty() && operands[1][0].kind == TokenKind::Name;
  if (onMemory) {
    overlays_.push_back(static_cast<uint32_t>(&item - c_.declarations.items.data()));
    return;
  }
  text.byte = take(item, text.size, statement);
  if (operands.size() == 1) return;
  if (operands[1].size() == 1 && operands[1][0].kind == TokenKind::Text)
    fillText(text, operands[1][0]);
  else
    c_.report(diag::SyntaxError, rangeOf(program_.sources, operands[1], statement.range()))
        << "a text or an address" << "something else";
}

void Placer::placeInstance(DataItem& item, const Statement& statement) {
  const uint32_t at = take(item, static_cast<int64_t>(item.image.size()), statement);
  if (item.cell != kNone) c_.symbols.edit(item.cell).byte = at;
  const bool zero = std::all_of(item.image.begin(), item.image.end(), [](uint8_t byte) { return byte == 0; });
  if (!zero && !full_) c_.declarations.inits.push_back({.space = kDataSpace, .byte = at, .data = item.image});
}

void Placer::place(DataItem& item) {
  const Statement statement = program_.statements[item.statement];
  switch (item.role) {
  case Role::Dfm: placeBits(item); break;
  case Role::Ds: placeArray(item, statement); break;
  case Role::Str: placeText(item, statement); break;
  case Role::MemberSize: placeInstance(item, statement); break;
  default: break;
  }
}

// The operand is NAME or NAME[n].
void Placer::place(Exchanged& variable) {
  const Statement statement = program_.statements[variable.statement];
  const std::span<const Token> name = splitOperands(program_.operandTokens(statement))[0];
  const bool isText = variable.type == nc::ExchangeType::Text;
  const uint32_t bytes = nc::bytesOf(variable.type);
  int64_t count = nc::isText(variable.type) ? 0 : 1;
  if (name.size() > 3 && name[1].is('[') && name.back().is(']')) {
    const auto inside = name.subspan(2, name.size() - 3);
    count = ConstantReader(c_.symbols, c_.diagnostics, statement.file).value(inside, statement.range()).value_or(-1);
    if (count < 0) c_.symbols.edit(variable.symbol).broken = true;
    if (count < 0) return;
  }
  if (count < 1 || count > kMaxData / bytes || c_.declarations.exchangedBytes + count * bytes > kMaxData) {
    c_.report(diag::OperandRange, rangeOf(program_.sources, name, statement.range()))
        << count << "1 to " + std::to_string(kMaxData / bytes);
    c_.symbols.edit(variable.symbol).broken = true;
    return;
  }
  Symbol& symbol = c_.symbols.edit(variable.symbol);
  variable.count = static_cast<uint32_t>(count) + (isText ? 1 : 0);
  symbol.byte = c_.declarations.exchangedBytes;
  symbol.size = variable.count * bytes;
  if (variable.type == nc::ExchangeType::Binary && symbol.size != 8) symbol.type = ir::intOfBytes(symbol.size);
  c_.declarations.exchangedBytes += symbol.size;
}

void Placer::placeOverlays() {
  for (const uint32_t index : overlays_) {
    const DataItem& item = c_.declarations.items[index];
    const Statement statement = program_.statements[item.statement];
    const auto operands = splitOperands(program_.operandTokens(statement));
    Symbol text = c_.symbols[item.cell]; // a copy: looking up the base may add symbols
    text.broken = !overlay(text, operands[1], statement) || text.broken;
    c_.symbols.edit(item.cell) = text;
  }
}

} // namespace

void placeData(ReadContext& context) {
  Declarations& declarations = context.declarations;
  Placer placer(context);
  for (DataItem& item : declarations.items) placer.place(item);
  for (Exchanged& variable : declarations.exchanged) placer.place(variable);
  placer.placeOverlays();
  for (const DataItem& item : declarations.items)
    for (const uint32_t also : item.also) {
      Symbol& symbol = context.symbols.edit(also);
      const Symbol named = symbol;
      symbol = context.symbols[item.cell];
      symbol.name = named.name;
      symbol.declared = named.declared;
    }
}

} // namespace rung::frontend::technol

// Addresses in operands: bits, cells, offsets, members, the register BX, command blocks (§4.1, §4.2, §28.3 of the
// inventory).
#include <algorithm>

#include "frontend/dialects/technol/check/operand_parser.h"
#include "frontend/dialects/technol/read/lexer.h"
#include "ir/support/diag/operand.h"
#include "ir/support/diag/source.h"
#include "ir/support/diag/technol.h"
#include "rtlib/nc/technol/signals.h"
#include "rtlib/text/letters.h"

namespace rung::frontend::technol {
namespace {

constexpr int kMostBrackets = 100; // nesting depth

// Index of the last point outside brackets, or npos.
size_t lastPoint(std::span<const Token> tokens) {
  int depth = 0;
  for (size_t i = tokens.size(); i-- > 0;) {
    if (tokens[i].is(')') || tokens[i].is(']')) ++depth;
    if (tokens[i].is('(') || tokens[i].is('[')) --depth;
    if (depth == 0 && tokens[i].is('.')) return i;
  }
  return std::string_view::npos;
}

struct PrefixType {
  uint8_t prefix;
  ir::Type type;
};
// Types for the second prefix of a block's element; without a prefix it is a DWRD (man. l.7026).
constexpr PrefixType kBlockPrefixes[] = {{kByte, ir::Type::I8},
                                         {kWord, ir::Type::I16},
                                         {kDword, ir::Type::I32},
                                         {kQword, ir::Type::I64},
                                         {kReal, ir::Type::F64}};

// Whether the operand is `NOT X` of other languages; NOT alone may be a name of the program.
bool isNotWord(std::span<const Token> tokens) {
  return tokens.size() > 1 && text::equalsIgnoringCase(tokens[0].text, "NOT") && tokens[0].kind == TokenKind::Name &&
         (tokens[1].kind == TokenKind::Name || tokens[1].is('('));
}

// Reports `LA (X` and `LO Y)` of other languages.
bool reportBracket(Diagnostics& diagnostics, SourceRange operand, std::string_view bracket) {
  diagnostics.report(diag::SyntaxError, operand)
          .note("there are no brackets around conditions: LDR begins what is inside, and LA or LO without an operand "
                "joins it where the bracket ends")
      << "a bit" << bracket;
  return false;
}

bool isBx(const Token& token) { return token.kind == TokenKind::Name && text::equalsIgnoringCase(token.text, "BX"); }

} // namespace

// ---- addresses ------------------------------------------------------------------------------------------------------

// term {+|- term}
bool OperandParser::address(std::span<const Token> tokens, Address& out) {
  int sign = 1;
  bool good = true; // a bad term must not hide errors in the others
  size_t i = 0;
  if (tokens.empty()) return syntax("an address", tokens);
  while (i < tokens.size()) {
    while (i < tokens.size() && (tokens[i].is('+') || tokens[i].is('-'))) sign = tokens[i++].is('-') ? -sign : sign;
    size_t end = i;
    for (int depth = 0; end < tokens.size(); ++end) {
      if (tokens[end].is('(') || tokens[end].is('[')) ++depth;
      if (tokens[end].is(')') || tokens[end].is(']')) --depth;
      if (depth > kMostBrackets) {
        diagnostics_.report(diag::TooDeep, tokens[end].range()) << "brackets" << kMostBrackets;
        return false;
      }
      if (depth == 0 && (tokens[end].is('+') || tokens[end].is('-'))) break;
    }
    if (end == i) return syntax("an address", tokens.subspan(i));
    good = term(tokens.subspan(i, end - i), sign, out) && good;
    sign = 1;
    i = end;
  }
  return good;
}

// ( address ) | number | 'c' | name, each with [BX] and members after it
bool OperandParser::term(std::span<const Token> tokens, int sign, Address& out) {
  const Token& head = tokens[0];
  size_t i = 1;
  if (head.is('(')) {
    int depth = 1;
    while (i < tokens.size() && depth > 0) {
      if (tokens[i].is('(')) ++depth;
      if (tokens[i].is(')')) --depth;
      ++i;
    }
    if (depth != 0 || sign < 0) return syntax("a closed bracket", tokens);
    if (!address(tokens.subspan(1, i - 2), out)) return false;
  } else if (head.kind == TokenKind::Number) {
    const std::optional<Number> number = parseNumber(head.text);
    const bool pointAfter = tokens.size() > 1 && tokens[1].is('.'); // 1. and 5.A
    if (!number || pointAfter) {
      reportBadNumber(head, std::string(head.text) + (pointAfter ? "." : ""), diagnostics_);
      return false;
    }
    out.isReal = out.isReal || number->isReal;
    out.real += sign * (number->isReal ? number->real : static_cast<double>(number->value));
    out.byte = static_cast<int64_t>(static_cast<uint64_t>(out.byte) +
                                    static_cast<uint64_t>(sign) * static_cast<uint64_t>(number->value));
  } else if (head.kind == TokenKind::Text) {
    const std::optional<uint8_t> character = characterByte(head.text);
    if (!character) {
      if (checkCharacters(head, diagnostics_))
        diagnostics_.report(diag::WrongOperandKind, head.range()) << "'" + std::string(head.text) + "'" << "a text"
                                                                  << "a value or one character";
      return false;
    }
    out.byte += int64_t{sign} * *character;
  } else if (head.kind == TokenKind::Name) {
    if (!addSymbol(head, sign, out)) return false;
  } else {
    return !reportForeignNumber(tokens, diagnostics_) && syntax("a name", tokens);
  }
  for (; i < tokens.size();) {
    if (tokens[i].is('[') && i + 2 < tokens.size() && isBx(tokens[i + 1]) && tokens[i + 2].is(']') && out.hasBase) {
      out.indexed = true;
      i += 3;
    } else if (tokens[i].is('.') && i + 1 < tokens.size() && tokens[i + 1].kind == TokenKind::Name && out.hasBase) {
      if (!addMember(tokens[i + 1], out)) return false;
      i += 2;
    } else {
      return syntax("an address", tokens.subspan(i));
    }
  }
  return true;
}

bool OperandParser::addSymbol(const Token& name, int sign, Address& out) {
  const Symbol* found = usable(require(name));
  if (found == nullptr) return false;
  const Symbol& symbol = *found;
  const auto wrong = [&](std::string_view is) {
    diagnostics_.report(diag::WrongOperandKind, name.range()) << name.text << is << "a variable or a constant";
    return false;
  };
  switch (symbol.kind) {
  case SymbolKind::Constant:
    out.byte += sign * symbol.value;
    out.real += sign * static_cast<double>(symbol.value);
    return true;
  case SymbolKind::Label:
  case SymbolKind::Procedure:
  case SymbolKind::Macro:
  case SymbolKind::Structure: return wrong(describe(symbol));
  case SymbolKind::Bit:
  case SymbolKind::Cell:
  case SymbolKind::Text:
  case SymbolKind::Mechanism: break;
  }
  if (sign < 0 || out.hasBase || !symbol.space.valid())
    return wrong(symbol.space.valid() ? "an address, which cannot be subtracted or added" : "a bit number");
  out.hasBase = true;
  out.isBit = symbol.kind == SymbolKind::Bit || symbol.kind == SymbolKind::Mechanism;
  out.isText = symbol.kind == SymbolKind::Text;
  out.space = symbol.space;
  out.byte += symbol.byte;
  out.begin = symbol.byte;
  out.end = static_cast<int64_t>(symbol.byte) + symbol.size;
  out.type = symbol.kind == SymbolKind::Cell ? symbol.type : ir::Type::None;
  out.protection = symbol.protection;
  out.name = name.text;
  out.structure = symbol.structure;
  out.own = symbol.kind == SymbolKind::Cell ? symbol.index : kNone;
  return true;
}

// Adds a member of a structure of the program. A single member sets the type; an array leaves it open.
bool OperandParser::addOwnMember(const Token& member, Address& out) {
  const std::string key = symbolKey(member.text);
  for (const StructureMember& m : declarations_.structures[out.own].members) {
    if (m.key != key) continue;
    const bool one = m.structure == kNone && m.bytes == m.elementBytes;
    out.byte += m.offset;
    out.end = out.byte + m.bytes;
    out.type = one ? ir::intOfBytes(m.bytes) : ir::Type::None;
    if (m.bytes == 8) out.type = ir::Type::None; // a QWORD or a REAL
    out.own = m.structure;
    note(member, symbols_.find(member.text, file_));
    return true;
  }
  return false;
}

// Adds a member of a CAN packet. These need no declaration: the manual's examples use them on plain texts of 12 bytes
// (man. l.3868-3874, l.3892-4046).
bool OperandParser::addPacketMember(const Token& member, Address& out) {
  const uint32_t found = symbols_.findMember("TCANMSGS", member.text);
  if (found == kNone) return false;
  out.byte += symbols_[note(member, found)].byte;
  return true;
}

// Adds a member. A member of an interface structure also sets the type; after any other address it is a constant
// offset.
bool OperandParser::addMember(const Token& member, Address& out) {
  if (out.own != kNone && addOwnMember(member, out)) return true;
  if (const uint32_t found = symbols_.findMember(out.structure, member.text); found != kNone) {
    const Symbol& inside = symbols_[note(member, found)];
    out.byte += inside.byte;
    out.type = inside.type;
    out.isBit = inside.kind == SymbolKind::Bit;
    out.isText = inside.kind == SymbolKind::Text;
    out.begin = out.byte;
    out.end = out.byte + inside.size;
    out.structure = inside.structure;
    return true;
  }
  const uint32_t index = note(member, symbols_.find(member.text, file_));
  if (index == kNone && addPacketMember(member, out)) return true;
  if (index == kNone) return symbols_.noteUndefined(member, file_, {.structure = out.structure}), false;
  const Symbol& symbol = symbols_[index];
  if (symbol.broken) return false;
  if (symbol.kind != SymbolKind::Constant) {
    diagnostics_.report(diag::WrongOperandKind, member.range())
        << member.text << "no member" << "a member of a structure";
    return false;
  }
  out.byte += symbol.value;
  return true;
}

// Whether an offset from an interface cell leads outside the cell (PLC_MEM_BACKUP has 10000 bytes, man. l.7549).
// Without an offset a wider type may reach the following cells (STO WORD.BZH09 also writes BZH10, man. l.6572; LOD
// WORD.PB11, l.7796).
bool OperandParser::leavesItsCell(const Address& address, int64_t byte, uint32_t bytes) {
  const bool isMoved = address.hasBase && address.byte != address.begin;
  return address.space == kInterfaceSpace && isMoved && !address.indexed &&
         (byte < address.begin || byte + bytes > address.end);
}

bool OperandParser::setPlace(const Address& address, int64_t byte, uint32_t bytes, Operand& out) {
  out.place.space = address.space;
  out.begin = address.begin;
  out.end = address.end;
  out.indexed = address.indexed;
  // An index is checked at run time; now only addresses that no index can correct are errors.
  const int64_t slack = address.indexed ? 0xFFFF : 0;
  if (byte < -slack || byte + bytes > declarations_.bytesOf(address.space) + slack) {
    diagnostics_.report(diag::AddressOutOfRange, out.range)
        << spell(out) << (address.space == kInterfaceSpace ? "the interface" : "the program's data");
    return false;
  }
  if (leavesItsCell(address, byte, bytes)) {
    diagnostics_.report(diag::AddressOutOfRange, out.range) << spell(out) << address.name;
    return false;
  }
  if (address.indexed)
    out.offset = byte;
  else
    out.place.byte = static_cast<uint32_t>(byte);
  return true;
}

// ---- bits -----------------------------------------------------------------------------------------------------------

// Reports a negation that is not allowed, such as WR -X or EDGE_H -X.
bool OperandParser::reportNegated(bool writes, const Operand& out) {
  diagnostics_.report(diag::WrongOperandKind, out.range)
          .note(writes ? "what is written is inverted before: CA and WR X, or MOVR X,-Y"
                       : "the other edge of the bit is that of EDGE_L or EDGE_H")
      << spelled(out.tokens) << "negated" << "a plain bit";
  return false;
}

// Reports a missing or wrong bit name, as in I0.0 and BITS.8.
bool OperandParser::noBitName(std::span<const Token> tokens, SourceRange point) {
  const std::string found = tokens.empty() ? "nothing" : "'" + std::string(tokens[0].text) + "'";
  DiagBuilder report = diagnostics_.report(diag::SyntaxError, rangeOf(program_.sources, tokens, point));
  report << "the name of a bit after the point" << found;
  if (!tokens.empty() && tokens[0].kind == TokenKind::Number)
    report.note("bits have names, which DFM declares: BYTE.NAME is the bit of this name in a byte");
  return false;
}

// Reports NOT X.
bool OperandParser::negatedByWord(bool mayBeNegated, bool writes, std::span<const Token> tokens, const Operand& out) {
  if (!mayBeNegated) return reportNegated(writes, out);
  DiagBuilder report = diagnostics_.report(diag::SyntaxError, tokens[0].range());
  report << "a bit" << "'" + std::string(tokens[0].text) + "'";
  report.note("a bit is negated by a '-'").fix({tokens[0].pos, tokens[1].pos}, "-");
  return false;
}

bool OperandParser::read(const BitKind& kind, const OperandInfo& info, Tokens tokens, Operand& out) {
  const bool writes = info.access != Access::Read;
  const bool mayBeNegated = kind.sign && !writes;
  if (isNotWord(tokens)) return negatedByWord(mayBeNegated, writes, tokens, out);
  if (tokens[0].is('-') || tokens[0].is('+')) {
    if (tokens[0].is('-') && !mayBeNegated) return reportNegated(writes, out);
    out.negated = tokens[0].is('-');
    tokens = tokens.subspan(1);
    if (tokens.empty()) return syntax("a bit", tokens);
  }
  out.type = ir::Type::Bit;
  if (tokens.size() > 1 && text::equalsIgnoringCase(tokens[0].text, "BLK") && tokens[1].is('['))
    return block(info, tokens, true, out);
  const size_t point = lastPoint(tokens);
  if (point != std::string_view::npos) {
    if (point + 2 != tokens.size() || tokens[point + 1].kind != TokenKind::Name)
      return noBitName(tokens.subspan(point + 1), tokens[point].range());
    return bitAt(info, tokens.first(point), tokens[point + 1], out);
  }
  if (tokens.size() == 1 && tokens[0].kind == TokenKind::Name) return bareBit(kind, info, tokens[0], out);
  if (tokens.size() == 1 && tokens[0].kind == TokenKind::Number)
    return kind.flag ? flag(tokens[0], out) : wrongKind(out, "a number", "a bit");
  if (tokens[0].is('(') != tokens.back().is(')'))
    return reportBracket(diagnostics_, out.range, tokens[0].is('(') ? "'('" : "')'");
  Address whole;
  return address(tokens, whole) && wrongKind(out, "an address without a bit", "a bit");
}

bool OperandParser::flag(const Token& number, Operand& out) {
  const std::optional<Number> parsed = parseNumber(number.text);
  if (!parsed) {
    reportBadNumber(number, number.text, diagnostics_);
    return false;
  }
  out.form = Operand::Form::Integer;
  out.value = parsed->value;
  if (!parsed->isReal && (out.value == 0 || out.value == 1)) return true;
  diagnostics_.report(diag::OperandRange, out.range) << number.text << "0 or 1";
  return false;
}

uint32_t OperandParser::bitSymbol(const Token& name) {
  const uint32_t index = symbols_.findWeight(name.text, file_);
  if (index == kNone) symbols_.noteUndefined(name, file_, {.isBit = true});
  return note(name, index);
}

bool OperandParser::bareBit(const BitKind& kind, const OperandInfo& info, const Token& name, Operand& out) {
  const Symbol* found = usable(bitSymbol(name));
  if (found == nullptr) return false;
  const Symbol& symbol = *found;
  out.form = Operand::Form::Bit;
  if (symbol.mechanism != kNone) { // a name that is both a cell and a mechanism
    out.place = {.space = kMechanismSpace, .byte = symbol.mechanism * kMechanismBytes};
    return true;
  }
  if (symbol.kind != SymbolKind::Bit && symbol.kind != SymbolKind::Mechanism)
    return wrongKind(out, describe(symbol), "a bit");
  if (!symbol.space.valid() && !kind.number)
    return wrongKind(out, "a bit number", "a bit, with the address of its byte before it");
  out.place = {.space = symbol.space, .byte = symbol.byte, .bit = symbol.bit};
  return checkWrite(info, symbol.protection, name.text, out.range);
}

bool OperandParser::bitAt(const OperandInfo& info, std::span<const Token> where, const Token& name, Operand& out) {
  if (where.empty()) return syntax("an address before the point", where);
  Address address;
  const bool own = where[0].is('$');
  const bool hasBase =
      own ? where.size() == 1 || this->address(where.subspan(1), address) : this->address(where, address);
  if (!hasBase) return false;
  const uint32_t member = address.hasBase ? symbols_.findMember(address.structure, name.text) : kNone;
  const uint32_t index = note(name, member != kNone ? member : symbols_.findWeight(name.text, file_));
  if (index == kNone) return symbols_.noteUndefined(name, file_, {.structure = address.structure}), false;
  const Symbol& symbol = symbols_[index];
  if (symbol.broken) return false;
  if (symbol.kind != SymbolKind::Bit && symbol.kind != SymbolKind::Mechanism) {
    diagnostics_.report(diag::WrongOperandKind, name.range()) << name.text << describe(symbol) << "a bit";
    return false;
  }
  if (own && (address.hasBase || !symbol.space.valid())) return syntax("a number of bytes after $", where);
  if (!own && !address.hasBase) return wrongKind(out, "a constant", "the address of a bit");
  if (own) {
    address.space = symbol.space;
    address.protection = symbol.protection;
    address.byte += symbol.byte;
  }
  if (member != kNone) address.byte += symbol.byte;
  out.form = Operand::Form::Bit;
  out.place.bit = symbol.bit;
  if (!setPlace(address, address.byte, 1, out)) return false;
  return checkWrite(info, address.protection, address.hasBase ? address.name : name.text, out.range);
}

// ---- command blocks: BLK[n].[TYPE.]element[[k]] --------------------------------------------------

bool OperandParser::block(const OperandInfo& info, std::span<const Token> tokens, bool wantsBit, Operand& out) {
  if (tokens.size() < 6 || !tokens[3].is(']') || !tokens[4].is('.')) return syntax("BLK[n].ELEMENT", tokens);
  const bool byRegister = isBx(tokens[2]);
  const std::optional<Number> number = byRegister ? Number{} : parseNumber(tokens[2].text);
  if (!number || number->isReal) return syntax("the number of a block", tokens.subspan(2));
  std::span<const Token> rest = tokens.subspan(5);
  ir::Type wanted = ir::Type::I32;
  if (const uint8_t prefix = wantsBit ? 0 : takePrefix(rest)) {
    for (const PrefixType& p : kBlockPrefixes)
      if (p.prefix == prefix) wanted = p.type;
  }
  if (rest.empty() || rest[0].kind != TokenKind::Name) return syntax("an element of a block", rest);
  const nc::Signal* element = nc::findSignal(nc::technolSignals(), "BLK[]." + std::string(rest[0].text), "BLK");
  if (!element) return symbols_.noteUndefined(rest[0], file_, {.structure = "BLK"}), false;
  if ((element->type == nc::SignalType::Bit) != wantsBit)
    return wrongKind(out, wantsBit ? "a value" : "a bit", wantsBit ? "a bit" : "a value");
  int64_t k = 0;
  if (rest.size() == 4 && rest[1].is('[') && rest[3].is(']'))
    k = parseNumber(rest[2].text).value_or(Number{.value = -1}).value;
  else if (rest.size() != 1)
    return syntax("an element of a block", rest.subspan(1));
  if (number->value < 0 || number->value >= kQueuedBlocks || k < 0 || k >= element->count) {
    diagnostics_.report(diag::OperandRange, out.range) << spell(out) << "the queue of command blocks";
    return false;
  }
  if (!checkWrite(info, Protection::Error, spell(out), out.range)) return false;
  const uint32_t blockBytes = declarations_.bytesOf(kBlockSpace) / kQueuedBlocks;
  Address address;
  address.space = kBlockSpace;
  address.indexed = byRegister;
  out.form = wantsBit ? Operand::Form::Bit : Operand::Form::Cell;
  out.place.bit = element->bit;
  if (!wantsBit) out.type = wanted;
  out.scale = byRegister ? blockBytes : 1;
  return setPlace(address, number->value * blockBytes + element->byteOffset + k * element->strideBytes,
                  std::max(1u, ir::byteWidth(out.type)), out);
}

} // namespace rung::frontend::technol

// Operands that name variables of MAP_* and DEF_*, and bits for their numbers (see operand_parser.h).
#include "frontend/dialects/technol/check/operand_parser.h"
#include "frontend/dialects/technol/read/constant.h"
#include "ir/support/diag/technol.h"

namespace rung::frontend::technol {

// NAME or NAME[n]
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
  // Else the name is another symbol's, which has been reported.
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

// Operands that name variables of MAP_* and DEF_*, and bits for their numbers (see operand_parser.h).
#include "frontend/dialects/technol/check/operand_parser.h"
#include "frontend/dialects/technol/read/constant.h"
#include "ir/support/diag/technol.h"

namespace rung::frontend::technol {

// NAME or NAME[n]
bool OperandParser::variable(const OperandKind& kind, std::span<const Token> tokens, Operand& out) {
  const std::string wanted = "a " + std::string(kind.name);
  if (tokens[0].kind == TokenKind::Number || tokens[0].kind == TokenKind::Text)
    return wrongKind(out, tokens[0].kind == TokenKind::Number ? "a number" : "a text", wanted);
  if (tokens[0].kind != TokenKind::Name) return syntax("a name", tokens);
  const bool indexed = tokens.size() > 3 && tokens[1].is('[') && tokens.back().is(']');
  if (tokens.size() != 1 && !(indexed && kind.constant)) return syntax("a name alone", tokens);
  const bool byNumber = kind.weight;
  const uint32_t index = byNumber ? bitSymbol(tokens[0]) : require(tokens[0]);
  if (index == kNone) return false;
  const Symbol& symbol = symbols_[index];
  if (symbol.broken) return false;
  if (byNumber) {
    if (symbol.kind != SymbolKind::Bit) return wrongKind(out, describe(symbol), "a bit");
    out.form = Operand::Form::Bit;
    out.place.bit = symbol.bit;
    return true;
  }
  out.value = -1;
  if (indexed && kind.input) {
    const auto number = ConstantReader(symbols_, diagnostics_, file_, &names_)
                            .value(tokens.subspan(2, tokens.size() - 3), statement_->range());
    if (!number) return false;
    out.value = *number;
  }
  return exchanged(kind, symbol, out);
}

bool OperandParser::exchanged(const OperandKind& kind, const Symbol& symbol, Operand& out) {
  const Exchanged* found = symbol.exchanged == kNone ? nullptr : &declarations_.exchanged[symbol.exchanged];
  if (kind.input) {
    if (found == nullptr || found->kind != nc::ExchangeKind::DefIn)
      return wrongKind(out, "not an input of DEF_IN", "an input of DEF_IN");
    const int64_t count = nc::isText(found->type) ? 1 : found->count;
    const bool given = out.tokens.size() > 1;
    if (given && (out.value < 0 || out.value >= count)) {
      diagnostics_.report(diag::OperandRange, out.range) << out.value << "0 to " + std::to_string(count - 1);
      return false;
    }
  } else if (found == nullptr || &program_.statements[found->statement] != statement_) {
    return false; // the name is another symbol's, which has been reported
  }
  out.form = symbol.kind == SymbolKind::Bit ? Operand::Form::Bit : Operand::Form::Cell;
  out.type = symbol.type;
  out.place = {.space = symbol.space, .byte = symbol.byte, .bit = symbol.bit};
  out.size = symbol.size;
  out.index = symbol.exchanged;
  return true;
}

} // namespace rung::frontend::technol

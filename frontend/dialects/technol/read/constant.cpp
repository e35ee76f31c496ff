// Constant expressions (see constant.h).
#include "frontend/dialects/technol/read/constant.h"

#include "frontend/dialects/technol/read/encoding.h"
#include "ir/support/diag/technol.h"

namespace rung::frontend::technol {

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

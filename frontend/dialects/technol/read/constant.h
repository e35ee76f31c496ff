// Constant expressions: numbers, characters, constants and members, with + and - between.
#pragma once

#include "frontend/dialects/technol/read/symbols.h"

namespace rung::frontend::technol {

// Reads those of one file.
class ConstantReader {
public:
  ConstantReader(Symbols& symbols, Diagnostics& diagnostics, uint32_t file)
      : symbols_(symbols), diagnostics_(diagnostics), file_(file) {}

  // Nothing after a report; `otherwise` is its place where there are no tokens.
  std::optional<int64_t> value(std::span<const Token> tokens, SourceRange otherwise);

private:
  std::optional<int64_t> term(const Token& token);
  std::optional<int64_t> named(const Token& name);
  std::optional<int64_t> syntax(SourceRange at, const std::string& found);
  std::optional<int64_t> badNumber(const Token& token);

  Symbols& symbols_;
  Diagnostics& diagnostics_;
  uint32_t file_;
};

} // namespace rung::frontend::technol

// Declarations: DFM, DS, STR, EQUI and instances of structures (man. ch. 3.4, 3.18).
#pragma once

#include "frontend/dialects/technol/read/struc.h"

namespace rung::frontend::technol {

class DeclarationReader {
public:
  DeclarationReader(ReadContext& context, Structure& structure, Structures& structures, uint32_t file)
      : c_(context), program_(context.program), structure_(structure), structures_(structures), file_(file) {}

  // A declaration that takes memory; `name` is null if it has none. `index` is the statement's number. `badName`: its
  // name is invalid, which has been reported.
  void data(const Statement& statement, const Token* name, uint32_t index, bool badName);
  // Another name before the last declaration.
  void alsoNamed(const Token& name);
  void constant(const Statement& statement);
  // Data with the type of a structure; the operands are the value.
  void instance(const Statement& statement, const Token* name, uint32_t index, uint32_t type);
  // The variable of MAP_* or DEF_*, global in all files.
  void exchanged(const Statement& statement, uint32_t index);

private:
  void noName(std::span<const Token> tokens, std::string_view expected, const Statement& statement);
  void bits(const Statement& statement, DataItem& item);
  Symbol made(const Token& name, SymbolKind kind) const;
  Symbol exchangedSymbol(const Token& name, nc::ExchangeType type) const;

  ReadContext& c_;
  const SourceProgram& program_;
  Structure& structure_;
  Structures& structures_;
  uint32_t file_;
};

// Assigns places and sizes to the declared data, in source order.
void placeData(ReadContext& context);

} // namespace rung::frontend::technol

// Declarations: DFM, DS, STR, EQUI and structures (man. ch. 3.4, 3.18).
#pragma once

#include "frontend/dialects/technol/structure.h"

namespace rung::frontend::technol {

class Declarations {
public:
  Declarations(Program& program, Structure& structure, uint32_t file)
      : program_(program), structure_(structure), file_(file) {}

  // A declaration that takes memory; `name` is null when it has none. `index` is the statement's number.
  // `badName`: it has one that is no name, which is told already.
  void data(const Statement& statement, const Token* name, uint32_t index, bool badName);
  void constant(const Statement& statement);

  // NAME struc … NAME ends
  void beginStructure(const Token& name, const Token& keyword);
  void endStructure(const Token& name);
  void member(const Token* name, const Token& size, uint32_t bytes, std::span<const Token> value);
  // Something else follows: the structure was not closed.
  void abandonStructure(SourceRange at, std::string_view found);
  bool inStructure() const { return structureOpen_; }

private:
  void bits(const Statement& statement, DataItem& item);
  Symbol made(const Token& name, SymbolKind kind) const;

  Program& program_;
  Structure& structure_;
  uint32_t file_;
  bool structureOpen_ = false;
  std::string_view structureName_;
  uint32_t structureBytes_ = 0;
};

// Gives the declared data their places and sizes, in the order of the source.
void placeData(Program& program);

} // namespace rung::frontend::technol

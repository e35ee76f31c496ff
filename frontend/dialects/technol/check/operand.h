// An operand of a statement as it is understood.
#pragma once

#include <algorithm>
#include <span>
#include <string_view>

#include "frontend/dialects/technol/program.h"

namespace rung::frontend::technol {

struct Operand {
  enum class Form : uint8_t {
    NotGiven,
    Bit,
    Cell,
    Text,
    Integer,
    Real,
    Name, // of a label, a mechanism or a procedure: `index`
    Width,
    Register,
    Keyword // value: its number among the Words of the kind, or a member's offset
  };

  Form form = Form::NotGiven;
  bool negated = false;           // a bit or a value with `-`
  bool indexed = false;           // register BX is added to the address
  bool prefixed = false;          // the type was written
  bool isText = false;            // of a text variable, whose last byte is its terminator
  uint32_t scale = 1;             // bytes that BX counts
  ir::Type type = ir::Type::None; // of a cell, a constant or a width; F64 for reals
  ir::Place place;                // where indexed, without its byte
  int64_t offset = 0;             // where indexed: the byte of the space that BX is added to
  int64_t begin = 0;              // of the variable or member that the address is counted from, in its space
  int64_t end = 0;
  int64_t value = 0; // of a constant; of an input the element, -1: all
  double real = 0;
  uint32_t index = kNone; // label, mechanism, procedure, variable of MAP_* or DEF_*
  std::string_view text;  // of a quoted text, as the memory holds it (Windows-1250)
  std::span<const Token> tokens;
  SourceRange range;
  Access access = Access::Read; // what the instruction does with it
  uint32_t firstName = 0;       // what its names are, in Symbols::uses
  uint32_t nameCount = 0;

  bool given() const { return form != Form::NotGiven; }
  bool isConstant() const { return form == Form::Integer || form == Form::Real; }
  bool isReal() const { return type == ir::Type::F64; }
  // The byte of the space that it names; where indexed BX is added.
  int64_t byte() const { return indexed ? offset : int64_t{place.byte}; }
  // Bytes from there to the end of the variable, with a text's terminator; 0 past the end. Where indexed BX takes off
  // more.
  uint32_t size() const { return static_cast<uint32_t>(std::max<int64_t>(end - byte(), 0)); }
};

// The operand as written, without blanks.
std::string spell(const Operand& operand);
// False: the report is wrong-operand-kind.
bool reportWrongKind(Diagnostics& diagnostics, const Operand& operand, std::string_view is, std::string_view wanted);

} // namespace rung::frontend::technol

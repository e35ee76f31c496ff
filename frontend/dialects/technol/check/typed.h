// A checked program: the operands of each statement and its effect on the logic. Plain data beside the program's parts,
// made before any IR; used by lowering and tools.
#pragma once
#include <algorithm>
#include <span>
#include <string_view>
#include <vector>

#include "frontend/dialects/technol/program.h"
#include "frontend/sema/analysis.h"

namespace rung::frontend::technol {

// A parsed operand of a statement.

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
  bool prefixed = false;          // the type is written
  bool isText = false;            // a text variable, whose last byte is its terminator
  uint32_t scale = 1;             // bytes per unit of BX
  ir::Type type = ir::Type::None; // of a cell, a constant or a width; F64 for reals
  ir::Place place;                // if indexed, without its byte
  int64_t offset = 0;             // if indexed: the byte of the space to which BX is added
  int64_t begin = 0;              // in its space, of the variable or member from which the address is computed
  int64_t end = 0;
  int64_t value = 0; // of a constant; of an input the element, -1: all
  double real = 0;
  uint32_t index = kNone; // label, mechanism, procedure, variable of MAP_* or DEF_*
  std::string_view text;  // of a quoted text, as stored in memory (Windows-1250)
  std::span<const Token> tokens;
  SourceRange range;
  Access access = Access::Read; // how the instruction uses it
  uint32_t firstName = 0;       // its names, in Symbols::uses
  uint32_t nameCount = 0;

  bool given() const { return form != Form::NotGiven; }
  bool isConstant() const { return form == Form::Integer || form == Form::Real; }
  bool isReal() const { return type == ir::Type::F64; }
  // The byte of the space that it names; if indexed, BX is added.
  int64_t byte() const { return indexed ? offset : int64_t{place.byte}; }
  // Bytes from there to the end of the variable, with a text's terminator; 0 past the end. If indexed, BX reduces it
  // further.
  uint32_t size() const { return static_cast<uint32_t>(std::max<int64_t>(end - byte(), 0)); }
};

// The operand as written, without blanks.
std::string spell(const Operand& operand);
// Reports wrong-operand-kind and returns false.
bool reportWrongKind(Diagnostics& diagnostics, const Operand& operand, std::string_view is, std::string_view wanted);

inline constexpr uint32_t kStackDepth = 8; // number of values; man. l.62

// The effect of a statement on the logic equation and its stack, which is determined in the order of the source (man.
// l.225-275).
struct StackUse {
  bool begins = false;     // begins an equation
  uint32_t pushed = kNone; // stack level to which RLO is pushed before the statement works
  uint32_t popped = kNone; // stack level whose value LA, LO or LX combines
  uint32_t depth = 0;      // values on the stack while it works
};

struct Typed {
  uint32_t firstOperand = 0; // index in TypedProgram::operands
  uint32_t operandCount = 0;
  StackUse stack;
};

struct TypedProgram {
  const SourceProgram& source;
  const Declarations& declarations;
  const Symbols& symbols;
  std::vector<Typed> statements = {}; // by index of SourceProgram::statements; empty for those outside code
  std::vector<Operand> operands = {};
  std::deque<std::string> texts = {}; // texts of the operands, as stored in memory

  std::span<const Operand> operandsOf(const Typed& statement) const {
    return std::span(operands).subspan(statement.firstOperand, statement.operandCount);
  }
  // The names in an operand, in the order in which they were looked up.
  std::span<const NameUse> namesOf(const Operand& operand) const {
    return symbols.uses().subspan(operand.firstName, operand.nameCount);
  }
};

} // namespace rung::frontend::technol

// A program that has been checked: what each statement's operands are and what it does to the logic. Plain data beside
// the parts that it is about, made before any IR; the lowering and tools read it.
#pragma once
#include <algorithm>
#include <span>
#include <string_view>
#include <vector>

#include "frontend/dialects/technol/program.h"
#include "frontend/sema/analysis.h"

namespace rung::frontend::technol {

// An operand of a statement as it is understood.

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

inline constexpr uint32_t kStackDepth = 8; // values; man. l.62

// What a statement does to the logic equation and its stack, which is decided in the order of the source (man.
// l.225-275).
struct StackUse {
  bool begins = false;     // an equation
  uint32_t pushed = kNone; // level that takes RLO before the statement works
  uint32_t popped = kNone; // level whose value LA, LO or LX joins
  uint32_t depth = 0;      // values on the stack while it works
};

struct Typed {
  uint32_t firstOperand = 0; // in TypedProgram::operands
  uint32_t operandCount = 0;
  StackUse stack;
};

struct TypedProgram {
  const SourceProgram& source;
  const Declarations& declarations;
  const Symbols& symbols;
  std::vector<Typed> statements = {}; // as SourceProgram::statements; those outside code have nothing
  std::vector<Operand> operands = {};
  std::deque<std::string> texts = {}; // of the operands, as the memory holds them

  std::span<const Operand> operandsOf(const Typed& statement) const {
    return std::span(operands).subspan(statement.firstOperand, statement.operandCount);
  }
  // The names in an operand, in the order in which they were looked up.
  std::span<const NameUse> namesOf(const Operand& operand) const {
    return symbols.uses().subspan(operand.firstName, operand.nameCount);
  }
};

} // namespace rung::frontend::technol

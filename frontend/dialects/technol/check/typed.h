// A program that has been checked: what each statement's operands are and what it does to the logic. Plain data beside
// the parts that it is about, made before any IR; the lowering and tools read it.
#pragma once

#include <span>
#include <vector>

#include "frontend/dialects/technol/check/operand.h"
#include "frontend/sema/analysis.h"

namespace rung::frontend::technol {

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

// The context of a row's check: the statement, and the state after the statements before it.
#pragma once
#include "frontend/dialects/technol/check/equation.h"
#include "frontend/dialects/technol/program.h"
#include "frontend/sema/call_graph.h"

namespace rung::frontend::technol {

// The calls between procedures.

class ProcedureCalls {
public:
  explicit ProcedureCalls(const SourceProgram& program)
      : graph_(program.procedures.size()), onMessage_(program.procedureNamed(kOnMessage)) {}

  // Adds a call in a procedure, or outside of all (kNone).
  void add(uint32_t caller, uint32_t callee, SourceRange at) {
    if (caller != kNone) graph_.add(caller, callee, at);
  }
  // A message calls the procedure of messages, if there is one; except within that procedure.
  void addMessage(uint32_t caller, SourceRange at) {
    if (onMessage_ != kNone && caller != onMessage_) add(caller, onMessage_, at);
  }
  // Reports recursive calls, or if there are none, chains of calls that are too long.
  void check(const SourceProgram& program, Diagnostics& diagnostics) const;

private:
  void checkDepth(std::span<const uint32_t> calleesFirst, Diagnostics& diagnostics) const;

  CallGraph graph_; // numbered as SourceProgram::procedures
  uint32_t onMessage_ = kNone;
};

// Checks registers in the order of the source: values that a wait loses, and reals that are used as integers.

// RLO and DR after a wait, during which other code has run.
class LostRegisters {
public:
  explicit LostRegisters(Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

  void forget() { rlo_ = dr_ = false; }
  // Called before and after the statement's work; `waits`: control may leave the unit in it.
  void begin(const Statement& statement, bool readsDr);
  void finish(const Row& row, bool waits);

private:
  void reportIf(bool& lost, bool reads, const Statement& statement, std::string_view name);

  Diagnostics& diagnostics_;
  bool rlo_ = false;
  bool dr_ = false;
};

// How an instruction uses the number in DR.
enum class DrUse : uint8_t { LoadInteger, LoadReal, Integer, Real };

// The rules on mixing real and integer arithmetic (man. l.1551).
class Mixing {
public:
  explicit Mixing(Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

  void forget() { state_ = State::No; }
  void note(DrUse kind, const Statement& statement);

private:
  enum class State : uint8_t { No, Real, IntegerOnReal };

  Diagnostics& diagnostics_;
  State state_ = State::No;
  const Statement* integer_ = nullptr; // the statement that used the real as an integer
};

struct CheckContext {
  const SourceProgram& program;
  const Declarations& declarations;
  Diagnostics& diagnostics;
  const Statement& statement;
  Equation& equation;
  Mixing& mixing;
  ProcedureCalls& calls;

  DiagBuilder report(Diag id, SourceRange at) const { return diagnostics.report(id, at); }
  // Reports wrong-operand-kind and returns false.
  bool wrongKind(const Operand& operand, std::string_view is, std::string_view wanted) const {
    return reportWrongKind(diagnostics, operand, is, wanted);
  }
};

// Whether there is a text at the operand's place; with BX this is known at run time only. False after a report.
bool textFits(const CheckContext& c, const Operand& operand);

} // namespace rung::frontend::technol

// The verifier: whether a module keeps the invariants that passes, layout and engines rely on. A user's program never
// breaks them; an error here is an error of the compiler. Each rule is one function, in module_rules.cpp or
// rung_rules.cpp.
//
// Module
//   Names     Files, spaces, slot keys, routines, tasks, faults, services: not empty, and no two of a kind alike;
//             message numbers differ; symbols have a name.
//   Spaces    Units of 1, 2, 4 or 8 bytes; at most 256 MB together; known flags.
//   Slots     A type, and an initial value that it holds.
//   Symbols   A known type and flags, inside its space; a constant needs no space.
//   Spans     Initial values, retained and safe pieces lie inside their spaces.
//   Copies    Source, target and mask lie inside their spaces; source and target do not overlap; a mask where masked
//             and nowhere else.
//   Tasks     Entry and fault exist; at least one part; a budget.
//   Schedule  Main and fast task exist (Built: may be missing); steps are known; run and part have a task, others
//             none.
//   Routines  At least one rung.
//   Calls     No loop, and never deeper than the stack of return addresses.
// Rung; the first rule that a rung breaks ends the check of that rung
//   Header    The file exists, lines are in order, the weight is at least 1.
//   Form      Each operation has a type, as many operands and results as its row says, and nothing in fields that its
//             row does not use. Operands, values and notes are numbered in the order of the operations, without gaps.
//   Regions   if … else … endif and loop … endloop nest.
//   Scope     Operands are defined above, and not in a region that has ended; so are the transfer's.
//   Types     Operands and results have the types of the row.
//   Yields    Both branches of an if, and the passes of a loop, agree with the results in number and types.
//   Places    A fixed access lies inside its space, a non-bit one on a byte.
//   Windows   Every element that the index may reach lies inside the space at the width of the access; at least one.
//   SlotUse   The slot exists and has the type of the access.
//   Host      Message kinds, services, faults exist; values of messages are i64 or f64; arguments i64, at most 16;
//             results are numbered 0 to 15.
//   Loops     All loops of a rung together make at most 2^20 passes.
//   Profile   Built: no profiling. Final: prof_enter first and prof_leave last in each rung of an instrumented module,
//             and nowhere else.
//   Transfer  Targets exist in the routine; conditions are bits; a switch has an i32 and at least one target; nothing
//             in fields that the kind does not use.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "ir/core/module.h"

namespace rung::ir {

enum class Rule : uint8_t {
  Names,
  Spaces,
  Slots,
  Symbols,
  Spans,
  Copies,
  Tasks,
  Schedule,
  Routines,
  Calls,
  Header,
  Form,
  Regions,
  Scope,
  Types,
  Yields,
  Places,
  Windows,
  SlotUse,
  Host,
  Loops,
  Profile,
  Transfer,
};
inline constexpr int kRuleCount = static_cast<int>(Rule::Transfer) + 1;
std::string_view ruleName(Rule rule);

enum class Mode : uint8_t {
  Built, // as a front end gives it
  Final, // as back ends accept it
};

struct VerifyError {
  Rule rule;
  std::string message;
  RoutineId routine{};       // none: the module
  uint32_t rung = RUNG_NONE; // none: the routine
  uint32_t op = RUNG_NONE;   // none: the rung; the number of operations: its transfer
};

// Empty if the module satisfies all rules.
std::vector<VerifyError> verify(const Module& module, Mode mode);

// The errors as text, only the first ones if there are many; those of a rung are shown under the operation in the
// rung's text form.
std::string render(const Module& module, const std::vector<VerifyError>& errors);

} // namespace rung::ir

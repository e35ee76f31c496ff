// Which procedures call which.
#pragma once

#include "frontend/dialects/technol/program.h"
#include "frontend/sema/call_graph.h"

namespace rung::frontend::technol {

class ProcedureCalls {
public:
  explicit ProcedureCalls(const SourceProgram& program)
      : graph_(program.procedures.size()), onMessage_(program.procedureNamed(kOnMessage)) {}

  // A call in a procedure, or outside all of them (kNone).
  void add(uint32_t caller, uint32_t callee, SourceRange at) {
    if (caller != kNone) graph_.add(caller, callee, at);
  }
  // A message that is made calls the procedure of messages, where there is one; not inside that one.
  void addMessage(uint32_t caller, SourceRange at) {
    if (onMessage_ != kNone && caller != onMessage_) add(caller, onMessage_, at);
  }
  // Reports circles, and where there are none chains of calls that are too long.
  void check(const SourceProgram& program, Diagnostics& diagnostics) const;

private:
  void checkDepth(std::span<const uint32_t> calleesFirst, Diagnostics& diagnostics) const;

  CallGraph graph_; // of SourceProgram::procedures
  uint32_t onMessage_ = kNone;
};

} // namespace rung::frontend::technol

// Which procedures call which.
#pragma once

#include <vector>

#include "frontend/dialects/technol/program.h"

namespace rung::frontend::technol {

class CallGraph {
public:
  explicit CallGraph(const Program& program)
      : calls_(program.procedures.size()), onMessage_(program.procedureNamed(kOnMessage)) {}

  // A call in a procedure, or outside all of them (kNone).
  void add(uint32_t caller, uint32_t callee, SourceRange at) {
    if (caller != kNone) calls_[caller].push_back({callee, at});
  }
  // A message that is made calls the procedure of messages, where there is one; not inside that one.
  void addMessage(uint32_t caller, SourceRange at) {
    if (onMessage_ != kNone && caller != onMessage_) add(caller, onMessage_, at);
  }
  // Reports circles, and chains of calls that are too long.
  void check(const Program& program) const;

private:
  struct Call {
    uint32_t callee = kNone; // in Program::procedures
    SourceRange range;
  };
  std::vector<std::vector<Call>> calls_; // by procedure
  uint32_t onMessage_ = kNone;
};

} // namespace rung::frontend::technol

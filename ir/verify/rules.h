// The verifier's parts: errors are collected here, rules are in module_rules.cpp and rung_rules.cpp.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "ir/verify/verify.h"

namespace rung::ir {

// What a rule of the module needs.
class ModuleCheck {
public:
  ModuleCheck(const Module& m, Mode checkMode, std::vector<VerifyError>& errors)
      : module(m), mode(checkMode), errors_(errors) {}

  void fail(Rule rule, std::string message, RoutineId routine = {}, uint32_t rung = RUNG_NONE,
            uint32_t op = RUNG_NONE) {
    errors_.push_back({rule, std::move(message), routine, rung, op});
  }
  size_t errorCount() const { return errors_.size(); }
  bool inside(SpaceId space, uint64_t byte, uint64_t size) const;

  const Module& module;
  const Mode mode;

private:
  std::vector<VerifyError>& errors_;
};

uint64_t byteCount(const Space& space);

// False if the rungs cannot be checked, because the tables to which they refer are invalid.
bool checkModule(ModuleCheck& check);
void checkRungs(ModuleCheck& check);
// Transfers must be in range.
void checkCalls(ModuleCheck& check);

} // namespace rung::ir

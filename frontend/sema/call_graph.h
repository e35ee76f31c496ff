// The calls between the routines of a program, which the dialect numbers.
#pragma once
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "ir/support/source.h"

namespace rung::frontend {

class CallGraph {
public:
  struct Call {
    uint32_t callee = 0;
    SourceRange range;
  };
  explicit CallGraph(size_t routines) : calls_(routines) {}
  void add(uint32_t caller, uint32_t callee, SourceRange at) { calls_[caller].push_back({callee, at}); }
  std::span<const Call> of(uint32_t caller) const { return calls_[caller]; }

  // A cycle of calls: `call` closes it, `through` are the routines between its callee and itself, in the order of their
  // calls.
  struct Cycle {
    Call call;
    std::vector<uint32_t> through;
  };
  struct Order {
    std::vector<Cycle> cycles;
    std::vector<uint32_t> calleesFirst; // all routines; with cycles, not all of them precede their callers
  };
  Order order() const;

  // " through A, B" for a message; "" if a routine calls itself.
  static std::string throughText(const Cycle& cycle, const std::function<std::string(uint32_t)>& nameOf);

private:
  std::vector<std::vector<Call>> calls_; // by caller
};

} // namespace rung::frontend

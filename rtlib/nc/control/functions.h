// M, S, T and further functions of a part program on their way from the NC to the PLC program, by the dialect's own
// handshake. A simulated NC and a host that drives a machine hand functions over by the same class. Everything here is
// for the scan thread and allocates nothing.
#pragma once
#include <cstdint>
#include <string_view>

#include "rtlib/host/instance.h"

namespace rung::nc {

enum class FunctionKind : uint8_t { M, S, T, B };                          // B: the second auxiliary function
inline constexpr std::string_view kFunctionKinds[] = {"M", "S", "T", "B"}; // by FunctionKind

class Functions {
public:
  virtual ~Functions() = default;

  // From now on the program finishes every kind of function by a signal of its own, so that kinds do not wait for each
  // other. False: the dialect has no such mode.
  virtual bool useHighSpeed() { return false; }

  // Hands a function over. False: signals that it needs are in use by another one; try again before a later slice.
  virtual bool start(host::Instance& instance, FunctionKind kind, uint32_t code) = 0;
  // Before every slice of the program.
  virtual void step(host::Instance& instance) = 0;
  // A function of this kind was handed over, and the program has not finished it.
  virtual bool busy(FunctionKind kind) const = 0;
  // Reset, emergency stop: what is under way ends at once, unanswered.
  virtual void abort(host::Instance& instance) = 0;
};

} // namespace rung::nc

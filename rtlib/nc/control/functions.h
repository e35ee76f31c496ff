// M, S, T and further functions of a part program, and keys, on their way from the NC to the PLC program, by the
// dialect's own handshake. A simulated NC and a host that drives a machine hand functions over by the same class.
// Everything here is for the scan thread and allocates nothing.
#pragma once
#include <cstdint>
#include <optional>
#include <string_view>

namespace rung::nc {

// B: the second auxiliary function; Key: one of the panel that is pressed and released.
enum class FunctionKind : uint8_t { M, S, T, B, H, Key };
inline constexpr std::string_view kFunctionKinds[] = {"M", "S", "T", "B", "H", "key"}; // by FunctionKind

// The functions of one channel of the control (Control::functions). They are ready once the program is switched on; a
// power-on leaves none under way.
class Functions {
public:
  virtual ~Functions() = default;

  // From now on the program finishes every kind of function by a signal of its own, so that kinds do not wait for each
  // other. False: the dialect has no such mode.
  virtual bool useHighSpeed() { return false; }
  // The machine has this M function in a group of its choice, from now on. False: the dialect has no such group, or the
  // function has its group for good.
  virtual bool setGroup(uint32_t code, uint32_t group) { return (void)code, (void)group, false; }
  // False: the dialect has no signals for this kind of function, or none that hold the code.
  virtual bool carries(FunctionKind kind, uint32_t code) const = 0;

  // Hands a function over that the signals carry; gives the line that it is on, which is its own until it is finished.
  // Nothing: the signals that it needs are in use, or it is not the time for it; try again before a later slice.
  virtual std::optional<uint32_t> start(FunctionKind kind, uint32_t code) = 0;
  // Before every slice of the program.
  virtual void step() = 0;
  // The program has not finished the function on this line, of which there may be none.
  virtual bool busy(uint32_t line) const = 0;
  // Reset, emergency stop: what is under way ends at once, unanswered.
  virtual void abort() = 0;
};

} // namespace rung::nc

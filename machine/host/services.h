// The last reported state of a CNC, for requests that are answered within the scan that makes them. Written by the
// service thread, read by the scan thread; each value is consistent, but different values may be from different
// moments.
#pragma once
#include <array>
#include <atomic>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "rung/runtime.h"

namespace rung::host {

inline constexpr uint32_t kMostAxes = 9;

struct Live {
  std::atomic<bool> served{false}; // a client answers requests
  std::atomic<bool> known{false};  // the client has reported the values below
  std::atomic<uint32_t> line{0};   // line of the running part program; 0: none
  std::atomic<uint32_t> axes{0};
  std::array<std::atomic<double>, kMostAxes> machine{}; // positions in machine coordinates
};

// Requests of a PLC program to its CNC and their answers, independent of dialects; docs/control-protocol.md has the
// names. Lengths are in mm, angles in degrees; axes count from 0 in the order of the machine.

enum class Quantity : uint8_t {
  MacroVariable,
  ToolLength, // of the tool or offset `number`, like the next three
  ToolLengthWear,
  ToolRadius,
  ToolRadiusWear,
  WorkOffset, // `number` 0: offset of all work coordinate systems; 1 to 6: G54 to G59; from 7 on the additional ones
  ToolNumber, // `number` 0: in the spindle; 1: preselected
  AxisMove,   // motion of an axis that belongs to the program: always a write
};
inline constexpr std::string_view kQuantityNames[] = {"macro-variable", "tool-length",      "tool-length-wear",
                                                      "tool-radius",    "tool-radius-wear", "work-offset",
                                                      "tool-number",    "axis-move"}; // by Quantity

// How an axis of the program moves until its next motion or its reset.
enum class MotionKind : uint8_t {
  To,    // a position in its coordinate system
  By,    // a distance
  At,    // a position in machine coordinates
  Home,  // its reference point
  Dwell, // `value` seconds
  Jog,   // continuously in the direction of `value`, 1 or -1; 0: by the program's signals
  Stop,  // stops; waiting motions are dropped
};
inline constexpr std::string_view kMotionNames[] = {"to", "by", "at", "home", "dwell", "jog", "stop"}; // by MotionKind

struct Operation {
  Quantity quantity = Quantity::MacroVariable;
  bool write = false;
  uint32_t channel = 0; // from 0
  uint32_t number = 0;
  uint32_t axis = 0;                  // of a work offset; of a motion: from 0 in the order of the program
  double value = 0;                   // the value to be written
  MotionKind motion = MotionKind::To; // of a move
  double speed = 0;                   // of a move, per minute; 0: rapid
  bool untilOver = false;             // a motion is answered at its end, otherwise when it is accepted
};

enum class Outcome : uint8_t {
  Done,
  NoQuantity, // the CNC has no such data
  NoNumber,   // no such number or channel
  NoAxis,
  BadValue,
  NotNow, // off, busy or locked; or no client answers requests
};
inline constexpr std::string_view kOutcomeNames[] = {"done",    "no-quantity", "no-number",
                                                     "no-axis", "bad-value",   "not-now"}; // by Outcome

struct NcAnswer {
  Outcome outcome = Outcome::NotNow;
  double value = 0; // the value that was read
};

// Converts requests of a dialect's programs to operations, and outcomes to the dialect's results and errors. The
// functions here are for a dialect without such requests: they refuse all.
class Translation {
public:
  // Scan thread, called by rung_instance_options::request: returns an enum rung_answer. If no client serves, or no
  // operation corresponds to the request, the control refuses at once. Allocates nothing.
  virtual int32_t atOnce(const rung_request& request, const Live& live, rung_reply& reply) const noexcept {
    return (void)request, (void)live, (void)reply, RUNG_REFUSE;
  }
  // Returns the operation of a request; nothing: `refusal` is the answer.
  virtual std::optional<Operation> operationOf(const rung_request& request, rung_reply& refusal) const {
    return (void)request, (void)refusal, std::nullopt;
  }
  virtual rung_reply replyOf(const rung_request& request, const NcAnswer& answer) const {
    return {.size = sizeof(rung_reply), .ticket = request.ticket, .error = answer.outcome == Outcome::Done ? 0u : 1u};
  }

protected:
  ~Translation() = default; // constants alone implement it
};

// The translation for a rung_program::dialect.
const Translation& translationOf(std::string_view dialect);

// The window functions of GSK25i (man. §9.3) and its PLC axis control (§9.2). High-speed window functions are answered
// at once or not at all.
const Translation& gskTranslation();
// The window functions of the FANUC PMC and its axis control, in the same way.
const Translation& fanucTranslation();
// MACR, MACW, MOVCMND and SCP of NCT (man. §6.15-§6.17). SCP is answered at once or not at all.
const Translation& nctTranslation();

} // namespace rung::host

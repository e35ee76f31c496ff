// What a CNC says of itself again and again, for requests that are answered within the scan that asks. Written by the
// thread that serves, read by the scan; each value is one of a moment, all of them may be of different ones.
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
  std::atomic<bool> served{false}; // somebody answers requests
  std::atomic<bool> known{false};  // and has said what is below
  std::atomic<uint32_t> line{0};   // of the part program that is carried out; 0: none
  std::atomic<uint32_t> axes{0};
  std::array<std::atomic<double>, kMostAxes> machine{}; // positions in machine coordinates
};

// What a PLC program asks of its CNC and what it gets, in the words of no dialect: docs/control-protocol.md has the
// names. Lengths are in mm, angles in degrees, axes count from 0 in the order of the machine.

enum class Quantity : uint8_t {
  MacroVariable,
  ToolLength, // of the tool or offset `number`; so are the next three
  ToolLengthWear,
  ToolRadius,
  ToolRadiusWear,
  WorkOffset, // `number` 0: of all work coordinate systems; 1 to 6: G54 to G59; from 7 on the further ones
  ToolNumber, // `number` 0: in the spindle; 1: preselected
  AxisMove,   // of an axis that the program has for itself: always a write
};
inline constexpr std::string_view kQuantityNames[] = {"macro-variable", "tool-length",      "tool-length-wear",
                                                      "tool-radius",    "tool-radius-wear", "work-offset",
                                                      "tool-number",    "axis-move"}; // by Quantity

// What an axis of the program does, until the next move or its reset.
enum class Way : uint8_t {
  To,    // a position in its coordinate system
  By,    // a distance
  At,    // a position in machine coordinates
  Home,  // its reference point
  Dwell, // `value` seconds
  Jog,   // by the program's signals, or on and on: in the direction of `value`, which is 1 or -1 then
  Stop,  // where it is; what waits is forgotten
};
inline constexpr std::string_view kWayNames[] = {"to", "by", "at", "home", "dwell", "jog", "stop"}; // by Way

struct Operation {
  Quantity quantity = Quantity::MacroVariable;
  bool write = false;
  uint32_t channel = 0; // from 0
  uint32_t number = 0;
  uint32_t axis = 0;      // of a work offset; of a move, from 0 in the order of the program
  double value = 0;       // to be written
  Way way = Way::To;      // of a move
  double speed = 0;       // of a move, per minute; 0: rapid
  bool untilOver = false; // a move is done when it is over; else, when it is taken
};

enum class Outcome : uint8_t {
  Done,
  NoQuantity, // the CNC has nothing of the kind
  NoNumber,   // but none of this number, or no such channel
  NoAxis,
  BadValue,
  NotNow, // it is not switched on, or at work, or locked; and where nobody answers
};
inline constexpr std::string_view kOutcomeNames[] = {"done",    "no-quantity", "no-number",
                                                     "no-axis", "bad-value",   "not-now"}; // by Outcome

struct NcAnswer {
  Outcome outcome = Outcome::NotNow;
  double value = 0; // that was read
};

// Requests of a dialect's programs as operations, and outcomes as the dialect's own results and errors. Of a dialect
// that asks nothing of the kind, everything is refused.
class Translation {
public:
  virtual ~Translation() = default;

  // For the scan, in rung_instance_options::request: an enum rung_answer. What no operation is like, the control
  // refuses at once. Allocates nothing.
  virtual int32_t atOnce(const rung_request& request, const Live& live, rung_reply& reply) const noexcept {
    return (void)request, (void)live, (void)reply, RUNG_REFUSE;
  }
  // Nothing: `refusal` is the answer.
  virtual std::optional<Operation> operationOf(const rung_request& request, rung_reply& refusal) const {
    return (void)request, (void)refusal, std::nullopt;
  }
  virtual rung_reply replyOf(const rung_request& request, const NcAnswer& answer) const {
    return {.size = sizeof(rung_reply), .ticket = request.ticket, .error = answer.outcome == Outcome::Done ? 0u : 1u};
  }
};

// By rung_program::dialect.
const Translation& translationOf(std::string_view dialect);

// Window functions (man. §9.3) and PLC axis control (§9.2). Window functions of high speed are answered at once, or by
// no one.
const Translation& gskTranslation();
// MACR, MACW, MOVCMND and SCP (man. §6.15-§6.17). SCP is answered at once, or by no one.
const Translation& nctTranslation();

} // namespace rung::host

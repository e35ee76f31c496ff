// Window functions (man. l.8482-8945), and the control's own requests for the blocks of PLC axis control (l.7713-7803).
#include <cmath>

#include "machine/host/services.h"
#include "rtlib/nc/gsk/axis_commands.h"
#include "rtlib/nc/gsk/services.h"
#include "rtlib/nc/gsk/window_functions.h"

namespace rung::host {
namespace {

using nc::gsk::WindowEnd;
using nc::pmc::ServiceKind;
using nc::pmc::WindowAccess;
using nc::pmc::WindowField;
using nc::pmc::WindowFunction;

enum Code : uint16_t { // codes of functions
  kReadOffset = 1,
  kWriteOffset = 2,
  kReadOrigin = 3,
  kWriteOrigin = 4,
  kReadVariable = 9,
  kWriteVariable = 10,
  kSequence = 14,
  kMachinePosition = 17,
  kTool = 31,
};

// The arguments of a window request.
struct Window {
  bool write;
  uint64_t code, length, number, attribute;
  int64_t data; // for a write
  const WindowFunction* function;
};

ServiceKind kindOf(const rung_request& request) noexcept { return static_cast<ServiceKind>(request.kind); }

Window windowOf(const rung_request& request) noexcept {
  const bool write = kindOf(request) == ServiceKind::WriteWindow;
  const auto at = [&](size_t i) { return static_cast<uint64_t>(request.args[i]); };
  return {write,
          at(0),
          at(1),
          at(2),
          at(3),
          write ? request.args[4] : 0,
          nc::pmc::findWindowFunction(nc::gsk::windowFunctions(), at(0))};
}

bool fits(double value, uint64_t length) noexcept {
  const double limit = std::ldexp(1.0, static_cast<int>(8 * length) - 1);
  return value >= -limit && value < limit;
}

rung_reply ended(const Window& window, uint32_t ticket, WindowEnd end, double data = 0) noexcept {
  return {.size = sizeof(rung_reply),
          .ticket = ticket,
          .error = 0,
          .result_count = window.write ? 1u : 2u,
          .results = {end, end == nc::gsk::kWindowDone ? std::llround(data) : 0}};
}

// The answer to a read, in the units of the function; an error if the value exceeds the requested length.
rung_reply given(const Window& window, uint32_t ticket, double value) noexcept {
  const double data = std::round(value * window.function->scale);
  return fits(data, window.length) ? ended(window, ticket, nc::gsk::kWindowDone, data)
                                   : ended(window, ticket, nc::gsk::kWindowBadLength);
}

bool isOutside(const WindowField& field, uint64_t value) noexcept {
  return !field.meaning.empty() && (value < field.min || (field.max != nc::pmc::kNoLimit && value > field.max));
}

// Checks in the order of the end codes.
WindowEnd mistakeOf(const Window& w) noexcept {
  const WindowFunction* f = w.function;
  if (f == nullptr || (f->access == WindowAccess::Write) != w.write) return nc::gsk::kWindowBadFunction;
  if (!nc::gsk::isWindowLength(w.length)) return nc::gsk::kWindowBadLength;
  if (f->status != nc::pmc::WindowStatus::Open) return nc::gsk::kWindowNotProvided;
  if (isOutside(f->number, w.number)) return nc::gsk::kWindowBadCount;
  if (isOutside(f->attribute, w.attribute)) return nc::gsk::kWindowBadAttribute;
  const bool whole = !f->wholeOnly || w.data % f->scale == 0;
  return whole ? nc::gsk::kWindowDone : nc::gsk::kWindowBadData;
}

rung_reply highSpeed(const Window& window, uint32_t ticket, const Live& live) noexcept {
  if (window.code == kSequence) return given(window, ticket, live.line.load(std::memory_order_relaxed));
  if (window.code != kMachinePosition) return ended(window, ticket, nc::gsk::kWindowNotProvided);
  const uint64_t axis = window.attribute - 1;
  if (axis >= live.axes.load(std::memory_order_relaxed)) return ended(window, ticket, nc::gsk::kWindowBadAttribute);
  return given(window, ticket, live.machine[axis].load(std::memory_order_relaxed));
}

std::optional<Quantity> quantityOf(const Window& window) noexcept {
  constexpr Quantity kOffsets[] = {Quantity::ToolLength, Quantity::ToolLengthWear, Quantity::ToolRadius,
                                   Quantity::ToolRadiusWear}; // indexed by the attribute
  switch (window.code) {
  case kReadOffset:
  case kWriteOffset: return kOffsets[window.attribute];
  case kReadOrigin:
  case kWriteOrigin: return Quantity::WorkOffset;
  case kReadVariable:
  case kWriteVariable: return Quantity::MacroVariable;
  case kTool: return Quantity::ToolNumber;
  default: return std::nullopt; // parameters, pitch compensation
  }
}

WindowEnd endOf(Outcome outcome, bool write) noexcept {
  switch (outcome) {
  case Outcome::Done: return nc::gsk::kWindowDone;
  case Outcome::NoQuantity: return nc::gsk::kWindowNotProvided;
  case Outcome::NoNumber: return nc::gsk::kWindowBadCount;
  case Outcome::NoAxis: return nc::gsk::kWindowBadAttribute;
  case Outcome::BadValue: return nc::gsk::kWindowBadData;
  case Outcome::NotNow: return write ? nc::gsk::kWindowProtected : nc::gsk::kWindowNotProvided;
  }
  return nc::gsk::kWindowNotProvided;
}

// Nothing: CNCs do not offer this motion to their programs. One turn of the command in r/min is 360 degrees (l.8407).
std::optional<Operation> moveOf(const int64_t* args) noexcept {
  constexpr double kUnits = 10000; // units of data 2 per mm or degree (P54)
  Operation move{.quantity = Quantity::AxisMove,
                 .write = true,
                 .axis = static_cast<uint32_t>(args[0]),
                 .value = static_cast<double>(args[3]) / kUnits,
                 .speed = static_cast<double>(args[2]),
                 .untilOver = true};
  const auto turns = static_cast<double>(static_cast<int16_t>(args[2]));
  switch (args[1]) {
  case nc::pmc::kAxisStop: move.motion = MotionKind::Stop; break;
  case nc::pmc::kAxisRapid:
  case nc::pmc::kAxisFeed: move.motion = MotionKind::By; break;
  case nc::pmc::kAxisMachineCoordinate: move.motion = MotionKind::At; break;
  case nc::pmc::kAxisManualReturn: move.speed = 0; [[fallthrough]]; // the speed is parameter 1428 of the control
  case nc::pmc::kAxisReference1:
    move.motion = MotionKind::Home;
    move.value = 0;
    break;
  case nc::pmc::kAxisContinuous:
    move.motion = MotionKind::Jog;
    move.value = (args[3] & 1) != 0 ? -1 : 1;
    break;
  case nc::pmc::kAxisSpeed:
    move.motion = MotionKind::Jog;
    move.value = turns < 0 ? -1 : 1;
    move.speed = std::fabs(turns) * 360;
    break;
  default: return std::nullopt;
  }
  const bool needsSpeed = move.motion != MotionKind::Stop && args[1] != nc::pmc::kAxisManualReturn;
  return needsSpeed && move.speed == 0 ? std::nullopt : std::optional(move);
}

int32_t windowAtOnce(const rung_request& request, const Live& live, rung_reply& reply) noexcept {
  const Window window = windowOf(request);
  const WindowEnd mistake = mistakeOf(window);
  if (mistake == nc::gsk::kWindowDone && window.function->speed == nc::pmc::WindowSpeed::Low) return RUNG_QUEUE;
  if (mistake == nc::gsk::kWindowDone && !live.known.load(std::memory_order_acquire)) return RUNG_REFUSE;
  reply = mistake == nc::gsk::kWindowDone ? highSpeed(window, request.ticket, live)
                                          : ended(window, request.ticket, mistake);
  return RUNG_ANSWER;
}

std::optional<Operation> windowOperation(const rung_request& request, rung_reply& refusal) {
  const Window window = windowOf(request);
  const WindowEnd mistake = mistakeOf(window);
  const std::optional<Quantity> quantity = mistake == nc::gsk::kWindowDone ? quantityOf(window) : std::nullopt;
  if (!quantity) {
    refusal = ended(window, request.ticket, mistake == nc::gsk::kWindowDone ? nc::gsk::kWindowNotProvided : mistake);
    return std::nullopt;
  }
  const bool offset = window.code == kReadOffset || window.code == kWriteOffset;
  return Operation{.quantity = *quantity,
                   .write = window.write,
                   .number = static_cast<uint32_t>(window.number) + (offset ? 1 : 0), // M is one less (l.8694)
                   .axis = *quantity == Quantity::WorkOffset ? static_cast<uint32_t>(window.attribute) : 0,
                   .value = static_cast<double>(window.data) / window.function->scale};
}

class GskTranslation final : public Translation {
public:
  int32_t atOnce(const rung_request& request, const Live& live, rung_reply& reply) const noexcept override {
    switch (kindOf(request)) {
    case ServiceKind::Unknown: return RUNG_REFUSE;
    case ServiceKind::ReadWindow:
    case ServiceKind::WriteWindow: return windowAtOnce(request, live, reply);
    case ServiceKind::MoveAxis: return RUNG_QUEUE;
    }
    return RUNG_REFUSE;
  }

  std::optional<Operation> operationOf(const rung_request& request, rung_reply& refusal) const override {
    return kindOf(request) == ServiceKind::MoveAxis ? moveOf(request.args) : windowOperation(request, refusal);
  }

  rung_reply replyOf(const rung_request& request, const NcAnswer& answer) const override {
    if (kindOf(request) == ServiceKind::MoveAxis) return Translation::replyOf(request, answer);
    const Window window = windowOf(request);
    if (answer.outcome == Outcome::Done && !window.write) return given(window, request.ticket, answer.value);
    return ended(window, request.ticket, endOf(answer.outcome, window.write));
  }
};

} // namespace

const Translation& gskTranslation() {
  static constexpr GskTranslation kGsk;
  return kGsk;
}

} // namespace rung::host

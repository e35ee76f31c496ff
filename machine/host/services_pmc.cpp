// See services_pmc.h.
#include "machine/host/services_pmc.h"

#include <cmath>

#include "rtlib/nc/pmc/axis_commands.h"

namespace rung::host {
namespace {

using nc::pmc::ServiceKind;

ServiceKind kindOf(const rung_request& request) noexcept { return static_cast<ServiceKind>(request.kind); }

} // namespace

bool fitsBytes(double value, uint64_t bytes) noexcept {
  const double limit = std::ldexp(1.0, static_cast<int>(8 * bytes) - 1);
  return value >= -limit && value < limit;
}

WindowDialect::Window PmcTranslation::windowOf(const rung_request& request) const noexcept {
  const auto at = [&](size_t i) { return static_cast<uint64_t>(request.args[i]); };
  return {&request, kindOf(request) == ServiceKind::WriteWindow, at(0), at(1), at(2), at(3), dialect_->find(at(0))};
}

// Nothing: CNCs do not offer this motion to their programs. One turn of the command in r/min is 360 degrees (l.8407).
std::optional<Operation> PmcTranslation::moveOf(const int64_t* args) const noexcept {
  Operation move{.quantity = Quantity::AxisMove,
                 .write = true,
                 .axis = static_cast<uint32_t>(args[0]),
                 .value = static_cast<double>(args[3]) / dialect_->axes().stepsPerMm,
                 .speed = static_cast<double>(args[2]),
                 .untilOver = true};
  const auto turns = static_cast<double>(static_cast<int16_t>(args[2]));
  switch (args[1]) {
  case nc::pmc::kAxisStop: move.motion = MotionKind::Stop; break;
  case nc::pmc::kAxisRapid:
  case nc::pmc::kAxisFeed: move.motion = MotionKind::By; break;
  case nc::pmc::kAxisMachineCoordinate: move.motion = MotionKind::At; break;
  case nc::pmc::kAxisManualReturn: move.speed = 0; [[fallthrough]]; // the speed is a parameter of the control
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
  const bool isRapid = args[1] == nc::pmc::kAxisRapid || args[1] == nc::pmc::kAxisReference1 ||
                       args[1] == nc::pmc::kAxisMachineCoordinate;
  const bool needsSpeed = move.motion != MotionKind::Stop && args[1] != nc::pmc::kAxisManualReturn &&
                          !(isRapid && dialect_->axes().rapidWithoutSpeed);
  return needsSpeed && move.speed == 0 ? std::nullopt : std::optional(move);
}

int32_t PmcTranslation::windowAtOnce(const rung_request& request, const Live& live, rung_reply& reply) const noexcept {
  const WindowDialect::Window window = windowOf(request);
  const int64_t mistake = dialect_->mistakeOf(window);
  if (mistake == 0 && window.function->speed == nc::pmc::WindowSpeed::Low) return RUNG_QUEUE;
  if (mistake == 0 && !live.known.load(std::memory_order_acquire)) return RUNG_REFUSE;
  reply = mistake == 0 ? dialect_->highSpeed(window, live) : dialect_->ended(window, mistake);
  return RUNG_ANSWER;
}

int32_t PmcTranslation::atOnce(const rung_request& request, const Live& live, rung_reply& reply) const noexcept {
  switch (kindOf(request)) {
  case ServiceKind::Unknown: return RUNG_REFUSE;
  case ServiceKind::ReadWindow:
  case ServiceKind::WriteWindow: return windowAtOnce(request, live, reply);
  case ServiceKind::MoveAxis: return RUNG_QUEUE;
  }
  return RUNG_REFUSE;
}

std::optional<Operation> PmcTranslation::operationOf(const rung_request& request, rung_reply& refusal) const {
  if (kindOf(request) == ServiceKind::MoveAxis) return moveOf(request.args);
  const WindowDialect::Window window = windowOf(request);
  const int64_t mistake = dialect_->mistakeOf(window);
  std::optional<Operation> operation;
  if (mistake == 0) operation = dialect_->operationOf(window);
  if (!operation)
    refusal = dialect_->ended(window, mistake != 0 ? mistake : dialect_->endOf(Outcome::NoQuantity, window.write));
  return operation;
}

rung_reply PmcTranslation::replyOf(const rung_request& request, const NcAnswer& answer) const {
  if (kindOf(request) == ServiceKind::MoveAxis) return Translation::replyOf(request, answer);
  const WindowDialect::Window window = windowOf(request);
  if (answer.outcome == Outcome::Done && !window.write) return dialect_->given(window, answer.value);
  return dialect_->ended(window, dialect_->endOf(answer.outcome, window.write));
}

} // namespace rung::host

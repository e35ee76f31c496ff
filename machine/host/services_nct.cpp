// Macro variables, movement blocks and quantities of the scope. Errors set FL_ER=1 in the program.
#include "rtlib/nc/nct/axis_codes.h"

#include <array>
#include <bit>
#include <string_view>

#include "machine/host/services.h"
#include "rtlib/nc/nct/scope_symbols.h"
#include "rtlib/nc/nct/services.h"

namespace rung::host {
namespace {

using nc::nct::ServiceKind;

// A motion; without a kind, CNCs do not offer it to their programs.
struct Motion {
  std::optional<MotionKind> kind;
  bool rapid = true;
};
constexpr bool kFeed = false;
constexpr std::array<Motion, 15> kMotions = {{{MotionKind::To},
                                              {MotionKind::By},
                                              {MotionKind::To, kFeed},
                                              {MotionKind::By, kFeed},
                                              {},
                                              {},
                                              {MotionKind::At},
                                              {MotionKind::Home},
                                              {},
                                              {},
                                              {},
                                              {MotionKind::Dwell},
                                              {},
                                              {MotionKind::Jog, kFeed},
                                              {}}}; // indexed by the codes of axis_codes.h

std::optional<Operation> moveOf(const int64_t* args) noexcept {
  const bool known = args[0] >= 0 && args[0] < nc::nct::kAxes && args[1] >= 0 && args[1] < std::ssize(kMotions);
  const Motion motion = known ? kMotions[static_cast<size_t>(args[1])] : Motion{};
  if (!motion.kind) return std::nullopt;
  return Operation{.quantity = Quantity::AxisMove,
                   .write = true,
                   .axis = static_cast<uint32_t>(args[0]),
                   .value = *motion.kind == MotionKind::Jog ? 0 : std::bit_cast<double>(args[3]),
                   .motion = *motion.kind,
                   .speed = motion.rapid ? 0 : std::bit_cast<double>(args[2])};
}

bool isPosition(int64_t symbol) noexcept {
  const auto symbols = nc::nct::scopeSymbols();
  if (symbol < 0 || symbol >= std::ssize(symbols)) return false;
  const std::string_view name = symbols[static_cast<size_t>(symbol)].name;
  return name == "ActPosAx" || name == "ComPosAx";
}

// Answers positions of axes, which count from 1 in requests; the other quantities are not known.
int32_t scopeAtOnce(const rung_request& request, const Live& live, rung_reply& reply) noexcept {
  const int64_t axis = request.args[1] - 1;
  if (!live.known.load(std::memory_order_acquire) || !isPosition(request.args[0]) || axis < 0 ||
      axis >= int64_t{live.axes.load(std::memory_order_relaxed)})
    return RUNG_REFUSE;
  reply = {.size = sizeof reply, .ticket = request.ticket, .result_count = 1};
  reply.results[0] = std::bit_cast<int64_t>(live.machine[static_cast<size_t>(axis)].load(std::memory_order_relaxed));
  return RUNG_ANSWER;
}

Operation macroOf(const int64_t* args, bool write) {
  return {.quantity = Quantity::MacroVariable,
          .write = write,
          .channel = static_cast<uint32_t>(args[1]),
          .number = static_cast<uint32_t>(args[0]),
          .value = write ? std::bit_cast<double>(args[2]) : 0};
}

class NctTranslation final : public Translation {
public:
  // A move has no answer, so motions that no CNC offers are refused here.
  int32_t atOnce(const rung_request& request, const Live& live, rung_reply& reply) const noexcept override {
    switch (kindOf(request)) {
    case ServiceKind::Unknown:
    case ServiceKind::ReadArray:
    case ServiceKind::WriteArray: return RUNG_REFUSE;
    case ServiceKind::ReadMacro:
    case ServiceKind::WriteMacro: return RUNG_QUEUE;
    case ServiceKind::ReadScope: return scopeAtOnce(request, live, reply);
    case ServiceKind::MoveAxis: return moveOf(request.args) ? RUNG_QUEUE : RUNG_REFUSE;
    }
    return RUNG_REFUSE;
  }

  std::optional<Operation> operationOf(const rung_request& request, rung_reply&) const override {
    switch (kindOf(request)) {
    case ServiceKind::ReadMacro: return macroOf(request.args, false);
    case ServiceKind::WriteMacro: return macroOf(request.args, true);
    case ServiceKind::MoveAxis: return moveOf(request.args);
    default: return std::nullopt; // refused, or answered at once
    }
  }

  rung_reply replyOf(const rung_request& request, const NcAnswer& answer) const override {
    rung_reply reply = Translation::replyOf(request, answer);
    if (reply.error == 0 && kindOf(request) == ServiceKind::ReadMacro) {
      reply.result_count = 1;
      reply.results[0] = std::bit_cast<int64_t>(answer.value);
    }
    return reply;
  }

private:
  static ServiceKind kindOf(const rung_request& request) noexcept { return static_cast<ServiceKind>(request.kind); }
};

} // namespace

const Translation& nctTranslation() {
  static constexpr NctTranslation kNct;
  return kNct;
}

} // namespace rung::host

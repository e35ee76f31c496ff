// MACR variable channel -> value, MACW variable channel value (man. l.8070-8125), MOVCMND axis code speed distance
// (l.3082-3145), SCP symbol p1 p2 -> value (l.3323-3388): errors are FL_ER=1 in the program.
#include "rtlib/nc/nct/axis_codes.h"

#include <array>
#include <bit>
#include <string_view>

#include "machine/host/services.h"
#include "rtlib/nc/nct/scope_symbols.h"

namespace rung::host::nct {
namespace {

// Without a way: no CNC offers the motion to its program.
struct Motion {
  std::optional<Way> way;
  bool rapid = true;
};
constexpr bool kFeed = false;
constexpr std::array<Motion, 15> kMotions = {{{Way::To},
                                              {Way::By},
                                              {Way::To, kFeed},
                                              {Way::By, kFeed},
                                              {},
                                              {},
                                              {Way::At},
                                              {Way::Home},
                                              {},
                                              {},
                                              {},
                                              {Way::Dwell},
                                              {},
                                              {Way::Jog, kFeed},
                                              {}}}; // by the codes of axis_codes.h

std::optional<Operation> moveOf(const int64_t* args) noexcept {
  const bool known = args[0] >= 0 && args[0] < rung::nc::nct::kAxes && args[1] >= 0 && args[1] < std::ssize(kMotions);
  const Motion motion = known ? kMotions[static_cast<size_t>(args[1])] : Motion{};
  if (!motion.way) return std::nullopt;
  return Operation{.quantity = Quantity::AxisMove,
                   .write = true,
                   .axis = static_cast<uint32_t>(args[0]),
                   .value = *motion.way == Way::Jog ? 0 : std::bit_cast<double>(args[3]),
                   .way = *motion.way,
                   .speed = motion.rapid ? 0 : std::bit_cast<double>(args[2])};
}

bool isPosition(int64_t symbol) noexcept {
  const auto symbols = rung::nc::nct::scopeSymbols();
  if (symbol < 0 || symbol >= std::ssize(symbols)) return false;
  const std::string_view name = symbols[static_cast<size_t>(symbol)].name;
  return name == "ActPosAx" || name == "ComPosAx";
}

} // namespace

bool is(std::string_view service) noexcept {
  return service.starts_with("MACR ") || service.starts_with("MACW ") || service.starts_with("MOVCMND ") ||
         service.starts_with("SCP ");
}

// SCP is answered within the scan: positions of axes, which count from 1 there. A CNC says nothing of the rest.
// MOVCMND is taken without an answer, so what no CNC can do is refused before.
int32_t atOnce(const rung_request& request, const Live& live, rung_reply& reply) noexcept {
  const std::string_view service = request.service;
  if (service.starts_with("MOVCMND ") && !moveOf(request.args)) return RUNG_REFUSE;
  if (!service.starts_with("SCP ")) return RUNG_QUEUE;
  const int64_t axis = request.args[1] - 1;
  if (!live.known.load(std::memory_order_acquire) || !isPosition(request.args[0]) || axis < 0 ||
      axis >= int64_t{live.axes.load(std::memory_order_relaxed)})
    return RUNG_REFUSE;
  reply = {.size = sizeof reply, .ticket = request.ticket, .result_count = 1};
  reply.results[0] = std::bit_cast<int64_t>(live.machine[static_cast<size_t>(axis)].load(std::memory_order_relaxed));
  return RUNG_ANSWER;
}

std::optional<Operation> operationOf(const Request& request) {
  const int64_t* args = request.given.args;
  if (request.service.starts_with("MOVCMND ")) return moveOf(args);
  const bool write = request.service.starts_with("MACW ");
  return Operation{.quantity = Quantity::MacroVariable,
                   .write = write,
                   .channel = static_cast<uint32_t>(args[1]),
                   .number = static_cast<uint32_t>(args[0]),
                   .value = write ? std::bit_cast<double>(args[2]) : 0};
}

rung_reply replyOf(const Request& request, const NcAnswer& answer) {
  rung_reply reply{.size = sizeof reply, .ticket = request.given.ticket};
  if (answer.outcome != Outcome::Done) {
    reply.error = 1;
  } else if (request.service.starts_with("MACR ")) {
    reply.result_count = 1;
    reply.results[0] = std::bit_cast<int64_t>(answer.value);
  }
  return reply;
}

} // namespace rung::host::nct

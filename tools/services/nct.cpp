// MACR variable channel -> value, MACW variable channel value: errors are FL_ER=1 in the program (man. l.8070-8125).
#include <bit>
#include <string_view>

#include "tools/services/dialects.h"

namespace rung::services::nct {

bool is(std::string_view service) noexcept { return service.starts_with("MACR ") || service.starts_with("MACW "); }

std::optional<Operation> operationOf(const Request& request) {
  const int64_t* args = request.given.args;
  const bool write = request.service.starts_with("MACW");
  return Operation{.quantity = Quantity::MacroVariable,
                   .write = write,
                   .channel = static_cast<uint32_t>(args[1]),
                   .number = static_cast<uint32_t>(args[0]),
                   .value = write ? std::bit_cast<double>(args[2]) : 0};
}

rung_reply replyOf(const Request& request, const Answer& answer) {
  rung_reply reply{.size = sizeof reply, .ticket = request.given.ticket};
  if (answer.outcome != Outcome::Done) {
    reply.error = 1;
  } else if (request.service.starts_with("MACR")) {
    reply.result_count = 1;
    reply.results[0] = std::bit_cast<int64_t>(answer.value);
  }
  return reply;
}

} // namespace rung::services::nct

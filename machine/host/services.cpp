// See services.h.
#include "machine/host/services.h"

namespace rung::host {

int32_t atOnce(const rung_request& request, const Live& live, rung_reply& reply) noexcept {
  if (!live.served.load(std::memory_order_acquire)) return RUNG_REFUSE;
  if (gsk::is(request.service)) return gsk::atOnce(request, live, reply);
  return nct::is(request.service) ? nct::atOnce(request, live, reply) : RUNG_REFUSE;
}

std::optional<Operation> operationOf(const Request& request, rung_reply& refusal) {
  refusal = {.size = sizeof refusal, .ticket = request.given.ticket, .error = 1};
  if (gsk::is(request.service)) return gsk::operationOf(request, refusal);
  return nct::is(request.service) ? nct::operationOf(request) : std::nullopt;
}

bool Request::reads() const { return service.starts_with("windr ") || service.starts_with("MACR "); }

rung_reply replyOf(const Request& request, const NcAnswer& answer) {
  return gsk::is(request.service) ? gsk::replyOf(request, answer) : nct::replyOf(request, answer);
}

} // namespace rung::host

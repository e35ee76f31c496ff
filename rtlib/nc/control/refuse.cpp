// The refusal of a request (see refuse.h).
#include "rtlib/nc/control/refuse.h"

#include "rtlib/nc/gsk/window_functions.h"

namespace rung::nc {
namespace {

// "windr function length … -> end data": the name is before its arguments. Other services differ in the first letters.
bool isOf(const char* service, const char* name) noexcept {
  for (; *name != '\0'; ++service, ++name)
    if (*service != *name) return false;
  return *service == ' ' || *service == '\0';
}

} // namespace

core::ServiceReply refuse(const rung_program& program, const core::ServiceRequest& request) noexcept {
  const char* const service = request.service < program.service_count ? program.services[request.service] : "";
  const bool reads = isOf(service, "windr");
  if (!reads && !isOf(service, "windw")) return {.ticket = request.ticket, .state = RUNG_SERVICE_ERROR};
  return {.ticket = request.ticket,
          .state = RUNG_SERVICE_DONE,
          .resultCount = reads ? 2u : 1u,
          .results = {gsk::kWindowNotProvided}};
}

} // namespace rung::nc

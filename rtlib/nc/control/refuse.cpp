// The refusal of a request (see refuse.h).
#include "rtlib/nc/control/refuse.h"

#include "rtlib/host/program_info.h"
#include "rtlib/nc/gsk/window_functions.h"

namespace rung::nc {

rt::ServiceReply refuse(const rung_program& program, const rt::ServiceRequest& request) noexcept {
  // "windr function length … -> end data": the name is before its arguments.
  std::string_view service = host::serviceName(program, request.service);
  service = service.substr(0, service.find(' '));
  if (service != "windr" && service != "windw") return {.ticket = request.ticket, .state = RUNG_SERVICE_ERROR};
  return {.ticket = request.ticket,
          .state = RUNG_SERVICE_DONE,
          .resultCount = service == "windr" ? 2u : 1u,
          .results = {gsk::kWindowNotProvided}};
}

} // namespace rung::nc

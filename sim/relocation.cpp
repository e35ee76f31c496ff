// Requests in another program (see relocation.h).
#include "sim/relocation.h"

#include <string_view>

#include "rtlib/load/program_info.h"
#include "rtlib/nc/nct/operand_block.h"

namespace rung::sim {

uint32_t Relocation::service(uint32_t number) const {
  return number < from_->service_count ? runtime::findService(*to_, runtime::serviceName(*from_, number)) : RUNG_NONE;
}

namespace {

// Of "MR function address block -> code": 2. Nothing where the service has no operand block.
std::optional<uint32_t> blockArgument(std::string_view signature) {
  signature = signature.substr(0, signature.find("->"));
  uint32_t index = 0;
  for (size_t at = signature.find(' '); at != std::string_view::npos; ++index) {
    const size_t end = signature.find(' ', at + 1);
    if (signature.substr(at + 1, end - at - 1) == "block") return index;
    at = end;
  }
  return std::nullopt;
}

} // namespace

void Relocation::renumber(core::ServiceRequest& request) const {
  const auto block = blockArgument(runtime::serviceName(*from_, request.service));
  request.service = service(request.service);
  if (!block || request.service == RUNG_NONE) return;
  int64_t& first = request.args[*block]; // a word of the space
  const auto moved =
      place(runtime::intRef(runtime::findSpace(*from_, nc::nct::kBlockSpace), 4 * static_cast<uint32_t>(first), 32));
  if (moved)
    first = moved->byte / 4;
  else
    request.service = RUNG_NONE;
}

} // namespace rung::sim

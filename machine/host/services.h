// Requests of the dialects' programs as operations, and outcomes as the dialects' own results and errors.
#pragma once
#include <optional>
#include <string>

#include "machine/host/nc_operation.h"
#include "machine/host/services_live.h"
#include "rung/runtime.h"

namespace rung::host {

// A request that waits for its answer: the program that has asked may have been replaced meanwhile.
struct Request {
  std::string service; // as rung_request has it
  rung_request given{};
  bool reads() const; // there is a result
};

// For the scan, in rung_instance_options::request: an enum rung_answer. Where nobody serves, and for what no operation
// is like, the control refuses at once. Allocates nothing.
int32_t atOnce(const rung_request& request, const Live& live, rung_reply& reply) noexcept;

// Nothing: `refusal` is the answer.
std::optional<Operation> operationOf(const Request& request, rung_reply& refusal);
rung_reply replyOf(const Request& request, const NcAnswer& answer);

} // namespace rung::host

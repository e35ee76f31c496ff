// The dialects' parts of translate.h. `is` says whether a request is the dialect's, and may wait for an answer.
#pragma once
#include "machine/host/services.h"

namespace rung::host {

// The window functions of GSK25i (man. §9.3) and its PLC axis control (§9.2). Window functions of high speed are
// answered at once, or by no one.
namespace gsk {
bool is(std::string_view service) noexcept;
int32_t atOnce(const rung_request& request, const Live& live, rung_reply& reply) noexcept;
std::optional<Operation> operationOf(const Request& request, rung_reply& refusal);
rung_reply replyOf(const Request& request, const NcAnswer& answer);
} // namespace gsk

// MACR, MACW, MOVCMND and SCP of NCT (man. §6.15-§6.17). SCP is answered at once, or by no one.
namespace nct {
bool is(std::string_view service) noexcept;
int32_t atOnce(const rung_request& request, const Live& live, rung_reply& reply) noexcept;
std::optional<Operation> operationOf(const Request& request);
rung_reply replyOf(const Request& request, const NcAnswer& answer);
} // namespace nct

} // namespace rung::host

// What the control exchanges with a program (see exchange.h).
#include "sim/technol/exchange.h"

#include "rtlib/load/program_info.h"

namespace rung::sim::technol {

std::string Exchange::configure(std::string_view key, std::string_view value) {
  std::string problem;
  if (!ports_.configure(key, value, problem)) connections_.configure(key, value);
  return problem;
}

void Exchange::beforeInit(runtime::Instance& instance, bool powerOn) {
  program_ = &instance.program();
  shared_.clear();
  defined_ = false;
  if (powerOn) {
    cells_.reset();
    ports_.reset(instance);
  }
  connections_.preset(instance);
}

void Exchange::afterInit(runtime::Instance& instance) {
  connections_.build(instance, shared_, cells_);
  defined_ = false;
}

void Exchange::programChanged(runtime::Instance& instance) {
  if (program_ == nullptr) return; // before the first power-on
  shared_.relocate(runtime::Relocation(*program_, instance.program()));
  program_ = &instance.program();
  ports_.locate(instance);
  afterInit(instance);
}

uint32_t Exchange::works() const {
  constexpr uint32_t kPorts = 1u << nc::kHookBeforeInput | 1u << nc::kHookAfterMain;
  return connections_.configured() ? kPorts | 1u << nc::kHookFast | 1u << nc::kHookFastest : kPorts;
}

void Exchange::onHook(runtime::Instance& instance, uint32_t hook) {
  if (defined_) afterInit(instance); // by a procedure that runs outside MODULE_INIT
  switch (hook) {
  case nc::kHookBeforeInput:
    ports_.beforeProgram(instance);
    connections_.copy(instance, cells_, nc::ExchangePeriod::Slow);
    return;
  case nc::kHookAfterMain:
    connections_.copy(instance, cells_, nc::ExchangePeriod::Slow);
    ports_.afterProgram(instance);
    return;
  case nc::kHookFast: connections_.copy(instance, cells_, nc::ExchangePeriod::Fast); return;
  case nc::kHookFastest: connections_.copy(instance, cells_, nc::ExchangePeriod::Fastest); return;
  default: return;
  }
}

void Exchange::define(runtime::Instance& instance, const core::ServiceRequest& request, core::ServiceReply& reply) {
  const auto variable = variableOf(request);
  if (!variable) return;
  bool isNew = false;
  if (!shared_.define(instance.program(), *variable, isNew)) return;
  defined_ = defined_ || isNew;
  reply.results[0] = 1;
  const auto otherwise = connections_.defaultOf(*variable);
  reply.results[1] = otherwise ? 1 : 0;
  reply.results[2] = static_cast<int64_t>(otherwise.value_or(0));
}

bool Exchange::respond(runtime::Instance& instance, const core::ServiceRequest& request, core::ServiceReply& reply) {
  const std::string_view service = runtime::serviceName(instance.program(), request.service);
  if (service != nc::kDefineService && service != nc::kUpdateService) return false;
  reply.ticket = request.ticket;
  reply.state = RUNG_SERVICE_DONE;
  reply.resultCount = 3;
  if (service == nc::kDefineService)
    define(instance, request, reply);
  else
    connections_.update(instance, cells_, request, reply);
  return true;
}

} // namespace rung::sim::technol

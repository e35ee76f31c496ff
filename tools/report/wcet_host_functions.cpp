// The measurement (see host_functions.h).
#include "tools/report/wcet_host_functions.h"

#include <algorithm>
#include <array>
#include <limits>
#include <memory>

#include "ir/core/ops.h"
#include "rtlib/core/queues.h"
#include "rtlib/run/realtime.h"

namespace rung::report {
namespace {

constexpr int kSweeps = 8;        // the first ones warm caches and the links between libraries up
constexpr uint32_t kBatches = 40; // more calls than queues have room for
constexpr uint32_t kCalls = 16;   // in a batch, beside which reading the clock is cheap

void call(ir::OpCode operation, rung_ctx& ctx, uint32_t number) {
  const int64_t args[RUNG_MAX_SERVICE_ARGS] = {};
  const rung_message message{.number = number};
  switch (operation) {
  case ir::OpCode::Message: return ctx.host->message(&ctx, &message);
  case ir::OpCode::ServiceRequest: ctx.host->service_request(&ctx, 0, args, RUNG_MAX_SERVICE_ARGS); return;
  case ir::OpCode::ServicePoll: ctx.host->service_poll(&ctx, number); return;
  default: ctx.host->service_result(&ctx, number, 0);
  }
}

double nsOf(ir::OpCode operation, rung_ctx& ctx, core::HostPort& port) {
  std::array<int64_t, kBatches> fastest{};
  fastest.fill(std::numeric_limits<int64_t>::max());
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    port.messages.drop();
    port.services.restart();
    for (uint32_t batch = 0; batch < kBatches; ++batch) {
      const int64_t begin = runtime::monotonicNs();
      for (uint32_t i = 0; i < kCalls; ++i) call(operation, ctx, batch * kCalls + i);
      fastest[batch] = std::min(fastest[batch], runtime::monotonicNs() - begin);
    }
  }
  return static_cast<double>(std::ranges::max(fastest)) / kCalls;
}

} // namespace

std::vector<HostFunction> measureHostFunctions() {
  const auto port = std::make_unique<core::HostPort>();
  rung_ctx ctx{.host = &core::hostApi(), .host_data = port.get()};
  std::vector<HostFunction> functions;
  for (const ir::OpCode operation :
       {ir::OpCode::Message, ir::OpCode::ServiceRequest, ir::OpCode::ServicePoll, ir::OpCode::ServiceResult})
    functions.push_back({operation, nsOf(operation, ctx, *port)});
  return functions;
}

} // namespace rung::report

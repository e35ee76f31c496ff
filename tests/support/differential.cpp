// Two engines in step (see differential.h).
#include "tests/support/differential.h"

#include <fmt/format.h>

#include "ir/text/text.h"
#include "rtlib/change/shadow.h"
#include "rtlib/nc/names/names.h"

namespace rung::testing {
namespace {

// Answers every second request in the same scan, so that programs see both kinds.
class Responder final : public runtime::ScheduleHooks {
public:
  bool respond(runtime::Instance&, const core::ServiceRequest& request, core::ServiceReply& reply) override {
    if (request.ticket % 2 == 0) return false;
    reply.ticket = request.ticket;
    reply.state = request.argCount % 3 == 0 ? uint32_t{RUNG_SERVICE_ERROR} : uint32_t{RUNG_SERVICE_DONE};
    reply.resultCount = 4;
    for (uint32_t i = 0; i < reply.resultCount; ++i)
      reply.results[i] = static_cast<int64_t>(i) * 1000 ^ (request.argCount > 0 ? request.args[0] : 7);
    return true;
  }
};

std::optional<std::string> firstCountDifference(const runtime::Instance& a, const runtime::Instance& b) {
  for (size_t i = 0; i < a.profile().size(); ++i)
    if (a.profile()[i].count != b.profile()[i].count)
      return fmt::format("rung {} was counted {} times here, {} times there", i, a.profile()[i].count,
                         b.profile()[i].count);
  return std::nullopt;
}

} // namespace

std::optional<std::string> firstDisagreement(runtime::Engine& first, runtime::Engine& second, int scans,
                                             const BeforeScan& before) {
  Responder answers;
  const auto a = std::make_unique<runtime::Instance>(first, &answers);
  const auto b = std::make_unique<runtime::Instance>(second, &answers);
  for (int scan = 1; scan <= scans; ++scan) {
    for (runtime::Instance* instance : {a.get(), b.get()}) {
      if (before) before(*instance, scan);
      instance->scan();
    }
    auto difference = runtime::firstDifference(*a, *b, nc::describe);
    if (!difference) difference = firstCountDifference(*a, *b);
    if (difference) return fmt::format("scan {}: {} against {}: {}", scan, first.name(), second.name(), *difference);
  }
  return std::nullopt;
}

compiler::Compiled compiledFrom(ir::Module module, const ir::LayoutOptions& options) {
  compiler::Compiled out;
  out.module = std::make_unique<ir::Module>(std::move(module));
  out.layout = std::make_unique<ir::Layout>(*out.module, options);
  out.codeHash = ir::hashOf(*out.module);
  return out;
}

compiler::Compiled compiledFromBuilt(const ir::Module& built, const ir::LayoutOptions& options, bool optimise) {
  compiler::Compiled out;
  out.built = std::make_unique<ir::Module>(built);
  out.passes = {.optimise = optimise};
  out.module = std::make_unique<ir::Module>(built);
  out.shape = std::make_unique<ir::Module>();
  ir::runPasses(*out.module, out.passes, out.shape.get());
  out.layout = std::make_unique<ir::Layout>(ir::Layout(*out.shape, options).over(*out.module));
  out.codeHash = ir::hashOf(*out.module);
  return out;
}

} // namespace rung::testing

// Counters and times of rungs.
#include <algorithm>

#include "rtlib/api/error.h"
#include "rtlib/api/instance.h"
#include "rtlib/api/structs.h"

namespace rung::api {
namespace {

rung_profile profileOf(const rung_instance& instance, uint32_t index) noexcept {
  const rung_program& program = instance.running.program();
  const rung_rung_info& rung = program.rungs[index];
  const rung_prof& counters = instance.running.profile()[index];
  const runtime::ProfileClock& clock = instance.now().clock;
  const double ticks = static_cast<double>(counters.total) - static_cast<double>(counters.count) * clock.costTicks;
  const double longest = counters.count == 0 ? 0 : static_cast<double>(counters.max) - clock.costTicks;
  return {.rung = rung.number,
          .line = rung.first_line,
          .file = rung.file < program.file_count ? program.files[rung.file] : "",
          .title = rung.title,
          .runs = counters.count,
          .total_ns = std::max(0.0, ticks * clock.nsPerTick),
          .max_ns = std::max(0.0, longest * clock.nsPerTick)};
}

int32_t failProfile() noexcept {
  return fail(RUNG_WRONG_STATE, "the program does not count its rungs: build it with rungc build --profile");
}

} // namespace
} // namespace rung::api

using namespace rung::api;

int32_t rung_instance_profile(const rung_instance* instance, uint32_t index, rung_profile* profile) {
  const Call call(instance, When::Always);
  if (!call.ok()) return call.status();
  if (call->running.profile().empty()) return failProfile();
  if (index >= call->running.profile().size()) return RUNG_EMPTY;
  return giveStruct(profile, profileOf(*call, index));
}

int32_t rung_instance_clear_profile(rung_instance* instance) {
  const Call call(instance);
  if (!call.ok()) return call.status();
  if (call->running.profile().empty()) return failProfile();
  call->running.clearProfile();
  return RUNG_OK;
}

int32_t rung_instance_worst_rung(const rung_instance* instance, rung_profile* profile) {
  const Call call(instance, When::Always);
  if (!call.ok()) return call.status();
  const std::span<const rung_prof> all = call->running.profile();
  if (all.empty()) return failProfile();
  const auto worst = std::ranges::max_element(all, {}, &rung_prof::max);
  if (worst->count == 0) return RUNG_EMPTY;
  return giveStruct(profile, profileOf(*call, static_cast<uint32_t>(worst - all.begin())));
}

// Random programs beside themselves, with another memory layout and other code: they never do otherwise, whatever the
// machine, the host and its answers do.
#include "rtlib/change/shadow.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "ir/interp/interp.h"
#include "ir/transforms/pipeline.h"
#include "rtlib/nc/names/names.h"
#include "rtlib/run/instance.h"
#include "tests/random/random.h"

namespace rung::runtime {
namespace {

using Random = std::mt19937_64;

// Answers some requests at once, and leaves the others to whoever takes them later.
struct Answering final : ScheduleHooks {
  bool respond(Instance&, const core::ServiceRequest& request, core::ServiceReply& reply) override {
    shadow->requested(request);
    ++requests;
    if (request.ticket % 3 != 0) return false;
    reply.resultCount = 2;
    reply.results[0] = reply.results[1] = int64_t{request.ticket} * 7;
    return true;
  }
  Shadow* shadow = nullptr;
  uint32_t requests = 0;
};

void answerSome(Random& random, Instance& instance) {
  core::ServiceRequest request;
  while (random() % 4 != 0 && instance.services().take(request))
    (void)instance.services().complete(
        {.ticket = request.ticket, .resultCount = 1, .results = {static_cast<int64_t>(random() % 100)}});
}

TEST(RandomShadow, DoesWhatTheProgramDoes) {
  uint32_t requests = 0;
  uint64_t runs = 0;
  for (uint64_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    ir::Module live = ir::randomModule(seed, {.traps = false});
    live.tasks[0].parts = 1; // a pass of these schedules is not a whole number of runs
    live.tasks[0].borders.clear();
    for (size_t s = 2; s < live.spaces.size(); s += 2) live.spaces[s].flags |= RUNG_SPACE_OUTPUT;
    ir::Module next = live; // with another layout, and not optimised
    next.slots.push_back({.type = ir::Type::I64, .key = "of the shadow alone"});
    ir::runPasses(live, {});
    const ir::Layout liveLayout(live, {});
    const ir::Layout nextLayout(next, {.expandBits = false});
    ir::InterpEngine liveEngine(liveLayout, 1);
    ir::InterpEngine nextEngine(nextLayout, 2);
    Answering hooks;
    Instance instance(Runnable{liveEngine.program(), liveEngine.context()}, &hooks);
    Shadow shadow(liveEngine.program(), {nextEngine.program(), nextEngine.context()}, &nc::describe, 100, 16);
    ASSERT_EQ(shadow.problem(), "");
    hooks.shadow = &shadow;
    Random random(seed);
    bool begun = false;
    for (int scan = 0; scan < 12; ++scan) {
      for (int i = 0; i < 4; ++i)
        instance.memory().writeByte(static_cast<uint32_t>(random() % 3), static_cast<uint32_t>(random() % 16),
                                    static_cast<uint8_t>(random()));
      answerSome(random, instance);
      if (!begun && scan >= 3) begun = shadow.begin(instance) == ReplaceResult::Replaced;
      instance.scan();
      if (instance.faulted()) break;
      if (random() % 3 == 0)
        while (shadow.work()) {
        }
    }
    while (shadow.work()) {
    }
    EXPECT_NE(shadow.state(), ShadowState::Faulted) << shadow.faultText();
    for (const ShadowDifference& d : shadow.differences())
      ADD_FAILURE() << d.name << ": " << d.live << " and " << d.next << " at " << d.firstUs;
    requests += hooks.requests;
    runs += shadow.runs();
    shadow.end(instance);
    if (HasFailure()) return;
  }
  EXPECT_GT(requests, 100u);
  EXPECT_GT(runs, 1000u);
}

} // namespace
} // namespace rung::runtime

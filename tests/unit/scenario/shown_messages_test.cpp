// Control::shows, by which whoever watches messages sees that they are as before, against the messages themselves.
#include <gtest/gtest.h>

#include <algorithm>

#include "tools/scenario/runner.h"

namespace rung::scenario {
namespace {

struct ShownMessages final : Observer {
  void scanned(const Session& session) override {
    const nc::Control& control = session.nc().control();
    std::vector<nc::ShownMessage> now = control.messages(session.instance());
    const bool same = std::ranges::equal(now, before, [](const auto& a, const auto& b) { return a.isSameButText(b); });
    EXPECT_TRUE(control.shows(session.instance(), now));
    EXPECT_EQ(control.shows(session.instance(), before), same);
    EXPECT_EQ(now == before, same) << "a text that is not of the message and its values";
    if (!now.empty()) EXPECT_FALSE(control.shows(session.instance(), std::span(now).first(now.size() - 1)));
    changes += same ? 0 : 1;
    before = std::move(now);
  }
  std::vector<nc::ShownMessage> before;
  uint32_t changes = 0;
};

class Shown : public testing::TestWithParam<const char*> {};

TEST_P(Shown, AreTheMessages) {
  ShownMessages messages;
  RunOptions options;
  options.engines = {compiler::EngineKind::Interp};
  options.started = [&](Session& session, const compiler::Compiled&) {
    session.addObserver(messages);
    return std::string();
  };
  const Result<Scenario> scenario = readScenario(GetParam());
  ASSERT_TRUE(scenario.ok());
  const RunResult result = run(scenario.value(), options);
  EXPECT_TRUE(result.passed) << result.environment;
  EXPECT_GE(messages.changes, 3u);
}

INSTANTIATE_TEST_SUITE_P(Machines, Shown,
                         testing::Values("examples/fanuc-vmc/alarms.scn", "examples/gsk-mill/alarms.scn",
                                         "examples/nct-turning-centre/alarms.scn",
                                         "examples/technol-machining-centre/machine-on-faults.scn"));

} // namespace
} // namespace rung::scenario

// What the simulated NC does to a program in a scenario, recorded, and played to another engine.
#include <gtest/gtest.h>

#include "compiler/engines.h"
#include "rtlib/record/bytes_player.h"
#include "rtlib/record/recorder.h"
#include "tools/scenario/runner.h"

namespace rung::scenario {
namespace {

using runtime::Played;

struct NoForces final : runtime::PlayerOwner {
  bool force(runtime::Instance& instance, std::span<const core::ForcedBits> bits) override {
    instance.endForces();
    return bits.empty();
  }
};

// A byte that the program only writes is compared: what the NC writes there is recorded, too.
runtime::RecordedBytes allOf(const rung_program& program) {
  const runtime::BlockBytes written = runtime::writtenBytes(program);
  runtime::BlockBytes compared = runtime::readBytes(program);
  for (size_t i = 0; i < written.size(); ++i) compared[i] = compared[i] || written[i];
  return {.before = runtime::WatchedBytes(program), .within = {program, compared}, .outputs = {program, written}};
}

// Records from the first scan on.
struct Recorded final : Observer {
  explicit Recorded(runtime::Instance& of)
      : instance(of), recorder(of, allOf(of.program()), {.ringBytes = size_t{1} << 24, .stateEveryUs = 200'000}) {
    instance.setOutsideWatch(&recorder);
  }
  void scanned(const Session&) override {
    ++scans;
    recorder.flush();
    for (auto record = recorder.ring().front(); !record.empty(); record = recorder.ring().front()) {
      events.insert(events.end(), record.begin(), record.end());
      recorder.ring().pop();
    }
  }

  runtime::Instance& instance;
  runtime::Recorder recorder;
  std::vector<uint8_t> events;
  uint32_t scans = 0;
};

class Recordings : public testing::TestWithParam<const char*> {};

TEST_P(Recordings, ArePlayedByAnotherEngine) {
  std::optional<Recorded> recorded;
  std::unique_ptr<runtime::Engine> engine;
  uint32_t parts = 0, states = 0;
  RunOptions options;
  options.engines = {compiler::EngineKind::Interp};
  options.started = [&](Session& session, const compiler::Compiled& program) {
    recorded.emplace(session.instance());
    session.addObserver(*recorded);
    engine = std::move(compiler::makeEngine(compiler::EngineKind::Jit, program, {})).value();
    return std::string();
  };
  const Result<Scenario> scenario = readScenario(GetParam());
  ASSERT_TRUE(scenario.ok());
  EXPECT_TRUE(run(scenario.value(), options).passed);
  runtime::Instance instance(*engine);
  NoForces owner;
  runtime::BytesPlayer player(instance, owner);
  player.setEvents(recorded->events);
  for (Played played = player.play(); played != Played::End; played = player.play()) {
    ASSERT_TRUE(played == Played::Part || played == Played::State)
        << static_cast<int>(played) << " at " << player.position() << " after " << parts;
    ASSERT_FALSE(player.difference()) << "part " << parts << ": " << static_cast<int>(player.difference()->kind) << " "
                                      << player.difference()->offset;
    ++(played == Played::Part ? parts : states);
  }
  EXPECT_GT(recorded->scans, 10u);
  EXPECT_GE(parts, recorded->scans);
  EXPECT_GE(states, 1u);
}

INSTANTIATE_TEST_SUITE_P(Machines, Recordings,
                         testing::Values("examples/fanuc-vmc/nc-program.scn", "examples/gsk-mill/nc-program.scn",
                                         "examples/gsk-mill/window.scn", "examples/nct-turning-centre/nc-program.scn",
                                         "examples/nct-turning-centre/windows.scn",
                                         "examples/technol-machining-centre/part-program.scn",
                                         "examples/technol-machining-centre/tool-change-faults.scn"));

} // namespace
} // namespace rung::scenario

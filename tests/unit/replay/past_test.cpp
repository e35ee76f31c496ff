// Recorded scenarios of all dialects: every position is reached in any order with the state that the run had there, and
// the flow of each part ends with the state after it.
#include <algorithm>
#include <map>
#include <random>

#include <gtest/gtest.h>

#include "tools/replay/past.h"
#include "tools/replay/record_run.h"
#include "tools/scenario/in_project.h"

namespace rung::replay {
namespace {

// Blocks by scan, as the run itself had them.
struct Truth final : scenario::Observer {
  explicit Truth(scenario::Session& session) : program(session.instance().program()) {}
  void scanned(const scenario::Session& session) override {
    const auto block = session.instance().block();
    blocks.emplace_back(block.begin(), block.end());
    clocks.push_back(session.nowUs());
  }
  const rung_program& program;
  std::vector<std::vector<uint8_t>> blocks;
  std::vector<int64_t> clocks;
};

// Bytes that rungs write.
std::vector<uint8_t> written(std::span<const uint8_t> block, const rung_program& program) {
  std::vector<uint8_t> out;
  for (const rung_written& of : std::span(program.writes, program.write_count))
    for (uint32_t i = 0; i < of.size; ++i) out.push_back(block[of.offset + i] & of.mask);
  return out;
}

// Bytes that the program can see or that it writes.
std::vector<uint8_t> seen(std::span<const uint8_t> block, const rung_program& program) {
  static std::map<uint64_t, runtime::BlockBytes> known;
  runtime::BlockBytes& bytes = known[program.code_hash];
  if (bytes.empty()) {
    bytes = runtime::readBytes(program);
    const runtime::BlockBytes written = runtime::writtenBytes(program);
    for (size_t i = 0; i < bytes.size(); ++i) bytes[i] = bytes[i] || written[i];
  }
  std::vector<uint8_t> out;
  for (size_t i = 0; i < block.size(); ++i)
    if (bytes[i]) out.push_back(block[i]);
  return out;
}

class Pasts : public testing::TestWithParam<const char*> {};

TEST_P(Pasts, AreReachedInAnyOrder) {
  Result<scenario::Scenario> scenario = scenario::readScenario(GetParam());
  ASSERT_TRUE(scenario.ok());
  scenario::takeProject(scenario.value());
  std::unique_ptr<Truth> truth;
  scenario::RunOptions options{.engines = {compiler::EngineKind::Interp}};
  options.started = [&](scenario::Session& session, const compiler::Compiled&) {
    truth = std::make_unique<Truth>(session);
    session.addObserver(*truth);
    return std::string();
  };
  Result<RecordedScenario> recorded = recordScenario(scenario.value(), options);
  ASSERT_TRUE(recorded.ok()) << recorded.error();
  EXPECT_TRUE(recorded.value().result.passed);
  Result<std::unique_ptr<Past>> opened =
      Past::open(recorded.value().recording, {.engine = compiler::EngineKind::Interp, .keptEvery = 16});
  ASSERT_TRUE(opened.ok()) << opened.error();
  Past& past = *opened.value();
  // A scan of the session may be several parts, while the control is switched on or off.
  std::map<uint64_t, size_t> known;      // by part: index of the scan in the truth
  const auto isScan = [&](size_t scan) { // by what the program wrote: the machine may have moved since
    return scan < truth->blocks.size() && past.instance().nowUs() == truth->clocks[scan] &&
           written(past.instance().block(), past.instance().program()) ==
               written(truth->blocks[scan], past.instance().program());
  };
  for (size_t scan = 0; past.next();) {
    const int64_t now = past.instance().nowUs();
    while (scan < truth->clocks.size() && truth->clocks[scan] < now) ++scan;
    if (scan == truth->clocks.size() || truth->clocks[scan] != now) continue;
    if (isScan(scan)) known[past.part()] = scan;
    ++scan;
  }
  // The simulated machine may have moved between the end of a part and that of the session's scan.
  ASSERT_GT(known.size() * 10, truth->blocks.size() * 9);
  std::mt19937 random(3);
  const auto check = [&](uint64_t part) {
    ASSERT_EQ(past.part(), part);
    if (known.contains(part)) ASSERT_TRUE(isScan(known[part])) << "part " << part;
  };
  for (int i = 0; i < 60; ++i) {
    const uint64_t part = 1 + random() % past.contents().parts;
    ASSERT_EQ(past.goTo(part), "");
    check(part);
    if (HasFatalFailure()) return;
    if (part < 2 || i % 3 != 0) continue;
    const Flow* flow = past.flow(); // the position stays
    check(part);
    if (HasFatalFailure() || flow == nullptr) continue;
    EXPECT_FALSE(flow->runs().empty() && !past.instance().faulted() && !past.instance().stopped());
    const rung_program& program = past.instance().program();
    ASSERT_EQ(seen(past.flowInstance().block(), program), seen(past.instance().block(), program)) << "part " << part;
    ASSERT_EQ(past.goTo(part - 1), "");
    check(part - 1);
    if (HasFatalFailure()) return;
  }
  ASSERT_EQ(past.goTo(past.firstPart()), "");
  while (past.next()) {
  }
  EXPECT_EQ(past.problem(), "");
  EXPECT_EQ(past.part(), past.contents().parts);
  for (const Difference& difference : past.differences())
    ADD_FAILURE() << "part " << difference.part << ": " << difference.place;
}

INSTANTIATE_TEST_SUITE_P(Machines, Pasts,
                         testing::Values("examples/fanuc-vmc/nc-program.scn", "examples/gsk-mill/tool-change.scn",
                                         "examples/gsk-mill/window.scn", "examples/nct-turning-centre/nc-program.scn",
                                         "examples/technol-machining-centre/part-program.scn",
                                         "examples/technol-machining-centre/door-forced.scn"));

} // namespace
} // namespace rung::replay

// A state that one instance saves is continued by another one, on another engine, as by the first: the example machines
// with the control of their dialect, and random inputs.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "compiler/engines.h"
#include "rtlib/api/instance.h"
#include "rung/runtime.hpp"
#include "tools/scenario/runner.h"

namespace rung::scenario {
namespace {

constexpr uint32_t kParts = 300, kSavedAfter = 120, kChangesAPart = 3;

class Side {
public:
  Side(compiler::EngineKind kind, const compiler::Compiled& program)
      : engine_(std::move(compiler::makeEngine(kind, program, {})).value()),
        image_(Image::adopt(engine_->program(), engine_->context())), instance_(image_),
        inside_(api::insideOf(*instance_.handle())) {
    instance_.powerOn(Power::Cold);
  }

  Instance& operator*() { return instance_; }
  // Writes random bytes to the inputs, and runs a part.
  void part(std::mt19937& random) {
    const rung_program& program = inside_.program();
    for (uint32_t i = 0; i < kChangesAPart; ++i) {
      const uint32_t space = static_cast<uint32_t>(random() % program.space_count);
      const auto byte = static_cast<uint32_t>(random() % program.spaces[space].byte_count);
      const auto value = static_cast<uint8_t>(random());
      if ((program.spaces[space].flags & RUNG_SPACE_INPUT) != 0) inside_.memory().writeByte(space, byte, value);
    }
    if (instance_.handle()->control->runsInSlots())
      instance_.slot();
    else
      instance_.scan();
  }
  size_t blockSize() { return inside_.block().size(); }
  // Everything that a host sees after a part.
  std::string seen() {
    std::string text(inside_.block().begin(), inside_.block().end());
    text += std::to_string(inside_.nowUs()) + inside_.faultText();
    while (const auto message = instance_.nextMessage())
      text += std::to_string(message->op) + " " + std::to_string(message->number) + message->text;
    for (const auto& shown : instance_.shown()) text += shown.text;
    return text;
  }

private:
  std::unique_ptr<runtime::Engine> engine_;
  Image image_;
  Instance instance_;
  runtime::Instance& inside_;
};

void continues(const compiler::Compiled& program, uint32_t seed) {
  Side first(compiler::EngineKind::Interp, program), second(compiler::EngineKind::Jit, program);
  std::mt19937 random(seed);
  for (uint32_t i = 0; i < kSavedAfter; ++i) first.part(random), (void)first.seen();
  for (uint32_t i = 0; i < 5; ++i) second.part(random);
  (void)second.seen();
  const auto state = (*first).save();
  ASSERT_TRUE(state);
  (*second).load(*state);
  EXPECT_EQ((*second).save(), state);
  std::mt19937 same = random;
  std::vector<std::string> seen;
  for (uint32_t i = kSavedAfter; i < kParts; ++i) {
    first.part(random);
    second.part(same);
    seen.push_back(first.seen());
    ASSERT_TRUE(second.seen() == seen.back()) << "part " << i;
  }
  EXPECT_NE(std::ranges::adjacent_find(seen, std::ranges::not_equal_to()), seen.end());
}

// Whatever a few bytes say, the state is refused, or the program runs with it.
void isRefusedOrRuns(const compiler::Compiled& program, uint32_t seed) {
  constexpr uint32_t kDamages = 500, kBytes = 4;
  Side plc(compiler::EngineKind::Jit, program);
  std::mt19937 random(seed);
  for (uint32_t i = 0; i < kSavedAfter; ++i) plc.part(random), (void)plc.seen();
  const std::optional<std::vector<uint8_t>> state = (*plc).save();
  ASSERT_TRUE(state);
  // Most of a state is memory of the program: every other damage is behind that, where the control's own state is.
  const size_t ofControl = std::min(state->size(), plc.blockSize());
  uint32_t refused = 0;
  for (uint32_t i = 0; i < kDamages; ++i) {
    std::vector<uint8_t> damaged = *state;
    for (uint32_t k = 0; k < 1 + random() % kBytes; ++k) {
      const size_t from = i % 2 == 0 ? 0 : ofControl;
      damaged[from + random() % (damaged.size() - from)] = static_cast<uint8_t>(random());
    }
    (*plc).powerOn();
    if (rung_instance_load((*plc).handle(), damaged.data(), damaged.size()) == RUNG_OK)
      for (uint32_t k = 0; k < 3; ++k) plc.part(random), (void)plc.seen();
    else
      ++refused;
  }
  EXPECT_GT(refused, 0u);
  EXPECT_LT(refused, kDamages);
}

void forSeeds(const char* path, void (*test)(const compiler::Compiled& program, uint32_t seed)) {
  RunOptions options;
  options.engines = {compiler::EngineKind::Interp};
  options.started = [&](Session&, const compiler::Compiled& program) {
    for (uint32_t seed = 0; seed < 3; ++seed) test(program, seed);
    return std::string();
  };
  const Result<Scenario> scenario = readScenario(path);
  ASSERT_TRUE(scenario.ok());
  EXPECT_TRUE(run(scenario.value(), options).passed);
}

class States : public testing::TestWithParam<const char*> {};

TEST_P(States, AreContinuedByAnyEngine) { forSeeds(GetParam(), continues); }
TEST_P(States, AreRefusedOrRunWhenDamaged) { forSeeds(GetParam(), isRefusedOrRuns); }

INSTANTIATE_TEST_SUITE_P(Machines, States,
                         testing::Values("examples/fanuc-vmc/alarms.scn", "examples/gsk-mill/alarms.scn",
                                         "examples/nct-turning-centre/alarms.scn",
                                         "examples/technol-machining-centre/table.scn"));

} // namespace
} // namespace rung::scenario

// What the interpreter sees rungs read and write, in all scenarios: each place is among those that ir/analysis/uses.h,
// which cross references are made of, states for that rung and that side.
#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <set>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tools/scenario/runner.h"

namespace rung {
namespace {

// A rung that touches what it should not be able to, once a rung and space.
using Surprises = std::set<std::string>;

class Witness final : public ir::RungObserver {
public:
  Witness(const compiler::Compiled& compiled, Surprises& surprises)
      : compiled_(compiled), stated_(compiled.uses->rungCount()), surprises_(surprises) {
    for (uint32_t rung = 0; rung < stated_.size(); ++rung)
      for (const ir::RungUse& use : compiled.uses->of(rung))
        stated_[rung][use.writes][use.place.space.index].emplace_back(use.place.first,
                                                                      use.place.first + use.place.count);
  }
  void rungRan(uint32_t, std::span<const uint64_t>) override {}
  void accessed(const ir::Access& access) override {
    if (!access.slot.valid()) touched(access.rung, access.place, access.writes);
  }

private:
  using Runs = std::vector<std::pair<uint32_t, uint32_t>>; // of bits: first and end
  void touched(uint32_t rung, const ir::BitRange& place, bool writes) {
    if (isStated(rung, place, writes)) return;
    surprises_.insert(fmt::format("{} of {}: rung {} {} {} bits from {}", compiled_.module->at(place.space).name,
                                  compiled_.module->files[0], rung, writes ? "writes" : "reads", place.count,
                                  place.first));
  }
  bool isStated(uint32_t rung, const ir::BitRange& place, bool writes) const {
    const std::map<uint32_t, Runs>& bySpace = stated_[rung][writes];
    const auto runs = bySpace.find(place.space.index);
    return runs != bySpace.end() && std::ranges::any_of(runs->second, [&](const auto& run) {
             return run.first <= place.first && place.first + place.count <= run.second;
           });
  }

  const compiler::Compiled& compiled_;
  std::vector<std::array<std::map<uint32_t, Runs>, 2>> stated_; // by rung, side and space
  Surprises& surprises_;
};

std::vector<std::string> scenariosIn(const std::string& folder) {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.path().extension() == ".scn") files.push_back(entry.path());
  std::ranges::sort(files);
  return files;
}

class CrossReferenceTruth : public testing::TestWithParam<const char*> {};

TEST_P(CrossReferenceTruth, AllThatRungsTouchIsStated) {
  Surprises surprises;
  scenario::RunOptions options{.engines = {compiler::EngineKind::Interp}};
  uint32_t programs = 0;
  options.engine.observer = [&](const compiler::Compiled& compiled) {
    ++programs;
    return std::make_unique<Witness>(compiled, surprises);
  };
  for (const std::string& file : scenariosIn(GetParam())) {
    const Result<scenario::Scenario> scenario = scenario::readScenario(file);
    ASSERT_TRUE(scenario.ok()) << file;
    scenario::run(scenario.value(), options);
  }
  EXPECT_GT(programs, 0u) << "run in the root of the repository";
  for (const std::string& surprise : surprises) ADD_FAILURE() << surprise;
}

INSTANTIATE_TEST_SUITE_P(Folders, CrossReferenceTruth,
                         testing::Values("examples", "tests/scenarios/gsk", "tests/scenarios/nct",
                                         "tests/scenarios/technol"));

} // namespace
} // namespace rung

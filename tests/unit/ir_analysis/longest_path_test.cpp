// The weight of the longest run: compared with all paths of small programs, one after the other.
#include "ir/analysis/longest_path.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "ir/analysis/rung_costs.h"
#include "tests/random/random.h"

namespace rung::ir {
namespace {

using Open = std::set<std::pair<uint32_t, uint32_t>>; // routine and rung

// From a rung to the end of its routine; nothing: control may go in loops.
std::optional<uint64_t> longestPath(const Module& module, RoutineId routine, uint32_t rung, Open& open) {
  const std::vector<Rung>& rungs = module.at(routine).rungs;
  if (rung >= rungs.size()) return 0;
  if (!open.insert({routine.index, rung}).second) return std::nullopt;
  const Transfer& transfer = rungs[rung].transfer;
  uint64_t most = 0;
  bool endless = false;
  const auto way = [&](uint32_t to, uint64_t before) {
    const std::optional<uint64_t> rest = longestPath(module, routine, to, open);
    endless = endless || !rest;
    most = std::max(most, before + rest.value_or(0));
  };
  if (transfer.kind == TransferKind::Next || transfer.cond.valid()) way(rung + 1, 0);
  if (transfer.kind == TransferKind::Goto) way(transfer.target, 0);
  for (const uint32_t target : transfer.targets) way(target, 0);
  if (transfer.kind == TransferKind::Call) {
    const std::optional<uint64_t> callee = longestPath(module, transfer.callee, 0, open);
    endless = endless || !callee;
    way(rung + 1, callee.value_or(0));
  }
  open.erase({routine.index, rung});
  if (endless) return std::nullopt;
  return most + std::max(1u, rungs[rung].weight);
}

TEST(LongestRun, IsThatOfAllWays) {
  uint32_t endless = 0;
  uint32_t bounded = 0;
  for (uint64_t seed = 0; seed < 400; ++seed) {
    SCOPED_TRACE(seed);
    Module module = randomModule(seed, {.rungs = 6, .ops = 4});
    for (Routine& routine : module.routines)
      for (size_t i = 0; i < routine.rungs.size(); ++i) routine.rungs[i].weight = 1 + static_cast<uint32_t>(i % 3);
    const Partition partition(module, {.maxChunkRungs = 2});
    for (uint32_t t = 0; t < module.tasks.size(); ++t) {
      Task& task = module.tasks[t];
      if (task.parts != 1) continue;
      Open open;
      const std::optional<uint64_t> expected = longestPath(module, task.entry, 0, open);
      endless += expected ? 0 : 1;
      bounded += expected ? 1 : 0;
      const LongestRun found = longestRun(partition, TaskId{t});
      EXPECT_EQ(found.loops, !expected.has_value());
      if (expected) EXPECT_EQ(found.weight, *expected);
      EXPECT_GT(found.weight, 0u);
      task.budget = 2;
      EXPECT_EQ(longestRun(partition, TaskId{t}).weight, std::min(found.weight, 2u));
    }
  }
  EXPECT_GT(bounded, 50u);
  EXPECT_GT(endless, 50u);
}

TEST(LongestRun, IsThatOfTheHeaviestPart) {
  for (uint64_t seed = 0; seed < 50; ++seed) {
    SCOPED_TRACE(seed);
    Module module = randomModule(seed, {.rungs = 40, .ops = 4, .jumps = false});
    Task& task = module.tasks[0];
    std::vector<Rung>& rungs = module.routines[task.entry.index].rungs;
    const auto count = static_cast<uint32_t>(rungs.size());
    for (uint32_t i = 0; i < count; ++i) rungs[i].weight = 1 + i * 7 % 5;
    for (Rung& rung : rungs) rung.transfer = {};
    task.parts = 3;
    task.borders = {count / 4, count / 2};
    if (count < 8) continue;
    uint64_t most = 0;
    for (const auto& [from, to] :
         {std::pair(0u, count / 4), std::pair(count / 4, count / 2), std::pair(count / 2, count)}) {
      uint64_t weight = 0;
      for (uint32_t i = from; i < to; ++i) weight += rungs[i].weight;
      most = std::max(most, weight);
    }
    EXPECT_EQ(longestRun(Partition(module, {.maxChunkRungs = 3}), TaskId{0}).weight, most);
  }
}

// Of all paths from each chunk of the task's routine on.
TEST(LoopFreeEndOfRuns, IsWhereTheLastLoopEnds) {
  uint32_t between = 0;
  for (uint64_t seed = 0; seed < 400; ++seed) {
    SCOPED_TRACE(seed);
    const Module module = randomModule(seed, {.rungs = 8, .ops = 4});
    const Partition partition(module, {.maxChunkRungs = 2});
    for (uint32_t t = 0; t < module.tasks.size(); ++t) {
      const Task& task = module.tasks[t];
      if (task.parts != 1) continue;
      LoopFreeEnd expected;
      uint64_t most = 0;
      for (auto c = static_cast<uint32_t>(partition.chunks().size()); c-- > 0;) {
        if (partition.chunks()[c].routine != task.entry) continue;
        Open open;
        const std::optional<uint64_t> way = longestPath(module, task.entry, partition.chunks()[c].firstRung, open);
        if (!way) break;
        most = std::max(most, *way);
        expected = {.chunk = c, .weight = static_cast<uint32_t>(most)};
      }
      const LoopFreeEnd found = longestRun(partition, TaskId{t}).loopFree;
      EXPECT_EQ(found.chunk, expected.chunk);
      EXPECT_EQ(found.weight, expected.weight);
      between += found.chunk != RUNG_PC_DONE && found.chunk != partition.entry(task.entry) ? 1 : 0;
    }
  }
  EXPECT_GT(between, 30u);
}

// Rungs of the routine where control may be next.
std::set<uint32_t> nextOf(const std::vector<Rung>& rungs, uint32_t rung) {
  const Transfer& transfer = rungs[rung].transfer;
  std::set<uint32_t> next(transfer.targets.begin(), transfer.targets.end());
  if (transfer.kind == TransferKind::Next || transfer.kind == TransferKind::Call || transfer.cond.valid())
    next.insert(rung + 1);
  if (transfer.kind == TransferKind::Goto) next.insert(transfer.target);
  next.erase(static_cast<uint32_t>(rungs.size()));
  return next;
}

Module weighted(uint64_t seed) {
  Module module = randomModule(seed, {.rungs = 8, .ops = 4});
  for (Routine& routine : module.routines)
    for (size_t i = 0; i < routine.rungs.size(); ++i) routine.rungs[i].weight = 1 + static_cast<uint32_t>(i % 3);
  return module;
}

TEST(LongestPath, IsAWayAndCostsWhatItSays) {
  uint32_t calls = 0;
  for (uint64_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    const Module module = weighted(seed);
    const Partition partition(module, {.maxChunkRungs = 2});
    const std::vector<uint64_t> weights = rungWeights(partition);
    for (uint32_t t = 0; t < module.tasks.size(); ++t) {
      const LongestPath path = longestPath(partition, TaskId{t}, weights);
      ASSERT_FALSE(path.routines.empty());
      EXPECT_EQ(path.routines[0].routine, module.tasks[t].entry);
      EXPECT_EQ(path.routines[0].cost, path.cost);
      EXPECT_EQ(path.routines[0].runs, 1u);
      std::map<uint32_t, uint64_t> runs{{path.routines[0].routine.index, 1}};
      std::map<uint32_t, uint64_t> costs;
      for (const RoutinePath& routine : path.routines) {
        costs[routine.routine.index] = routine.cost;
        EXPECT_EQ(routine.runs, runs[routine.routine.index]); // its callers come before it
        for (const RoutinePath::Call& call : routine.calls) runs[call.callee.index] += routine.runs;
        calls += static_cast<uint32_t>(routine.calls.size());
      }
      for (const RoutinePath& routine : path.routines) {
        const std::vector<Rung>& rungs = module.at(routine.routine).rungs;
        const uint32_t first = partition.rungNumber(routine.routine, 0);
        uint64_t cost = 0;
        for (size_t i = 0; i < routine.rungs.size(); ++i) {
          cost += weights[routine.rungs[i]];
          if (i > 0) EXPECT_TRUE(nextOf(rungs, routine.rungs[i - 1] - first).contains(routine.rungs[i] - first));
        }
        for (const RoutinePath::Call& call : routine.calls) cost += costs.at(call.callee.index);
        EXPECT_EQ(routine.cost, cost);
      }
    }
  }
  EXPECT_GT(calls, 20u);
}

// By its calls, its own first.
std::vector<RoutineId> reachedRoutines(const Module& module, TaskId task) {
  std::vector<RoutineId> reached{module.tasks[task.index].entry};
  for (size_t i = 0; i < reached.size(); ++i)
    for (const Rung& rung : module.at(reached[i]).rungs)
      if (rung.transfer.kind == TransferKind::Call && std::ranges::find(reached, rung.transfer.callee) == reached.end())
        reached.push_back(rung.transfer.callee);
  return reached;
}

TEST(LongestPath, NamesTheRungsOfLoops) {
  uint32_t found = 0;
  for (uint64_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    const Module module = weighted(seed);
    const Partition partition(module, {.maxChunkRungs = 3});
    for (uint32_t t = 0; t < module.tasks.size(); ++t) {
      if (module.tasks[t].parts != 1) continue;
      const LongestPath path = longestPath(partition, TaskId{t}, rungWeights(partition));
      std::map<uint32_t, size_t> loopOf;
      for (size_t c = 0; c < path.loops.size(); ++c)
        for (const uint32_t rung : path.loops[c]) EXPECT_TRUE(loopOf.emplace(rung, c).second);
      found += static_cast<uint32_t>(path.loops.size());
      for (const RoutineId routine : reachedRoutines(module, TaskId{t})) {
        const std::vector<Rung>& rungs = module.at(routine).rungs;
        const auto reachedFrom = [&](uint32_t rung) { // in at least one step
          std::set<uint32_t> reached = nextOf(rungs, rung);
          for (size_t before = 0; before != reached.size();) {
            before = reached.size();
            for (const uint32_t from : std::set(reached)) reached.merge(nextOf(rungs, from));
          }
          return reached;
        };
        std::set<uint32_t> ran = reachedFrom(0);
        ran.insert(0);
        for (const uint32_t rung : ran) {
          const uint32_t number = partition.rungNumber(routine, rung);
          EXPECT_EQ(reachedFrom(rung).contains(rung), loopOf.contains(number));
          for (const uint32_t other : ran)
            if (loopOf.contains(number) && reachedFrom(rung).contains(other) && reachedFrom(other).contains(rung))
              EXPECT_EQ(loopOf[number], loopOf[partition.rungNumber(routine, other)]);
        }
      }
    }
  }
  EXPECT_GT(found, 20u);
}

// The length of a routine is not limited by the stack.
TEST(LongestRun, OfManyRungs) {
  Module module = randomModule(1, {.rungs = 4, .jumps = false});
  std::vector<Rung>& rungs = module.routines[module.tasks[0].entry.index].rungs;
  rungs.resize(200'000, rungs[0]);
  for (Rung& rung : rungs) {
    rung.weight = 2;
    rung.transfer = {};
  }
  module.tasks[0].parts = 1;
  module.tasks[0].borders.clear();
  EXPECT_EQ(longestRun(Partition(module, {}), TaskId{0}).weight, 400'000u);
}

} // namespace
} // namespace rung::ir

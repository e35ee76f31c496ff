// What the rungs of a program did in a part of its schedule: the power at each element at the moment when it was
// evaluated, and every access to memory with its value. A rung may run several times, and each of its runs is there.
//
//   FlowEngine engine(compiled);                       // with CompileRequest::marks
//   runtime::Instance instance(engine.engine());       // takes the states of any engine of the program
//   engine.observe(instance, [&] { instance.scan(); });
//   for (const RungFlow& run : engine.flow().runs()) …
#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "compiler/compile.h"
#include "ir/interp/interp.h"
#include "rtlib/run/instance.h"
#include "tools/replay/elements.h"

namespace rung::replay {

enum class Power : uint8_t {
  NotReached, // a branch around it was not taken, or the rung stopped the program
  Off,
  On,
};

// A run of a task, or of a part of one.
struct TaskFlow {
  uint32_t task = 0;
  int64_t us = 0; // the clock
  uint32_t firstRun = 0, runCount = 0;
};

// A run of a rung of the module.
struct RungFlow {
  uint32_t lowered = 0; // the rung, over all routines as built
  bool faulted = false; // it stopped the program
  uint32_t firstPower = 0;
  uint32_t firstAccess = 0, accessCount = 0;
};

class Flow {
public:
  explicit Flow(const Elements& elements) : elements_(&elements) {}

  std::span<const TaskFlow> tasks() const { return tasks_; }
  std::span<const RungFlow> runs() const { return runs_; } // in the order in which they ran
  // By Elements::points of the rung.
  std::span<const Power> powers(const RungFlow& run) const {
    return std::span(powers_).subspan(run.firstPower, elements_->points(run.lowered).size());
  }
  // In their order.
  std::span<const ir::Access> accesses(const RungFlow& run) const {
    return std::span(accesses_).subspan(run.firstAccess, run.accessCount);
  }

  // By pin over all elements: the power when it was evaluated last; nothing where no rung with it has run.
  std::vector<std::optional<Power>> lastPowers() const;
  // By rung of the source: how often it has run. One that was lowered to several rungs has run as often as its first.
  std::vector<uint32_t> timesRun() const;

private:
  friend class FlowEngine;
  const Elements* elements_;
  std::vector<TaskFlow> tasks_;
  std::vector<RungFlow> runs_;
  std::vector<Power> powers_;
  std::vector<ir::Access> accesses_;
};

class FlowEngine {
public:
  // `compiled` has marks, and outlives this. A program of several instances is observed in one at a time.
  explicit FlowEngine(const compiler::Compiled& compiled);

  // The interpreter, with the rungs as their author wrote them: its program has the hashes, the memory and the chunks
  // of the compiled one.
  runtime::Engine& engine() { return engine_; }
  const Elements& elements() const { return elements_; }
  // The place of an access as a user knows it: for a latch that the compiler made, what it was copied from. Nothing for
  // state of the compiler, which has no name.
  std::optional<ir::BitRange> knownPlace(const ir::Access& access) const;
  // The value as scenarios and the prompt write it.
  std::string shownValue(const ir::Access& access) const;
  // As the front end built it.
  const ir::Rung& rung(uint32_t lowered) const { return *rungs_[lowered]; }

  // Observes the instance, which is of this engine, while `run` runs; its forces need no code of their own. The result
  // is valid until the next call. `afterRun` (or nothing) is called after each run of a rung, with its index in
  // Flow::runs and the rung's values (none after a fault): memory is as the rung left it.
  using AfterRun = std::function<void(size_t run, std::span<const uint64_t> values)>;
  const Flow& observe(runtime::Instance& instance, const std::function<void()>& run, const AfterRun& afterRun = {});
  // Of the last call.
  const Flow& flow() const { return flow_; }

private:
  class Watch;
  const ir::Uses& uses_;
  ir::Layout layout_;
  ir::InterpEngine engine_;
  Elements elements_;
  std::vector<const ir::Rung*> rungs_; // by number over all routines as built
  Flow flow_;
};

// The value that the accesses of a run say the place had: where it was read first, otherwise where it was written last.
// The place is of at most 64 bits. Nothing if no access was of all of it.
std::optional<uint64_t> valueOf(std::span<const ir::Access> accesses, const ir::BitRange& place);

} // namespace rung::replay

// Observes rungs (see flow.h).
#include "tools/replay/flow.h"

#include <algorithm>
#include <bit>
#include <memory>

#include "ir/support/check.h"
#include "tools/report/place_names.h"
#include "tools/scenario/values.h"

namespace rung::replay {

std::vector<std::optional<Power>> Flow::lastPowers() const {
  std::vector<std::optional<Power>> last(elements_->pinCount());
  for (const RungFlow& run : runs_) {
    const std::span<const Power> of = powers(run);
    for (size_t i = 0; i < of.size(); ++i) last[elements_->points(run.lowered)[i].pin] = of[i];
  }
  return last;
}

std::vector<uint32_t> Flow::timesRun() const {
  std::vector<uint32_t> times(elements_->rungs().size(), 0);
  for (const RungFlow& run : runs_) {
    const uint32_t rung = elements_->rungOf(run.lowered);
    if (rung != kNone && elements_->rungs()[rung].lowered[0] == run.lowered) ++times[rung];
  }
  return times;
}

// Fills the flow. As an observer of rungs it belongs to the engine, as a watch of tasks to the instance.
class FlowEngine::Watch final : public ir::RungObserver, public runtime::TaskWatch {
public:
  Watch(const Elements& elements, runtime::Instance& instance, Flow& flow, const AfterRun& afterRun)
      : elements_(elements), instance_(instance), flow_(flow), afterRun_(afterRun) {}

  void begins(const runtime::Instance& instance, uint32_t task) override {
    flow_.tasks_.push_back(
        {.task = task, .us = instance.nowUs(), .firstRun = static_cast<uint32_t>(flow_.runs_.size())});
  }
  void ended(const runtime::Instance&, uint32_t) override {
    TaskFlow& task = flow_.tasks_.back();
    task.runCount = static_cast<uint32_t>(flow_.runs_.size()) - task.firstRun;
  }

  // A forced bit that the operation has written has its value again before anything can read it.
  void accessed(const ir::Access& access) override {
    flow_.accesses_.push_back(access);
    if (access.writes) instance_.hold();
  }
  void rungRan(uint32_t lowered, std::span<const uint64_t> values) override {
    const auto end = static_cast<uint32_t>(flow_.accesses_.size());
    flow_.runs_.push_back({.lowered = lowered,
                           .faulted = false,
                           .firstPower = static_cast<uint32_t>(flow_.powers_.size()),
                           .firstAccess = firstAccess_,
                           .accessCount = end - firstAccess_});
    firstAccess_ = end;
    for (const Point& point : elements_.points(lowered)) flow_.powers_.push_back(powerOf(point, values));
    if (afterRun_) afterRun_(flow_.runs_.size() - 1, values);
  }

private:
  static Power powerOf(const Point& point, std::span<const uint64_t> values) {
    if (values.empty() || !report::reached(point.guards, values)) return Power::NotReached;
    return values[point.value] != 0 ? Power::On : Power::Off;
  }

  const Elements& elements_;
  runtime::Instance& instance_;
  Flow& flow_;
  const AfterRun& afterRun_;
  uint32_t firstAccess_ = 0; // of the run that has not ended
};

FlowEngine::FlowEngine(const compiler::Compiled& compiled)
    : uses_(*compiled.uses), layout_(compiled.layout->over(*compiled.shape)), engine_(layout_, compiled.codeHash),
      elements_(*compiled.shape, compiled.marks), rungs_(elements_.loweredCount()), flow_(elements_) {
  const std::vector<ir::Routine>& routines = compiled.shape->routines;
  for (uint32_t r = 0; r < routines.size(); ++r)
    for (uint32_t i = 0; i < routines[r].rungs.size(); ++i)
      rungs_[layout_.partition().rungNumber(ir::RoutineId{r}, i)] = &routines[r].rungs[i];
}

std::optional<ir::BitRange> FlowEngine::knownPlace(const ir::Access& access) const {
  if (access.slot.valid()) return std::nullopt;
  return report::knownPlace(engine_.program(), uses_, access.place);
}

std::string FlowEngine::shownValue(const ir::Access& access) const {
  const ir::Type type = rung(access.rung).ops[access.operation].type;
  if (type == ir::Type::F64) return scenario::show(scenario::realReading(std::bit_cast<double>(access.value)));
  return scenario::show({.kind = scenario::ValueKind::Int, .integer = access.value, .width = ir::bitWidth(type)});
}

const Flow& FlowEngine::observe(runtime::Instance& instance, const std::function<void()>& run,
                                const AfterRun& afterRun) {
  RUNG_CHECK(&instance.program() == &engine_.program(), "the instance is one of this engine");
  flow_ = Flow(elements_);
  auto watch = std::make_unique<Watch>(elements_, instance, flow_, afterRun);
  const bool faulted = instance.faulted();
  instance.setTaskWatch(watch.get());
  engine_.setObserver(std::move(watch));
  run();
  instance.setTaskWatch(nullptr);
  engine_.setObserver(nullptr);
  if (instance.faulted() && !faulted) {
    const auto last = std::find_if(flow_.runs_.rbegin(), flow_.runs_.rend(),
                                   [&](const RungFlow& rung) { return rung.lowered == instance.fault().rung; });
    if (last != flow_.runs_.rend()) last->faulted = true;
  }
  return flow_;
}

std::optional<uint64_t> valueOf(std::span<const ir::Access> accesses, const ir::BitRange& place) {
  std::optional<uint64_t> value;
  for (const ir::Access& access : accesses) {
    const ir::BitRange& of = access.place;
    const bool contains = !access.slot.valid() && of.space == place.space && of.first <= place.first &&
                          place.first + place.count <= of.first + of.count;
    if (!contains) continue;
    const uint64_t all = place.count >= 64 ? ~uint64_t{0} : (uint64_t{1} << place.count) - 1;
    value = (access.value >> (place.first - of.first)) & all;
    if (!access.writes) return value;
  }
  return value;
}

} // namespace rung::replay

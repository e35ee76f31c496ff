// See scan_thread.h.
#include "machine/rung-run/scan_thread.h"

#include <algorithm>
#include <bit>

namespace rung::rung_run {

std::string ScanThread::start() {
  std::promise<std::string> begun;
  std::future<std::string> problem = begun.get_future();
  thread_ = std::thread([this, begun = std::move(begun)]() mutable { run(std::move(begun)); });
  return problem.get();
}

void ScanThread::end() {
  beginEnd();
  if (thread_.joinable()) thread_.join();
}

void ScanThread::run(std::promise<std::string> begun) {
  const runtime::RealTimeThread realTime(options_.thread);
  begun.set_value(realTime.problem());
  if (!realTime.problem().empty()) return;
  runtime::runSteps(*this, options_.earlyNs);
  ended_ = true;
}

// Periods that have already passed are skipped: the next step runs everything that is due.
int64_t ScanThread::dueAfter(int64_t dueNs, int64_t nowNs) noexcept {
  const int64_t late = nowNs - dueNs;
  const int64_t passed = late > options_.periodNs ? late / options_.periodNs : 0;
  return dueNs + (passed + 1) * options_.periodNs;
}

void ScanThread::step(int64_t nowNs, int64_t elapsedNs) {
  connections_.readInputs(pins_.cells(), nowNs);
  if (!host_.restarting()) devices_.step(elapsedNs);
  host_.step(elapsedNs);
  connections_.writeOutputs(pins_.cells());
}

namespace {

constexpr auto kRelaxed = std::memory_order_relaxed;
constexpr size_t kParts = 4; // number of classes per power of two

// Only the scan thread writes, so no compare-and-exchange is needed.
void raise(std::atomic<int64_t>& most, int64_t value) noexcept {
  if (value > most.load(kRelaxed)) most.store(value, kRelaxed);
}

} // namespace

size_t StepTimes::classOf(int64_t ns) noexcept {
  const uint64_t value = ns <= 0 ? 0 : static_cast<uint64_t>(ns);
  if (value < kParts) return value;
  const auto power = static_cast<size_t>(std::bit_width(value)) - 1;
  return (power - 1) * kParts + (value >> (power - 2)) - kParts;
}

// The first value above a class.
int64_t StepTimes::endOf(size_t number) noexcept {
  if (number < kParts) return static_cast<int64_t>(number) + 1;
  const size_t power = number / kParts + 1;
  return static_cast<int64_t>((number % kParts + kParts + 1) << (power - 2));
}

void StepTimes::add(const Step& step, bool isOverrun) noexcept {
  steps_.fetch_add(1, kRelaxed);
  if (isOverrun) overruns_.fetch_add(1, kRelaxed);
  if (step.periodNs < shortest_.load(kRelaxed)) shortest_.store(step.periodNs, kRelaxed);
  raise(longest_, step.periodNs);
  raise(latest_, step.lateNs);
  sum_.fetch_add(step.tookNs, kRelaxed);
  last_.store(step.tookNs, kRelaxed);
  count(late_, step.lateNs);
  count(took_, step.tookNs);
  addWorst(step);
}

void StepTimes::addWorst(const Step& step) noexcept {
  int64_t took = step.tookNs, begin = step.beginNs;
  for (WorstStep& worst : worst_) {
    if (took <= worst.tookNs.load(kRelaxed)) continue;
    took = worst.tookNs.exchange(took, kRelaxed);
    begin = worst.beginNs.exchange(begin, kRelaxed);
  }
}

void StepTimes::count(Classes& classes, int64_t ns) noexcept {
  classes[std::min(classOf(ns), kClasses - 1)].fetch_add(1, kRelaxed);
}

int64_t StepTimes::quantileOf(const Classes& classes, uint64_t steps, double share, int64_t most) {
  const auto wanted = static_cast<uint64_t>(static_cast<double>(steps) * share);
  uint64_t sum = 0;
  for (size_t i = 0; i < kClasses; ++i) {
    sum += classes[i].load(kRelaxed);
    if (sum >= wanted) return std::min(endOf(i), most);
  }
  return most;
}

StepFigures StepTimes::figures() const {
  StepFigures now{.steps = steps_.load(kRelaxed), .overruns = overruns_.load(kRelaxed)};
  if (now.steps == 0) return now;
  now.shortestPeriodNs = shortest_.load(kRelaxed);
  now.longestPeriodNs = longest_.load(kRelaxed);
  now.latestNs = latest_.load(kRelaxed);
  now.late99Ns = quantileOf(late_, now.steps, 0.99, now.latestNs);
  now.late999Ns = quantileOf(late_, now.steps, 0.999, now.latestNs);
  now.lastNs = last_.load(kRelaxed);
  const int64_t longest = worst_[0].tookNs.load(kRelaxed);
  now.took50Ns = quantileOf(took_, now.steps, 0.5, longest);
  now.took99Ns = quantileOf(took_, now.steps, 0.99, longest);
  now.took999Ns = quantileOf(took_, now.steps, 0.999, longest);
  now.meanNs = sum_.load(kRelaxed) / static_cast<int64_t>(now.steps);
  for (const WorstStep& worst : worst_)
    if (const int64_t took = worst.tookNs.load(kRelaxed); took != 0)
      now.worst.push_back({took, worst.beginNs.load(kRelaxed)});
  return now;
}

} // namespace rung::rung_run

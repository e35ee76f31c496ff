// See scan_thread.h.
#include "tools/rung-run/scan_thread.h"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

namespace rung::rung_run {
namespace {

double microseconds(int64_t ns) { return static_cast<double>(ns) / 1e3; }

} // namespace

std::string ScanThread::start() {
  std::promise<std::string> begun;
  std::future<std::string> problem = begun.get_future();
  thread_ = std::thread([this, begun = std::move(begun)]() mutable { run(std::move(begun)); });
  return problem.get();
}

void ScanThread::end() {
  ending_ = true;
  if (thread_.joinable()) thread_.join();
}

void ScanThread::run(std::promise<std::string> begun) {
  const host::RealTimeThread realTime(options_.thread);
  begun.set_value(realTime.problem());
  if (!realTime.problem().empty()) return;
  int64_t last = host::monotonicNs();
  for (int64_t due = last + options_.periodNs; !ending_; due += options_.periodNs) {
    host::sleepUntil(due);
    step(due, last);
    // Periods that have passed meanwhile are over: the next step catches up what is due.
    const int64_t late = host::monotonicNs() - due;
    if (late > options_.periodNs) due += late / options_.periodNs * options_.periodNs;
  }
}

void ScanThread::step(int64_t due, int64_t& last) noexcept {
  const int64_t begin = host::monotonicNs();
  box_.step(begin - std::exchange(last, begin));
  const int64_t late = begin - due;
  const int64_t took = host::monotonicNs() - begin;
  steps_.fetch_add(1, std::memory_order_relaxed);
  if (late >= options_.periodNs) overruns_.fetch_add(1, std::memory_order_relaxed);
  lateNs_.store(std::max(late, lateNs_.load(std::memory_order_relaxed)), std::memory_order_relaxed);
  worstNs_.store(std::max(took, worstNs_.load(std::memory_order_relaxed)), std::memory_order_relaxed);
}

ScanFigures ScanThread::figures() const noexcept { return {steps_, overruns_, lateNs_, worstNs_}; }

std::string ScanThread::report() const {
  const ScanFigures now = figures();
  return fmt::format("{} steps, {} overruns, latest start {:.1f} us, longest step {:.1f} us", now.steps, now.overruns,
                     microseconds(now.lateNs), microseconds(now.worstNs));
}

} // namespace rung::rung_run

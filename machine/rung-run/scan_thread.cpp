// See scan_thread.h.
#include "machine/rung-run/scan_thread.h"

#include <utility>

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
  int64_t last = begunNs_ = runtime::monotonicNs();
  for (int64_t due = last + options_.periodNs; !(ending_ && box_.ends()); due += options_.periodNs) {
    waitFor(due);
    step(due, last);
    // Periods that have passed meanwhile are over: the next step catches up what is due.
    const int64_t late = runtime::monotonicNs() - due;
    if (late > options_.periodNs) due += late / options_.periodNs * options_.periodNs;
  }
  ended_ = true;
}

// A step counts from when it is due, however long before that the thread is awake.
void ScanThread::waitFor(int64_t due) const noexcept {
  runtime::sleepUntil(due - options_.earlyNs);
  if (options_.earlyNs == 0) return;
  box_.touch(due);
  runtime::waitAwake(due);
}

void ScanThread::step(int64_t due, int64_t& last) noexcept {
  const int64_t begin = runtime::monotonicNs();
  const int64_t period = begin - std::exchange(last, begin);
  connections_.readInputs(pins_.cells(), begin);
  if (!box_.restarting()) devices_.step(period);
  box_.step(period);
  connections_.writeOutputs(pins_.cells());
  const int64_t late = begin - due;
  times_.add(
      {.beginNs = begin - begunNs_, .periodNs = period, .lateNs = late, .tookNs = runtime::monotonicNs() - begin},
      late >= options_.periodNs);
}

} // namespace rung::rung_run

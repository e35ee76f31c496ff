// See model.h.
#include "tests/replace/model.h"

#include <algorithm>

#include "tests/replace/programs.h"

namespace rung::test {

uint32_t Model::writable() { return kKept + kLatches; }

uint32_t Model::timers() { return kTimers; }

int64_t Model::fitting(uint32_t cell, uint32_t random) {
  return cell < kKept ? static_cast<int32_t>(random) : static_cast<int64_t>(random % 2);
}

std::vector<std::string> Model::names() {
  std::vector<std::string> names;
  const auto add = [&](const char* name, uint32_t count) {
    for (uint32_t i = 0; i < count; ++i) names.push_back(name + std::to_string(i));
  };
  add("KEEP", kKept);
  add("LATCH", kLatches);
  names.push_back("SCANS");
  add("COUNT", kCounters);
  add("RING", kRings);
  add("TIME", kTimers);
  add("TICKS", kTimers);
  return names;
}

std::vector<int64_t> Model::values() const {
  std::vector<int64_t> values = written_;
  const int64_t edges = (scans_ + 1) / 2; // of the bit that toggles, from the first scan on
  values.push_back(scans_);
  values.insert(values.end(), kCounters, edges);
  for (uint32_t i = 0; i < kRings; ++i) values.push_back(edges % (ringEnd(i) + 1));
  for (const Timer& timer : timers_) values.push_back(timer.leftMs);
  for (const Timer& timer : timers_) values.push_back(timer.ticks);
  return values;
}

// An on-delay whose own output switches it off for one scan.
void Model::scan(int64_t nowUs) {
  ++scans_;
  for (uint32_t i = 0; i < timers_.size(); ++i) {
    Timer& timer = timers_[i];
    const bool input = !timer.over;
    const bool counts = input && timer.active;
    timer.active = input;
    const int64_t passedMs = counts ? (nowUs - timer.sinceUs) / 1000 : 0;
    timer.sinceUs = counts ? timer.sinceUs + 1000 * passedMs : nowUs;
    timer.leftMs = counts ? std::max<int64_t>(timer.leftMs - passedMs, 0) : timerMs(i);
    timer.over = input && timer.leftMs == 0;
    if (timer.over) ++timer.ticks;
  }
}

} // namespace rung::test

// Alarms of the simulated CNC. The manual has no alarm list; numbers it does not name are the model's own (900 and up).
#pragma once
#include <algorithm>
#include <cstdint>
#include <vector>

namespace rung::sim::gsk {

inline constexpr uint32_t kAlarmPlcAxis = 311;       // l.7817
inline constexpr uint32_t kAlarmNoFeed = 901;        // a cutting block without F
inline constexpr uint32_t kAlarmNotReferenced = 902; // G28, G30 or a PLC command 7-10 before zero return, l.7787
inline constexpr uint32_t kAlarmOverTravel = 910;    // + axis (1-8); negative direction 920 + axis

class Alarms {
public:
  Alarms() { active_.reserve(32); } // all that the CNC raises on its own
  void raise(uint32_t number) {
    if (std::ranges::find(active_, number) == active_.end()) active_.push_back(number);
  }
  void clear() { active_.clear(); }
  bool any() const { return !active_.empty(); }
  uint32_t last() const { return active_.empty() ? 0 : active_.back(); }

private:
  std::vector<uint32_t> active_;
};

} // namespace rung::sim::gsk

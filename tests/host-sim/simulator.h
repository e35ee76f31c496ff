// What happens to a simulated host, in an order that a seed decides, and whether the host is right after each of it.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "tests/host-sim/programs.h"

namespace rung::host_sim {

struct Event {
  std::string what;
  std::string name; // of a pin, a cell or a program
  int64_t value = 0;
};

std::string textOf(const Event& event);
std::vector<Event> eventsOf(uint64_t seed, size_t count);

// "" or what was wrong after which event.
std::string run(const Programs& programs, const std::vector<Event>& events);
// The fewest events found that still go wrong.
std::vector<Event> minimised(const Programs& programs, std::vector<Event> events);

} // namespace rung::host_sim

// Whether two instances of one program, run by different engines, are in the same state: memory, clock, fault, messages
// that wait, service requests and tickets. Profile counters do not count.
#pragma once
#include <optional>
#include <string>

#include "rtlib/host/instance.h"

namespace rung::host {

// The first difference, with the place named ("D10 (COUNT): 3 here, 4 there"); nothing when there is none. Layouts may
// differ; then only the spaces are compared, not the compiler's own slots.
std::optional<std::string> firstDifference(const Instance& here, const Instance& there);

} // namespace rung::host

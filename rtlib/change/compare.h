// Whether two instances of one program, run by different engines, are in the same state: memory, clock, fault, messages
// that wait, service requests and tickets. Profile counters do not count.
#pragma once
#include <optional>
#include <string>

#include "rtlib/run/instance.h"

namespace rung::runtime {

// How a reader would write a bit, or the byte that an integer of 8 bits lies in.
using DescribePlace = std::string (*)(const rung_program& program, const Ref& place);

// The first difference, with the place described ("D10 (COUNT): 3 here, 4 there"); nothing when there is none. Layouts
// may differ; then only the spaces are compared, not the compiler's own slots.
std::optional<std::string> firstDifference(const Instance& here, const Instance& there, DescribePlace describe);

} // namespace rung::runtime

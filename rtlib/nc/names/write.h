// Writing to a program between two scans, with a text for the person who asked for it.
#pragma once
#include <string>
#include <string_view>

#include "rtlib/host/instance.h"

namespace rung::nc {

// Each gives "", or why the program would never see the value, which is not written then, and where to write it: an
// input that is copied from another place before each run. (A control writes what it likes with host::writeRaw.)
[[nodiscard]] std::string write(host::Instance& instance, const host::Ref& ref, uint64_t value);
[[nodiscard]] std::string writeReal(host::Instance& instance, const host::Ref& ref, double value);
[[nodiscard]] std::string writeText(host::Instance& instance, const host::Ref& ref, std::string_view text);

} // namespace rung::nc

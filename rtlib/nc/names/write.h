// Writing to a program between two scans, with a text for the person who asked for it.
#pragma once
#include <string>
#include <string_view>

#include "rtlib/run/instance.h"

namespace rung::nc {

// Each gives "", or why the program would never see the value, which is not written then, and where to write it: an
// input that is copied from another place before each run. (A control writes what it likes with runtime::writeRaw.)
[[nodiscard]] std::string write(runtime::Instance& instance, const runtime::Ref& ref, uint64_t value);
[[nodiscard]] std::string writeReal(runtime::Instance& instance, const runtime::Ref& ref, double value);
[[nodiscard]] std::string writeText(runtime::Instance& instance, const runtime::Ref& ref, std::string_view text);

} // namespace rung::nc

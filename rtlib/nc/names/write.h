// Writes to a program between two scans, with a text for the user if that fails.
#pragma once
#include <string>
#include <string_view>

#include "rtlib/run/instance.h"

namespace rung::nc {

// Each returns "", or why the program would never see the value and where to write it, and then writes nothing: the
// place is an input that is copied from another place before each run. (Controls write without this check by
// runtime::writeRaw.)
[[nodiscard]] std::string write(runtime::Instance& instance, const runtime::Ref& ref, uint64_t value);
[[nodiscard]] std::string writeReal(runtime::Instance& instance, const runtime::Ref& ref, double value);
[[nodiscard]] std::string writeText(runtime::Instance& instance, const runtime::Ref& ref, std::string_view text);

} // namespace rung::nc

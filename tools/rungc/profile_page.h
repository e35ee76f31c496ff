// A profile on the drawing of its program; where the dialect has no drawings, as a table.
#pragma once
#include <string>

#include "ir/support/result.h"
#include "tools/scenario/profiler.h"

namespace rung::rungc {

// The page, of the program that the request's scenarios run. Fails when it cannot be read any more.
Result<std::string> profilePage(const report::Profile& profile, const scenario::ProfileRequest& request);

} // namespace rung::rungc

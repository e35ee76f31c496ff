// A recording as a scenario: what the machine and its control wrote, by name, scan by scan, and the outputs at the end.
// Another version of the program can run it.
#pragma once
#include <cstdint>
#include <string>

#include "ir/support/result.h"
#include "tools/replay/past.h"

namespace rung::replay {

// Scans `from` + 1 to `to` as the text of a scenario for a file of this path, which begins cold: `from` should be the
// beginning of the recording. If no project is in the folder of the path, it names the sources of the program. The
// past is at `to` afterwards. A program that stops with a fault makes the scenario fail with it.
Result<std::string> scenarioOf(Past& past, const std::string& path, uint64_t from, uint64_t to);

} // namespace rung::replay

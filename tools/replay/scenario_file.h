// A recording as a scenario: what the machine, its control and people wrote, by name, scan by scan, and the outputs at
// the end. Another version of the program can run it.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "ir/support/result.h"
#include "tools/replay/past.h"

namespace rung::replay {

struct ScenarioText {
  std::string text;
  std::string fault;              // with which the program stops at its end, without the place; "": it runs
  std::vector<std::string> lacks; // what happened and cannot be written as a scenario, a sentence each
};

// Scans `from` + 1 to `to` for a scenario file of this path, which begins cold: `from` must be where the recording
// begins, or the program was started. If no project is in the folder of the path, it names the sources of the program.
// The past is at `to` afterwards. A program that stops with a fault makes the scenario fail with it. Fails where no
// scenario can do the same: where events are missing, or another program or state takes over.
Result<ScenarioText> scenarioOf(Past& past, const std::string& path, uint64_t from, uint64_t to);

} // namespace rung::replay

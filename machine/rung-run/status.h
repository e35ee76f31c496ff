// The status of rung-run: the figures of its scan thread and of its connections.
#pragma once
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "machine/io/connections/connections.h"
#include "machine/rung-run/scan_thread.h"

namespace rung::rung_run {

// Text for users, at the end of the process.
std::vector<std::string> report(const StepFigures& steps, const std::vector<io::Figures>& connections);
// "clock" and "connections" of the answer to rungctl's `status` (docs/control-protocol.md).
void addStatus(nlohmann::json& status, int64_t periodNs, const StepFigures& steps,
               const std::vector<io::Figures>& connections);

} // namespace rung::rung_run

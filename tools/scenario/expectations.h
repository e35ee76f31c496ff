// The statements that check values, messages, the log and the fault of one run. Each function returns "" or what is
// wrong.
#pragma once
#include <string>

#include "tools/scenario/engine_run.h"
#include "tools/scenario/scenario.h"

namespace rung::scenario {

std::string setValue(EngineRun& run, const Statement& s);
std::string expectValue(const EngineRun& run, const Statement& s);
std::string expectRange(const EngineRun& run, const Statement& s);
std::string expectMessage(const EngineRun& run, const Statement& s);
std::string expectLog(EngineRun& run, const Statement& s);
std::string expectFault(const EngineRun& run, const Statement& s);

} // namespace rung::scenario

// Names of a scenario in a running program: what they hold, and what was meant by one that does not exist.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "ir/support/result.h"
#include "tools/scenario/values.h"

namespace rung::scenario {

// A variable, a cell or a quantity of the NC. `wantReal`: two words or eight bytes are read as one double.
Result<Reading> readName(const host::Instance& instance, const nc::NcModel& nc, std::string_view name, bool wantReal);

// The message about a name that does not exist, with the one that may be meant.
std::string unknownName(const host::Instance& instance, std::string_view name);

// Of all statements that read or write a value, but for quantities of the NC; the program has been started.
std::vector<Problem> unknownNames(const Scenario& scenario, const host::Instance& instance, const nc::NcModel& nc);

// "30.000 ms, scan 3: VALVE = 1, a text": a print statement.
Result<std::string> printedLine(const Statement& print, const host::Instance& instance, const nc::NcModel& nc,
                                uint64_t scans);

} // namespace rung::scenario

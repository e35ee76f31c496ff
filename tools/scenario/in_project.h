// A scenario without a `program` statement belongs to the project that its file lies in.
#pragma once
#include "tools/scenario/scenario.h"

namespace rung::scenario {

// Puts the files, the dialect and the configuration of the project before the statements; what the scenario itself
// configures stays. False, and nothing happens, where a program is named or where there is no project. A project file
// with mistakes is a problem of the scenario.
bool takeProject(Scenario& scenario);

} // namespace rung::scenario

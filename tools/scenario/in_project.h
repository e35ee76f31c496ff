// A scenario without a `program` statement uses the project that contains its file.
#pragma once
#include "tools/scenario/scenario.h"

namespace rung::scenario {

// Inserts the files, the dialect and the configuration of the project before the statements; the scenario's own
// configuration takes precedence. Returns false and changes nothing if the scenario names a program or there is no
// project. Mistakes in the project file become problems of the scenario.
bool takeProject(Scenario& scenario);

} // namespace rung::scenario

// What the rungs of a running program have cost, of one that was built with --profile.
#pragma once
#include <nlohmann/json_fwd.hpp>

#include "tools/plc/box.h"

namespace rung::remote {

// The answer to `profile` (docs/control-protocol.md). Throws Refused, also where the program does not count its rungs.
nlohmann::json profileOf(plc::Box& box, const nlohmann::json& request);

} // namespace rung::remote

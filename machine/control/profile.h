// What the rungs of a running program have cost, of one that was built with --profile.
#pragma once
#include <nlohmann/json_fwd.hpp>

#include "machine/host/plc_host.h"

namespace rung::control {

// The answer to `profile` (docs/control-protocol.md). Throws Refused, also where the program does not count its rungs.
nlohmann::json profileOf(host::PlcHost& plc, const nlohmann::json& request);

} // namespace rung::control

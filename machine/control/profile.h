// The profile of a running program that was built with --profile: what its rungs have cost.
#pragma once
#include <nlohmann/json_fwd.hpp>

#include "machine/host/plc_host.h"

namespace rung::control {

// The answer to `profile` (docs/control-protocol.md). Throws Refused, for example if the program does not count its
// rungs.
nlohmann::json profileOf(host::PlcHost& plc, const nlohmann::json& request);

} // namespace rung::control

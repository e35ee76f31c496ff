// See config.h.
#include "frontend/dialects/gsk/config.h"

#include "ir/support/diag/operand.h"
#include "rtlib/nc/config_key.h"

namespace rung::frontend::gsk {

Machine configuredMachine(const frontend::CompileOptions& options, Diagnostics& diagnostics) {
  const auto at = options.config.find("machine");
  if (at == options.config.end()) return Machine::Any;
  if (at->second == "mill") return Machine::Mill;
  if (at->second == "turn") return Machine::Turn;
  diagnostics.report(diag::ConstantOutOfRange, options.placeOf("machine"))
      << "machine " + at->second << nc::takesOf(*nc::findConfigKey(nc::gskConfigKeys(), "machine"));
  return Machine::Any;
}

} // namespace rung::frontend::gsk

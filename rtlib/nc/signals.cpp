// The signals of a dialect's control (see signals.h).
#include "rtlib/nc/signals.h"

#include "rtlib/nc/gsk/signals.h"
#include "rtlib/nc/nct/signals.h"
#include "rtlib/nc/technol/signals.h"

namespace rung::nc {

const SignalTable* signalsOf(std::string_view dialect) {
  if (dialect == "gsk") return &gskSignals();
  if (dialect == "nct") return &nctSignals();
  if (dialect == "technol") return &technolSignals();
  return nullptr;
}

} // namespace rung::nc

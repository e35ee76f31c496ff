// What the files of Operation share.
#pragma once
#include "tools/sim/gsk/operation.h"

namespace rung::nc::gsk {

struct Operation::Run {
  const SignalsIo& io;
  Machine& machine;
};

} // namespace rung::nc::gsk

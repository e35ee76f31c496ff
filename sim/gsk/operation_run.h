// What the files of Operation share.
#pragma once
#include "sim/gsk/operation.h"

namespace rung::sim::gsk {

struct Operation::Run {
  const nc::gsk::SignalsIo& io;
  Machine& machine;
};

} // namespace rung::sim::gsk

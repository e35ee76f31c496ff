// The kinds of the services that programs of the family request from their CNC, and that their control requests for
// them. The texts, with arguments and results, are the dialect's (DIALECT/services.h).
#pragma once
#include <cstdint>

namespace rung::nc::pmc {

enum class ServiceKind : uint8_t {
  Unknown,
  ReadWindow,
  WriteWindow,
  // A command of PMC axis control: axis from 0, command and data as in the block. It is answered when the axis has
  // executed it.
  MoveAxis,
};

} // namespace rung::nc::pmc

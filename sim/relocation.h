// What a machine has kept of a program's places and requests, in another program that has taken its place.
#pragma once
#include <cstdint>

#include "rtlib/change/relocation.h"
#include "rtlib/core/queues.h"

namespace rung::sim {

class Relocation : public runtime::Relocation {
public:
  using runtime::Relocation::Relocation;

  // RUNG_NONE: the other program does not ask for this service.
  uint32_t service(uint32_t number) const;
  // A request that has been taken and is not yet answered: its service, and where its operand block lies. The service
  // is RUNG_NONE afterwards where the other program does not wait for the answer.
  void renumber(core::ServiceRequest& request) const;
};

} // namespace rung::sim

// What a machine has kept of a program's places and numbers, in another program that has taken its place: places whose
// addresses the compiler gives out are found again by the symbol that they lie in, all others by their address.
#pragma once
#include <cstdint>
#include <optional>

#include "rtlib/core/queues.h"
#include "rtlib/host/ref.h"

namespace rung::sim {

class Relocation {
public:
  // Both outlive it.
  Relocation(const rung_program& from, const rung_program& to) : from_(&from), to_(&to) {}

  // Nothing: the other program has no such place, or a cell of another type there. The first symbol that the whole
  // place lies in counts.
  std::optional<host::Ref> place(const host::Ref& place) const;
  // RUNG_NONE: the other program does not ask for this service.
  uint32_t service(uint32_t number) const;
  // A request that has been taken and is not yet answered: its service, and where its operand block lies. The service
  // is RUNG_NONE afterwards where the other program does not wait for the answer.
  void renumber(rt::ServiceRequest& request) const;

private:
  std::optional<host::Ref> bySymbol(const host::Ref& place) const;

  const rung_program* from_;
  const rung_program* to_;
};

} // namespace rung::sim

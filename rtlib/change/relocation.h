// Where another program has what lies at a place of the one that it replaces: places whose addresses the compiler gives
// out are found again by the symbol that they lie in, all others by their address.
#pragma once
#include <optional>

#include "rtlib/load/ref.h"
#include "rung/program.h"

namespace rung::runtime {

class Relocation {
public:
  // Both outlive it.
  Relocation(const rung_program& from, const rung_program& to) : from_(&from), to_(&to) {}

  // Nothing: the other program has no such place, or a cell of another type there. The first symbol that the whole
  // place lies in counts. Looks at each symbol; allocates nothing.
  std::optional<Ref> place(const Ref& place) const noexcept;

protected:
  const rung_program* from_;
  const rung_program* to_;

private:
  std::optional<Ref> bySymbol(const Ref& place) const noexcept;
};

} // namespace rung::runtime

// Finds a place of one program in the program that replaces it: places whose addresses the compiler assigns are found
// by the symbol that contains them, all others by their address.
#pragma once
#include <optional>

#include "rtlib/load/ref.h"
#include "rung/program.h"

namespace rung::runtime {

class Relocation {
public:
  // Both programs outlive this object.
  Relocation(const rung_program& from, const rung_program& to) : from_(&from), to_(&to) {}

  // The place in the other program; nothing if it has no such place, or a cell of another type there. The first symbol
  // that contains the whole place decides. Takes time in proportion to the number of symbols; allocates nothing.
  std::optional<Ref> place(const Ref& place) const noexcept;

protected:
  const rung_program* from_;
  const rung_program* to_;

private:
  std::optional<Ref> bySymbol(const Ref& place) const noexcept;
};

} // namespace rung::runtime

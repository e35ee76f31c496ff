// What a dialect says about names: how its users write a place without a name, and when two names are the same.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "rtlib/load/ref.h"
#include "rung/program.h"

namespace rung::runtime {

// Names a place that has no name of its own, as users of the program's dialect would.
using PlaceName = std::string (*)(const rung_program& program, const Ref& place);
// "Y+3", "Y+3.5".
std::string plainPlaceName(const rung_program& program, const Ref& place);

struct Naming {
  PlaceName nameOf = plainPlaceName;
  bool ignoresCase = false; // Lamp and LAMP are one name
};

// The symbols of a program by name, for many look-ups. The program outlives it.
class SymbolsByName {
public:
  SymbolsByName(const rung_program& program, const Naming& naming);
  // Null if there is none.
  const rung_symbol* find(std::string_view name) const;

private:
  const rung_program* program_;
  std::vector<const rung_symbol*> sorted_; // without regard to case; empty if case counts
};

} // namespace rung::runtime

// The places that a program's rungs use, as a person would list them.
#pragma once
#include <vector>

#include "ir/analysis/uses.h"
#include "rung/program.h"

namespace rung::report {

struct UsedPlace {
  ir::Use use; // one of them
  bool read = false;
  bool written = false;
};

// At fixed addresses, each once and in their order; what a latch holds counts as a use of what it was copied from.
std::vector<UsedPlace> usedPlaces(const rung_program& program, const ir::Uses& uses);

// Bits of places, to ask of others whether they share one.
class PlaceSet {
public:
  explicit PlaceSet(std::vector<ir::BitRange> places);
  bool meets(const ir::BitRange& place) const;

private:
  std::vector<ir::BitRange> places_; // ascending, none touches the next
};
PlaceSet writtenPlaces(const std::vector<UsedPlace>& places);

} // namespace rung::report

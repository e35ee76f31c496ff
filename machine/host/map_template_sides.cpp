// See sides.h.
#include "machine/host/map_template_sides.h"

#include <optional>

#include "rtlib/nc/signals.h"
#include "rung/runtime.hpp"
#include "rung/types.hpp"

namespace rung::host {

Bits bitsOf(const rung_cell_info& info) {
  const uint64_t first = uint64_t{8} * info.byte + info.bit;
  return {info.space, first, first + uint64_t{elementBits(info.type)} * info.count};
}

namespace {

uint32_t sideOf(nc::Direction direction) {
  switch (direction) {
  case nc::Direction::In: return RUNG_SPACE_INPUT;
  case nc::Direction::Out: return RUNG_SPACE_OUTPUT;
  case nc::Direction::InOut: break;
  }
  return RUNG_SPACE_INPUT | RUNG_SPACE_OUTPUT;
}

} // namespace

Sides::Sides(rung_instance* instance, const rung_program& program) : program_(program) {
  const nc::SignalTable* table = nc::signalsOf(program.dialect);
  if (table == nullptr) return;
  for (const nc::Signal& signal : *table) {
    if (const std::optional<rung_cell_info> info = cellInfo(instance, signal.symbol, RUNG_READ))
      signals_.push_back({bitsOf(*info), sideOf(signal.direction)});
  }
}

uint32_t Sides::of(const rung_cell_info& info) const {
  const Bits bits = bitsOf(info);
  for (const SignalPlace& place : signals_)
    if (place.bits.space == bits.space && place.bits.first <= bits.first && bits.first < place.bits.end)
      return place.side;
  return program_.spaces[info.space].flags & (RUNG_SPACE_INPUT | RUNG_SPACE_OUTPUT);
}

} // namespace rung::host

// Places in another program (see relocation.h).
#include "rtlib/change/relocation.h"

#include <span>

#include "rtlib/load/program_info.h"
#include "rung/types.hpp"

namespace rung::runtime {
namespace {

struct Bits {
  uint32_t first = 0; // in the space
  uint32_t count = 0;
};

Bits bitsOf(const Ref& place) {
  const uint32_t bit = place.kind == RefKind::Bit ? place.bit : 0;
  return {8 * place.byte + bit, place.width * place.count};
}

Bits bitsOf(const rung_symbol& symbol) {
  return {8 * symbol.byte + symbol.bit, elementBits(symbol.type) * symbol.count};
}

bool contains(const Bits& outer, const Bits& inner) {
  return inner.first >= outer.first && inner.first + inner.count <= outer.first + outer.count;
}

bool hasPlace(const rung_symbol& symbol) { return (symbol.flags & RUNG_SYMBOL_CONST) == 0; }

} // namespace

std::optional<Ref> Relocation::place(const Ref& place) const noexcept {
  if (place.kind == RefKind::Constant || place.space >= from_->space_count) return std::nullopt;
  const rung_space& space = from_->spaces[place.space];
  if ((space.flags & RUNG_SPACE_ALLOCATED) != 0) return bySymbol(place);
  Ref found = place;
  found.space = findSpace(*to_, space.name);
  if (found.space == RUNG_NONE) return std::nullopt;
  const Bits whole{0, 8 * to_->spaces[found.space].byte_count};
  return contains(whole, bitsOf(place)) ? std::optional(found) : std::nullopt;
}

std::optional<Ref> Relocation::bySymbol(const Ref& place) const noexcept {
  for (const rung_symbol& former : std::span(from_->symbols, from_->symbol_count)) {
    if (!hasPlace(former) || former.space != place.space || !contains(bitsOf(former), bitsOf(place))) continue;
    const rung_symbol* now = findSymbol(*to_, former.name);
    if (now == nullptr || !hasPlace(*now) || now->type != former.type) continue;
    const Bits moved{bitsOf(*now).first + bitsOf(place).first - bitsOf(former).first, bitsOf(place).count};
    if (!contains(bitsOf(*now), moved)) continue;
    Ref found = place;
    found.space = now->space;
    found.byte = moved.first / 8;
    if (place.kind == RefKind::Bit) found.bit = static_cast<uint8_t>(moved.first % 8);
    return found;
  }
  return std::nullopt;
}

} // namespace rung::runtime

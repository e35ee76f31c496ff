// Places in another program (see relocation.h).
#include "tools/sim/relocation.h"

#include <span>

#include "rtlib/host/program_info.h"
#include "rtlib/nc/nct/operand_block.h"
#include "rung/types.hpp"

namespace rung::sim {
namespace {

struct Bits {
  uint32_t first = 0; // in the space
  uint32_t count = 0;
};

Bits bitsOf(const host::Ref& place) {
  const uint32_t bit = place.kind == host::RefKind::Bit ? place.bit : 0;
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

std::optional<host::Ref> Relocation::place(const host::Ref& place) const {
  if (place.kind == host::RefKind::Constant || place.space >= from_->space_count) return std::nullopt;
  const rung_space& space = from_->spaces[place.space];
  if ((space.flags & RUNG_SPACE_ALLOCATED) != 0) return bySymbol(place);
  host::Ref found = place;
  found.space = host::findSpace(*to_, space.name);
  if (found.space == RUNG_NONE) return std::nullopt;
  const Bits whole{0, 8 * to_->spaces[found.space].byte_count};
  return contains(whole, bitsOf(place)) ? std::optional(found) : std::nullopt;
}

std::optional<host::Ref> Relocation::bySymbol(const host::Ref& place) const {
  for (const rung_symbol& former : std::span(from_->symbols, from_->symbol_count)) {
    if (!hasPlace(former) || former.space != place.space || !contains(bitsOf(former), bitsOf(place))) continue;
    const rung_symbol* now = host::findSymbol(*to_, former.name);
    if (now == nullptr || !hasPlace(*now) || now->type != former.type) continue;
    const Bits moved{bitsOf(*now).first + bitsOf(place).first - bitsOf(former).first, bitsOf(place).count};
    if (!contains(bitsOf(*now), moved)) continue;
    host::Ref found = place;
    found.space = now->space;
    found.byte = moved.first / 8;
    if (place.kind == host::RefKind::Bit) found.bit = static_cast<uint8_t>(moved.first % 8);
    return found;
  }
  return std::nullopt;
}

uint32_t Relocation::service(uint32_t number) const {
  return number < from_->service_count ? host::findService(*to_, host::serviceName(*from_, number)) : RUNG_NONE;
}

namespace {

// Of "MR function address block -> code": 2. Nothing where the service has no operand block.
std::optional<uint32_t> blockArgument(std::string_view signature) {
  signature = signature.substr(0, signature.find("->"));
  uint32_t index = 0;
  for (size_t at = signature.find(' '); at != std::string_view::npos; ++index) {
    const size_t end = signature.find(' ', at + 1);
    if (signature.substr(at + 1, end - at - 1) == "block") return index;
    at = end;
  }
  return std::nullopt;
}

} // namespace

void Relocation::renumber(rt::ServiceRequest& request) const {
  const auto block = blockArgument(host::serviceName(*from_, request.service));
  request.service = service(request.service);
  if (!block || request.service == RUNG_NONE) return;
  int64_t& first = request.args[*block]; // a word of the space
  const auto moved =
      place(host::intRef(host::findSpace(*from_, nc::nct::kBlockSpace), 4 * static_cast<uint32_t>(first), 32));
  if (moved)
    first = moved->byte / 4;
  else
    request.service = RUNG_NONE;
}

} // namespace rung::sim

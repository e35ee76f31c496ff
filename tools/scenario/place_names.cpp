// Names of places (see place_names.h).
#include "tools/scenario/place_names.h"

#include <fmt/format.h>

namespace rung::scenario {

using host::Ref;
using host::RefKind;

namespace {

// Names of places in these areas are symbols only.
bool hasAddresses(const rung_program& program) { return std::string_view(program.dialect) != "technol"; }

std::string described(const rung_program& program, const Ref& place) {
  return place.kind == RefKind::Bit ? host::describeBit(program, place.space, place.byte, place.bit)
                                    : host::describeByte(program, place.space, place.byte);
}

// The address alone.
std::string address(const rung_program& program, const Ref& place) {
  const std::string text = described(program, place);
  return text.substr(0, text.find(" ("));
}

} // namespace

Ref refOf(const ir::Use& use) {
  const uint32_t byte = use.place.first / 8;
  if (use.type == ir::Type::Bit) return host::bitRef(use.place.space.index, byte, use.place.first % 8);
  if (use.type == ir::Type::F64) return host::realRef(use.place.space.index, byte);
  return host::intRef(use.place.space.index, byte, ir::bitWidth(use.type));
}

ir::BitRange bitsOf(const Ref& place) {
  if (place.kind == RefKind::Bit) return {ir::SpaceId{place.space}, place.byte * 8 + place.bit, place.count};
  if (place.kind == RefKind::Constant) return {ir::SpaceId{place.space}, 0, 0};
  return {ir::SpaceId{place.space}, place.byte * 8, place.width * place.count};
}

std::string symbolAt(const rung_program& program, const Ref& place) {
  for (uint32_t i = 0; i < program.symbol_count; ++i) {
    const rung_symbol& symbol = program.symbols[i];
    if ((symbol.flags & (RUNG_SYMBOL_CONST | RUNG_SYMBOL_HIDDEN)) != 0) continue;
    if (bitsOf(host::refOf(symbol)) == bitsOf(place)) return symbol.name;
  }
  return {};
}

std::string shownName(const rung_program& program, const Ref& place) {
  const std::string symbol = symbolAt(program, place);
  if (symbol.empty()) return described(program, place);
  return hasAddresses(program) ? fmt::format("{} ({})", symbol, address(program, place)) : symbol;
}

std::string shownRange(const rung_program& program, const ir::BitRange& range) {
  const Ref first = host::intRef(range.space.index, range.first / 8, 8);
  const Ref last = host::intRef(range.space.index, (range.first + range.count - 1) / 8, 8);
  return fmt::format("one of {} to {}", described(program, first), described(program, last));
}

std::string writtenName(const rung_program& program, const Ref& place) {
  if (std::string symbol = symbolAt(program, place); !symbol.empty()) return symbol;
  std::string name = address(program, place);
  // GSK writes the length of a longer cell after its address.
  if (place.kind != RefKind::Bit && place.width > 8 && std::string_view(program.dialect) == "gsk")
    name += fmt::format(":{}", place.width / 8);
  const std::optional<Ref> found = host::resolve(program, name);
  return found && bitsOf(*found) == bitsOf(place) ? name : std::string();
}

} // namespace rung::scenario

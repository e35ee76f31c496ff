// See naming.h.
#include "rtlib/load/naming.h"

#include <algorithm>

#include "rtlib/load/program_info.h"
#include "rtlib/text/letters.h"

namespace rung::runtime {
namespace {

bool precedes(std::string_view a, std::string_view b) { return text::compareIgnoringCase(a, b) < 0; }

} // namespace

std::string plainPlaceName(const rung_program& program, const Ref& place) {
  std::string text = program.spaces[place.space].name;
  text += '+';
  text += std::to_string(place.byte);
  if (place.kind != RefKind::Bit) return text;
  text += '.';
  return text += std::to_string(place.bit);
}

SymbolsByName::SymbolsByName(const rung_program& program, const Naming& naming) : program_(&program) {
  for (uint32_t i = 0; naming.ignoresCase && i < program.symbol_count; ++i) sorted_.push_back(&program.symbols[i]);
  std::ranges::stable_sort(sorted_, precedes, &rung_symbol::name);
}

const rung_symbol* SymbolsByName::find(std::string_view name) const {
  if (sorted_.empty()) return findSymbol(*program_, name);
  const auto found = std::ranges::lower_bound(sorted_, name, precedes, &rung_symbol::name);
  return found != sorted_.end() && text::equalsIgnoringCase((*found)->name, name) ? *found : nullptr;
}

} // namespace rung::runtime

// The plain grammar, with TYPE.NAME, CELL.WEIGHT and the rules for symbols (see technol.h).
#include "rtlib/nc/names/technol.h"

#include <algorithm>
#include <string>
#include <utility>

#include "rtlib/load/program_info.h"
#include "rtlib/text/name_parts.h"
#include "rtlib/text/number.h"

namespace rung::nc {

using runtime::Ref;
using runtime::RefKind;

namespace {

constexpr size_t kSignificant = 31; // characters of a symbol

constexpr std::pair<std::string_view, uint32_t> kTypes[] = {
    {"BYTE.", 1}, {"WORD.", 2}, {"DWRD.", 4}, {"QWRD.", 8}, {text::kRealPrefix, 8}};

// Takes "WORD." and the like from the beginning of the name, and returns the number of bytes.
std::optional<uint32_t> takeType(std::string_view& name) {
  for (const auto& [type, bytes] : kTypes) {
    if (!name.starts_with(type) || name.size() == type.size()) continue;
    name.remove_prefix(type.size());
    return bytes;
  }
  return std::nullopt;
}

// A bit symbol after the dot means its number in its byte (technol.md 4.1).
std::optional<Ref> weighted(const std::optional<Ref>& cell, const std::optional<Ref>& weight) {
  if (!cell || !weight || weight->kind != RefKind::Bit || cell->kind == RefKind::Constant) return std::nullopt;
  Ref ref = runtime::bitRef(cell->space, cell->byte, weight->bit);
  ref.readonly = cell->readonly;
  return ref;
}

// The type prefix ("WORD.") for a place of this length.
std::string_view typeOf(const Ref& place) {
  if (place.kind == RefKind::Real) return "REAL.";
  for (const auto& [type, bytes] : kTypes)
    if (place.width == bytes * 8 && place.count == 1) return type;
  return {};
}

class TechnolNames final : public NameGrammar {
public:
  Case ofNames() const override { return Case::Upper; }
  bool hasAddresses() const override { return false; }
  uint32_t longestCell() const override { return 8; }

  const rung_symbol* symbol(const rung_program& program, std::string_view name) const override {
    if (const rung_symbol* exact = runtime::findSymbol(program, name)) return exact;
    if (name.size() < kSignificant || name.find_first_of(".[") != std::string_view::npos) return nullptr;
    const std::string_view head = name.substr(0, kSignificant);
    const rung_symbol* symbol = runtime::firstSymbolFrom(program, head);
    return symbol != nullptr && std::string_view(symbol->name).starts_with(head) ? symbol : nullptr;
  }

  std::optional<Ref> takeApart(NameSearch& search, std::string_view name) const override {
    const bool isReal = name.starts_with(text::kRealPrefix);
    if (const std::optional<uint32_t> bytes = takeType(name)) {
      const std::optional<Ref> cell = search.ofBytes(name, bytes);
      return isReal ? search.real(cell) : cell;
    }
    const size_t dot = name.rfind('.');
    const bool hasLength = name.find(':') != std::string_view::npos;
    if (dot == std::string_view::npos || hasLength || name.back() == ']' || NameSearch::allDigits(name.substr(dot + 1)))
      return NameGrammar::takeApart(search, name);
    std::optional<Ref> cell = search.find(name.substr(0, dot));
    if (!cell) cell = search.ofBytes(name.substr(0, dot), 1); // a byte near the end of the space
    return weighted(cell, search.find(name.substr(dot + 1)));
  }

  // There are no addresses: CELL, CELL.3, NAME[2], NAME[2].3, and NAME+4 for a place within a cell.
  std::string address(const rung_program& program, const Ref& place) const override {
    const rung_symbol* symbol = shortestAt(program, place);
    if (symbol == nullptr) return NameGrammar::address(program, place);
    const Ref whole = runtime::refOf(*symbol);
    const std::string name = symbol->name;
    const auto element = [&](uint32_t index) {
      return whole.count > 1 ? name + "[" + std::to_string(index) + "]" : name;
    };
    const uint32_t distance = place.byte - whole.byte;
    if (whole.kind == RefKind::Bit) return element(distance * 8 + place.bit - whole.bit);
    const uint32_t cell = whole.width / 8;
    if (place.kind == RefKind::Bit && whole.kind != RefKind::Int)
      return name + "+" + std::to_string(distance) + "." + std::to_string(place.bit);
    if (place.kind == RefKind::Bit)
      return element(distance / cell) + "." + std::to_string(distance % cell * 8 + place.bit);
    const bool isElement = distance % cell == 0 && uint32_t{place.width} * place.count <= whole.width;
    return isElement ? element(distance / cell) : distance == 0 ? name : name + "+" + std::to_string(distance);
  }

  // A cell of another length than the declared one: WORD.NAME+4.
  std::string cellAddress(const rung_program& program, const Ref& place) const override {
    const rung_symbol* symbol = shortestAt(program, place);
    const std::string text = address(program, place);
    if (symbol == nullptr || place.kind == RefKind::Bit || place.kind == RefKind::Text) return text;
    const Ref cells = runtime::refOf(*symbol);
    const uint32_t distance = place.byte - symbol->byte;
    const bool isNumber = cells.kind == RefKind::Int || cells.kind == RefKind::Real;
    if (isNumber && place.kind == cells.kind && place.width == cells.width && distance % (cells.width / 8) == 0)
      return text;
    const std::string there = distance == 0 ? "" : "+" + std::to_string(distance);
    return std::string(typeOf(place)) + symbol->name + there;
  }
};

} // namespace

const NameGrammar& technolNames() {
  static const TechnolNames names;
  return names;
}

} // namespace rung::nc

// From a name as the dialect writes it to a place, and back. The forms (scenario bindings of the inventories):
//   gsk      X002.1  D10  D10:2  SYMBOL  SYMBOL.3  SYMBOL:2        areas are the spaces X Y F G R K A C T D
//   nct      0056  0056.17  SYM  SYM.05  SYM,#3  SYM,KCONST  7100,#3  !OUT000.03    space "M", with ! space "TS"
//   technol  SYMBOL  CELL.3  CELL.WEIGHT  NAME[2]  NAME[2].3       spaces "DATA", "NCI"; case-insensitive, 31
//   characters
// Hidden symbols ("@DR") are found by their name in every dialect.
#pragma once
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "rtlib/host/ref.h"

namespace rung::host {

// Asked for a name that the program's own symbols do not hold: first the whole name, then what remains of it when
// modifiers, indices and bits are taken off. It gets the name as written (technol: upper case).
using NameFallback = std::function<std::optional<Ref>(std::string_view)>;

std::optional<Ref> resolve(const rung_program& program, std::string_view name, const NameFallback& fallback = {});

// A symbol's place; a symbol by its exact name.
Ref refOf(const rung_symbol& symbol);
const rung_symbol* findSymbol(const rung_program& program, std::string_view name);

// A short name of the place that `resolve` finds again: a symbol of its own, else the dialect's address.
std::string placeName(const rung_program& program, const Ref& place);

// How a reader would write that bit or byte: the dialect's address, with the symbols that lie there in brackets.
std::string describeBit(const rung_program& program, uint32_t space, uint32_t byte, uint32_t bit);
std::string describeByte(const rung_program& program, uint32_t space, uint32_t byte);

} // namespace rung::host

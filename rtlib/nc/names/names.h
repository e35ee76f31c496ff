// From a name as the dialect writes it to a place, and back. The forms of a dialect are in the file of its name (gsk.h,
// nct.h, technol.h); a program of any other dialect has those of grammar.h. Symbols of the program go before all else,
// hidden ones ("@DR") too.
//
// Names are for starting, for people and for texts: nothing here belongs in a scan.
#pragma once
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "rtlib/load/ref.h"

namespace rung::nc {

// Asked for a name that the program's own symbols do not hold: first the whole name, then what remains of it when
// modifiers, indices and bits are taken off. It gets the name as written, in upper case where case does not count.
using NameFallback = std::function<std::optional<runtime::Ref>(std::string_view)>;

// Nothing when the name is unknown, or its place lies outside the program's spaces.
std::optional<runtime::Ref> resolve(const rung_program& program, std::string_view name,
                                    const NameFallback& fallback = {});

// What a name is a part of: the name without its bit, index, width or distance, SYM of SYM.3, SYM,#2, SYM[2], !SYM,
// REAL.SYM.
std::string_view headOf(std::string_view name);

// A short name of the place that `resolve` finds again: a symbol of its own, else the dialect's address.
std::string placeName(const rung_program& program, const runtime::Ref& place);

// The place as a number that the dialect has: NCT has no integers of 64 bits, so one of these is a real.
runtime::Ref meant(const rung_program& program, const runtime::Ref& place);
// The name of the real that begins where the cell of this name does: REAL.NAME.
std::string realName(std::string_view name);

// The dialect's address of the place's bit, or of its first byte; NAME+n where it has none but those.
std::string address(const rung_program& program, const runtime::Ref& place);
// The same with the length of a longer cell, where the dialect writes one with the address (D10:2, WORD.NAME+4),
// and as the name of a real where it is one (REAL.7000).
std::string cellAddress(const rung_program& program, const runtime::Ref& place);
// False: a user of the dialect knows the names of its cells only.
bool hasAddresses(const rung_program& program);

// How a reader would write that bit or byte: the address, with the symbols that lie there in brackets.
std::string describe(const rung_program& program, const runtime::Ref& place);

} // namespace rung::nc

// Converts a name, as the dialect writes it, to a place, and back. The forms of a dialect are described in the file of
// its name (nct.h, pmc.h, technol.h), those of any other dialect in grammar.h. Symbols of the program, also hidden ones
// ("@DR"), take precedence over everything else.
//
// Names are for the start, for users and for texts: no function here may be called in a scan.
#pragma once
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "rtlib/load/naming.h"
#include "rtlib/load/ref.h"

namespace rung::nc {

// Called for a name that is not a symbol of the program: first with the whole name, then with the name without its
// modifiers, indices and bits. It gets the name as written, in upper case if case does not count.
using NameFallback = std::function<std::optional<runtime::Ref>(std::string_view)>;

// Nothing if the name is unknown, or its place is outside the program's spaces.
std::optional<runtime::Ref> resolve(const rung_program& program, std::string_view name,
                                    const NameFallback& fallback = {});

// The name without its bit, index, width or offset: SYM of SYM.3, SYM,#2, SYM[2], !SYM, REAL.SYM.
std::string_view headOf(std::string_view name);

// A short name of the place that `resolve` understands: its symbol, else the dialect's address.
std::string placeName(const rung_program& program, const runtime::Ref& place);

// The place as a kind of number that the dialect has: NCT has no 64-bit integers, so a place of 64 bits is a real.
runtime::Ref meant(const rung_program& program, const runtime::Ref& place);
// The name of the real at the address of the cell: REAL.NAME.
std::string realName(std::string_view name);

// The dialect's address of the place's bit, or of its first byte; NAME+n if the dialect has no other addresses.
std::string address(const rung_program& program, const runtime::Ref& place);
// The same with the length of a longer cell, if the dialect writes it with the address (D10:2, WORD.NAME+4); a real is
// written as REAL.7000.
std::string cellAddress(const rung_program& program, const runtime::Ref& place);
// False: users of the dialect know cells only by name.
bool hasAddresses(const rung_program& program);

// How programs of this one's dialect are compared, by the addresses and the rule of case here.
runtime::Naming naming(const rung_program& program);

// A description of that bit or byte for users: the address, with the symbols at this place in brackets.
std::string describe(const rung_program& program, const runtime::Ref& place);

} // namespace rung::nc

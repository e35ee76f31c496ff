// The FANUC PMC's properties for reading, checking and conversion: one language for each type of the PMC.
#pragma once
#include "frontend/dialects/fanuc/pmc.h"
#include "frontend/network/language.h"

namespace rung::frontend::fanuc {

inline constexpr std::string_view kExtensions[] = {".mne", ".mnc"}; // of mnemonic files

const network::Language& languageOf(Pmc pmc);
// The type of a language made here.
Pmc pmcOf(const network::Language& language);

} // namespace rung::frontend::fanuc

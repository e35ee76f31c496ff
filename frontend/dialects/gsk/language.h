// The language of the GSK25i PLC, used by frontend/network to read, check and convert its programs.
#pragma once
#include "frontend/network/language.h"

namespace rung::frontend::gsk {

inline constexpr std::string_view kExtensions[] = {".pmc"}; // of command lists
extern const network::Language kLanguage;

} // namespace rung::frontend::gsk

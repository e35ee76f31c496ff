// The language of the GSK25i PLC, as frontend/network reads, checks and converts it.
#pragma once
#include "frontend/network/language.h"

namespace rung::frontend::gsk {

extern const network::Language kLanguage;

} // namespace rung::frontend::gsk

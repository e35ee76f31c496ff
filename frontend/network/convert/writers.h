// A program as text.
#pragma once
#include <string>

#include "frontend/network/convert/source_program.h"

namespace rung::frontend::network {

std::string writeList(const Language& language, const SourceProgram& source);
std::string writeLadder(const Language& language, const SourceProgram& source);

} // namespace rung::frontend::network

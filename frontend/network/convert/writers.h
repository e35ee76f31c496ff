// The source model as text.
#pragma once
#include <string>

#include "frontend/network/convert/source_model.h"

namespace rung::network::convert {

std::string writeList(const Language& language, const SourceProgram& program);
std::string writeLadder(const Language& language, const SourceProgram& program);

} // namespace rung::network::convert

// The source model as text.
#pragma once
#include <string>

#include "frontend/dialects/gsk/convert/source_model.h"

namespace rung::gsk::convert {

std::string writeList(const SourceProgram& program);
std::string writeLadder(const SourceProgram& program);

} // namespace rung::gsk::convert

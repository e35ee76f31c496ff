// A program as one HTML file that needs nothing else: drawings, names with their uses, a search.
#pragma once
#include <string>

#include "tools/view/program.h"

namespace rung::view {

std::string renderHtml(const Program& program);

} // namespace rung::view

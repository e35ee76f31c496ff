// A layout as JSON, in which the program that reads headers passes it to rungc.
#pragma once
#include <string>
#include <string_view>

#include "codegen/clang/layout.h"
#include "ir/support/result.h"

namespace rung::codegen {

std::string toJson(const HostLayout& layout);
// Fails if the text was not made by toJson of this version.
Result<HostLayout> layoutOf(std::string_view json);

} // namespace rung::codegen

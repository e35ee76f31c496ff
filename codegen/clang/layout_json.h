// A layout as JSON, by which the program that reads headers gives it to rungc.
#pragma once
#include <string>
#include <string_view>

#include "codegen/clang/layout.h"
#include "ir/support/result.h"

namespace rung::codegen {

std::string toJson(const HostLayout& layout);
// Fails where the text is not one that toJson of this version has made.
Result<HostLayout> layoutOf(std::string_view json);

} // namespace rung::codegen

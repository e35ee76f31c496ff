// A first binding file for a struct.
#pragma once
#include <string>

#include "codegen/clang/layout.h"

namespace rung::bind {

// All numbers of the struct in comments, each as the line that binds it.
std::string templateOf(const codegen::HostLayout& layout);

} // namespace rung::bind

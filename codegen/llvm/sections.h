// Sections of a shared object that no loader looks at: what a program carries for its compiler. Free of LLVM.
#pragma once
#include <optional>
#include <string>
#include <string_view>

#include "ir/support/result.h"

namespace rung::codegen {

// The object with one more section.
Result<std::string> withSection(std::string_view object, std::string_view name, std::string_view contents);

// What the section holds; nothing if the object has no section of this name, or the file is not an object. Fails where
// LLVM cannot be loaded.
Result<std::optional<std::string>> sectionOf(std::string_view object, std::string_view name);

} // namespace rung::codegen

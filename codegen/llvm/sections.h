// Sections of a shared object that no loader reads: data that a program carries for its compiler. Does not include
// LLVM.
#pragma once
#include <optional>
#include <string>
#include <string_view>

#include "ir/support/result.h"

namespace rung::codegen {

// The object with one more section.
Result<std::string> withSection(std::string_view object, std::string_view name, std::string_view contents);

// The contents of the section; nothing if the object has no section of this name, or the file is not an object. Fails
// if LLVM cannot be loaded.
Result<std::optional<std::string>> sectionOf(std::string_view object, std::string_view name);

} // namespace rung::codegen

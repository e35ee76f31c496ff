// The table of a binding in C (also valid C++) for the host to compile, with assertions of everything that it relies
// on.
#pragma once
#include <string>

#include "codegen/clang/layout.h"
#include "tools/bind/binding.h"

namespace rung::bind {

struct Names {
  std::string header;  // operand of the #include
  std::string command; // command that makes the file, for the reader
};

std::string generate(const Binding& binding, const codegen::HostLayout& layout, const Names& names);

// A first binding file for a struct.

// All numbers of the struct, in comments, each as the line that binds it.
std::string templateOf(const codegen::HostLayout& layout);

} // namespace rung::bind

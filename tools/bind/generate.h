// What a host compiles: the table of a binding in C, which is also C++, with assertions of all that it relies on.
#pragma once
#include <string>

#include "codegen/clang/layout.h"
#include "tools/bind/binding.h"

namespace rung::bind {

struct Names {
  std::string header;  // as #include has it
  std::string command; // that makes the file, for people
};

std::string generate(const Binding& binding, const codegen::HostLayout& layout, const Names& names);

// A first binding file for a struct.

// All numbers of the struct in comments, each as the line that binds it.
std::string templateOf(const codegen::HostLayout& layout);

} // namespace rung::bind

// Example programs as loaded shared objects, made by the compiler and with the sanitizer of the tests themselves.
#pragma once
#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include "rtlib/load/so_engine.h"

namespace rung::test {

struct Example {
  std::string name;               // of the folder in examples
  std::vector<std::string> files; // of its sources, in the program's order
};
inline void PrintTo(const Example& example, std::ostream* out) { *out << example.name; }

// Null fails the test.
std::unique_ptr<runtime::SoEngine> load(const Example& example);

} // namespace rung::test

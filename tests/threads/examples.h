// Example programs as loaded shared objects, made by the compiler and with the sanitizer of the tests themselves.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "rtlib/host/so_engine.h"

namespace rung::test {

struct Example {
  std::string name;               // of the folder in examples
  std::vector<std::string> files; // of its sources, in the program's order
};

// Null fails the test.
std::unique_ptr<host::SoEngine> load(const Example& example);

} // namespace rung::test

// What is wrong with an entry of a file that refers to a program.
#pragma once
#include <string>

namespace rung::host {

// In the order of a message.
struct Mistake {
  std::string found;
  std::string expected;
  std::string fix;

  std::string text() const { return "found " + found + ", expected " + expected + "; " + fix; }
};

} // namespace rung::host

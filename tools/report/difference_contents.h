// What the memory of a program holds at its start, by the names of its variables.
#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <utility>

#include "rung/program.h"

namespace rung::report {

// By name and element: "'text'", "0.5", "12". All variables to which the compiler gives places; of arrays those
// elements that are not 0.
using Contents = std::map<std::pair<std::string, uint32_t>, std::string>;

Contents initialContents(const rung_program& program);
// Of an element that is in the contents of one program, and in the other 0: how that is written.
std::string zeroLike(const std::string& text);

} // namespace rung::report

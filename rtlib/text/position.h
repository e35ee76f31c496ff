// Where something is in the files that are read.
#pragma once
#include <cstdint>
#include <tuple>

namespace rung::text {

// Line and column are from 1; columns count characters.
struct Position {
  uint32_t line = 1;
  uint32_t column = 1;
  uint32_t file = 0; // of several, in the order in which they are read
  bool operator==(const Position&) const = default;
  bool operator<(const Position& other) const {
    return std::tie(file, line, column) < std::tie(other.file, other.line, other.column);
  }
};

} // namespace rung::text

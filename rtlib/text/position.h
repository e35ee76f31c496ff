// A position in the source files.
#pragma once
#include <cstdint>
#include <tuple>

namespace rung::text {

// Line and column are from 1; columns count characters.
struct Position {
  uint32_t line = 1;
  uint32_t column = 1;
  uint32_t file = 0; // index of the file, in reading order
  bool operator==(const Position&) const = default;
  bool operator<(const Position& other) const {
    return std::tie(file, line, column) < std::tie(other.file, other.line, other.column);
  }
};

} // namespace rung::text

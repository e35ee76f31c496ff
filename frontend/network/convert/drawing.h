// A network as a drawing of ladder text: one line per branch, upper branch first, boxes and coils to the right.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "frontend/network/read/drawn_comments.h"

namespace rung::frontend::network {

struct Drawing {
  std::vector<std::string> lines;
  // By command: the line of its element; kNone for blocks, parameters and table rows.
  std::vector<uint32_t> lineOf;
  std::vector<LineEnds> ends; // by line; a box counts on its first line only
};

struct DrawingSize {
  uint64_t lines = 0;
  uint64_t columns = 0;
};
// A branch that spans many elements is as long as they are: the number of lines times columns of one drawing is
// limited.
inline constexpr uint64_t kMaxDrawing = 200'000'000;
DrawingSize sizeOf(const Language& language, const Network& network);
Drawing draw(const Language& language, const Network& network);

} // namespace rung::frontend::network

// Two versions of a program side by side, as one self-contained HTML file: rungs that differ are drawn in both
// versions, with the elements marked that only one of them has; what is the same is folded.
#pragma once
#include <string>
#include <vector>

#include "tools/view/program.h"

namespace rung::view {

// A rung of one version or of both, by its numbers as drawn; 0: the version does not have it.
struct ComparedRung {
  enum class State : uint8_t { Same, Added, Removed, Changed, Moved };
  State state = State::Same;
  uint32_t before = 0;
  uint32_t after = 0;
  std::vector<std::string> remarks;
};

// Other differences, such as names.
struct ComparedTable {
  struct Row {
    std::string what; // "added"
    std::string name;
    std::string before, after;
  };
  std::string title;
  std::vector<Row> rows;
};

struct Comparison {
  std::string before, after;       // what the versions are called
  std::vector<ComparedRung> rungs; // in the order of the newer version
  std::vector<ComparedTable> tables;
};

std::string renderComparison(Program before, Program after, const Comparison& comparison);

} // namespace rung::view

// Writes a first mapping file for a program, with its inputs, outputs and functions, for a user to edit.
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "rung/runtime.h"

namespace rung::host {

// The name of a cell that rungs of the program use.
struct UsedName {
  std::string name;
  bool read = false;
  bool written = false; // at least partly
};

// Returns the text of a mapping file without errors and warnings. Its inputs are the cells that the machine or the NC
// writes, its outputs those that they read. Of memory shared by both sides, cells that no rung writes become inputs,
// cells that no rung reads become outputs, and the others are listed in comments. Of the program's own memory, only
// cells that no rung writes are listed, in comments. `program`: the tables of the instance's image.
std::string templateMap(rung_instance* instance, const rung_program& program, std::span<const UsedName> used);

// Ownership of a program's cells: written by the machine and the NC, read by them, or the program's own.

// Bits of a space.
struct Bits {
  uint32_t space = RUNG_NONE;
  uint64_t first = 0;
  uint64_t end = 0;
  bool meets(const Bits& other) const { return space == other.space && first < other.end && other.first < end; }
};
Bits bitsOf(const rung_cell_info& info);

// The owners of a program's cells; the direction of a signal is more precise than that of the memory in which it lies.
class Sides {
public:
  Sides(rung_instance* instance, const rung_program& program);

  // enum rung_space_flags: RUNG_SPACE_INPUT, RUNG_SPACE_OUTPUT, both or neither.
  uint32_t of(const rung_cell_info& info) const;
  bool isInput(const rung_cell_info& info) const { return (of(info) & RUNG_SPACE_INPUT) != 0; }

private:
  struct SignalPlace {
    Bits bits{};
    uint32_t side = 0;
  };
  const rung_program& program_;
  std::vector<SignalPlace> signals_;
};

} // namespace rung::host

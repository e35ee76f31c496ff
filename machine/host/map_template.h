// A first mapping file for a program: its inputs, outputs and functions, as a person would begin to write them.
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "rung/runtime.h"

namespace rung::host {

// A place that rungs of the program use, by its name.
struct UsedName {
  std::string name;
  bool read = false;
  bool written = false; // it, or a part of it
};

// A mapping file without mistakes and warnings. Input is what the machine or the NC writes, output what they read; of
// memory that both sides share what no rung writes, or what no rung reads, and the rest of it is in comments. Of the
// program's own memory only what no rung writes is there, in comments, too. `program`: the tables of the instance's
// image.
std::string templateMap(rung_instance* instance, const rung_program& program, std::span<const UsedName> used);

// Whose the cells of a program are: the machine's and the NC's to write, theirs to read, or the program's own.

// Bits of a space.
struct Bits {
  uint32_t space = RUNG_NONE;
  uint64_t first = 0;
  uint64_t end = 0;
  bool meets(const Bits& other) const { return space == other.space && first < other.end && other.first < end; }
};
Bits bitsOf(const rung_cell_info& info);

// Of a program; a signal's direction says more than the memory that it lies in.
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

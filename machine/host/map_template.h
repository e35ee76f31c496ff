// A first mapping file for a program: its inputs, outputs and functions, as a person would begin to write them.
#pragma once
#include <span>
#include <string>

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

} // namespace rung::host

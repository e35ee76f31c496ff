// The parts of a program besides its rungs, each as a hash: two programs with equal parts and rungs do the same.
#pragma once
#include <cstdint>

#include "rung/program.h"

namespace rung::runtime {

struct ProgramParts {
  uint64_t memory = 0;   // layout_hash
  uint64_t names = 0;    // symbols with their places, and constants with their values
  uint64_t contents = 0; // initial contents of the memory
  uint64_t messages = 0; // texts
  uint64_t schedule = 0; // tasks, steps and copies
  bool operator==(const ProgramParts&) const = default;
};

struct ProgramPart {
  const char* name; // in the control protocol
  uint64_t ProgramParts::* hash;
  const char* difference; // what is said of two programs in which it differs
};
inline constexpr ProgramPart kProgramParts[] = {
    {"memory", &ProgramParts::memory, "the layout of the memory differs"},
    {"names", &ProgramParts::names, "names or constants differ: new ones, other addresses or values"},
    {"contents", &ProgramParts::contents, "initial contents of the memory differ"},
    {"messages", &ProgramParts::messages, "texts of messages differ"},
    {"schedule", &ProgramParts::schedule, "the schedule of tasks differs"}};

// The program has passed checkProgram.
ProgramParts partsOf(const rung_program& program);

} // namespace rung::runtime

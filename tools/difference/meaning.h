// What a rung means, apart from where it is and how it is written.
#pragma once
#include <string>
#include <vector>

#include "ir/core/module.h"

namespace rung::difference {

// A rung as it is drawn: those of the module that have its number.
struct DrawnRung {
  const ir::Routine* routine = nullptr;
  const ir::Rung* rung = nullptr; // the first
  uint64_t meaning = 0;           // equal: it does the same
};

// Of a module as a front end built it, routine by routine; rungs that the compiler added are left out.
//
// A rung means its operations: on places by their addresses, or where the compiler gives the addresses out by their
// names; on what it keeps by the keys of its state; with jumps to rungs of the same text. Names of places with
// addresses, titles, comments and lines mean nothing. In a rung that computes an address which the compiler gave out
// the numbers are addresses, too, and move with them: there the words count in the place of numbers.
std::vector<DrawnRung> drawnRungs(const ir::Module& module);

} // namespace rung::difference

// The meaning of a rung, apart from where it is and how it is written.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "ir/core/marks.h"
#include "ir/core/module.h"
#include "tools/report/difference_cells.h"

namespace rung::report {

// A place to which a rung may lead, other than the rung below it.
struct Exit {
  enum class To : uint8_t {
    Rung,    // `part` of a drawn rung
    End,     // of a routine
    Routine, // of a call, or one that the control calls later
  };
  To to = To::Rung;
  uint32_t index = 0; // index in the list of drawn rungs, or of routines
  uint32_t part = 0;  // index among the rungs of the module that make up the drawn one
};

// A rung as drawn: the rungs of the module that have its number.
struct DrawnRung {
  const ir::Routine* routine = nullptr; // routine of the first of them
  const ir::Rung* rung = nullptr;       // of those in this routine, the first that reaches the last line
  uint64_t meaning = 0;                 // equal: the rungs do the same if their exits lead to the same
  std::vector<Exit> exits;              // equal meanings have equally many exits
};

// The drawn rungs of a module as a front end built it for a comparison, routine by routine, without rungs that the
// compiler added.
//
// The meaning of a rung is that of its operations, in whatever order it reads; of places by their addresses, or by
// their former names if the compiler assigns the addresses; of an instruction's state whatever its key, of other state
// by its key. Names of places with addresses, titles, comments, lines and numbers that the rung is given
// (ir::GivenNumbers) do not count. A number by which a mechanism, or a rung elsewhere, continues later is an exit.
std::vector<DrawnRung> drawnRungs(const ir::Module& module, const ir::GivenNumbers& given, const FormerNames& former);

} // namespace rung::report

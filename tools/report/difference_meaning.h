// What a rung means, apart from where it is and how it is written.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "ir/core/marks.h"
#include "ir/core/module.h"
#include "tools/report/difference_cells.h"

namespace rung::report {

// Where a rung may lead, other than to the one below it.
struct Exit {
  enum class To : uint8_t {
    Rung,    // `part` of a drawn rung
    End,     // of a routine
    Routine, // a call, or what the control calls later
  };
  To to = To::Rung;
  uint32_t index = 0; // in the list of drawn rungs, or of routines
  uint32_t part = 0;  // of the rungs that the module has for the drawn one
};

// A rung as it is drawn: those of the module that have its number.
struct DrawnRung {
  const ir::Routine* routine = nullptr; // of the first
  const ir::Rung* rung = nullptr;       // of those in this routine the first that reaches to the last line
  uint64_t meaning = 0;                 // equal: it does the same, where its exits lead to the same
  std::vector<Exit> exits;              // as many where meanings are equal
};

// Of a module as a front end built it for a comparison, routine by routine; rungs that the compiler added are left out.
//
// A rung means its operations, whatever the order in which it reads: on places by their addresses, or where the
// compiler gives the addresses out by their former names; on state of an instruction whatever its key, on other state
// by its key. Names of places with addresses, titles, comments, lines and numbers that the rung is given
// (ir::GivenNumbers) mean nothing. A number by which a mechanism, or a rung elsewhere, finds its way later is an exit.
std::vector<DrawnRung> drawnRungs(const ir::Module& module, const ir::GivenNumbers& given, const FormerNames& former);

} // namespace rung::report

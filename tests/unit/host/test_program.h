// Programs written by hand as a compiler would lay them out, for tests of what ships with a machine.
#pragma once
#include "rung/program.h"

namespace rung::host::testing {

// GSK, 8 ms, spaces X Y F G R D. Each scan: Y0.0 := X0.0, D0 counts scans (2 bytes), D4 := F10 (4 bytes), D8 := F14
// (4 bytes), the strobe F7.0 is answered by G4.3, SYM is Y1.2; X1.0 makes the fault "dead-loop" at line 42 of main.pmc,
// X1.1 requests a window read, its state comes into D12 and its first result into D13, X1.2 shows message 7; D16 and
// D20 (4 bytes each) are the positions of axes 1 and 2. D is retained.
const rung_program& gskProgram();

// NCT, 10 ms, spaces M and TS (words 0 to 2047); main copies the time slice both ways, M0400.00 := M0056.17. M0056.18
// shows message 7 of channel 3 with index 5, its output is M0400.01.
const rung_program& nctProgram();

// TECHNOL, 20 ms, spaces NCI and DATA with the cells REALCELL (8 bytes), COUNT (2 bytes), NAME (a text): for
// names and types, it does nothing.
const rung_program& technolProgram();

} // namespace rung::host::testing

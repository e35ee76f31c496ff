// What the straight-line form of a ladder (straight.py) says of its memory to rung-bench-real.
#pragma once

// A byte that the ladder names: in memory, or its bits by their numbers (-1: not named).
struct Place {
  char area;
  unsigned byte;
  int inMemory;
  int bits[8];
};

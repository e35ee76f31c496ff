// What an operator wants to know of the M, S and T functions that are on their way to a program.
#pragma once
#include <array>
#include <cstdint>

#include "rung/runtime.h"

namespace rung::host {

struct FunctionState {
  static constexpr uint32_t kMost = 8;
  struct Function {
    rung_function_kind kind = RUNG_FUNCTION_M;
    uint32_t channel = 0; // from 0
    uint32_t code = 0;
    int64_t ageNs = 0;  // since its pin caused it
    bool begun = false; // the program has it; else it waits for its turn
    bool late = false;  // it takes longer than the map's time
  };
  std::array<Function, kMost> oldest; // the first of them
  uint32_t count = 0;                 // of all
  uint32_t lost = 0;                  // since the start
};

} // namespace rung::host

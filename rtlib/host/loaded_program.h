// A program beside the memory that one instance of it needs: what another program replaces.
#pragma once
#include <cstdint>
#include <memory>
#include <vector>

#include "rtlib/core/runner.h"
#include "rtlib/host/overwritten.h"

namespace rung::host {

// A program with all the memory that one instance of it needs; its memory block holds the initial contents.
struct LoadedProgram {
  // `engine`: what its chunks find in rung_ctx::engine.
  LoadedProgram(const rung_program& loaded, void* engine);
  void clear() noexcept; // memory as the program's tables say

  struct FreeBlock {
    size_t align;
    void operator()(uint8_t* block) const;
  };
  const rung_program* program;
  void* engine;
  std::unique_ptr<uint8_t, FreeBlock> block;
  std::vector<rung_prof> profile;   // one a rung; empty when the program is not instrumented
  std::vector<rt::PartState> parts; // one a task
  std::vector<uint8_t> retained;    // room for a warm start
  Overwritten overwritten;
};

} // namespace rung::host

// The passes between front end and layout, in one fixed order (pipeline.cpp). They preserve everything that is visible
// of a program: memory after every run of a task, messages, services and faults in their order, and rungs, keys and
// source lines. Slots that are `transient` are not visible and may differ. Time and space are nearly linear in the size
// of the module.
#pragma once
#include <span>
#include <string_view>

#include "ir/core/module.h"

namespace rung::ir {

struct PassOptions {
  bool optimise = true;
  bool instrument = false; // count and time rungs
  bool verifyEach = false; // run the verifier after each pass; an error stops the process
};

// `module` has passed the verifier (mode Built). `shape` (or null) receives the module at the stage that determines
// memory, chunks and tables: its routines and rungs, their exits, and what they may access. Later passes can only
// remove some of these.
void runPasses(Module& module, const PassOptions& options, Module* shape = nullptr);

// The names of the optimising passes of `runPasses`, in their order.
std::span<const std::string_view> optimisingPasses();

} // namespace rung::ir

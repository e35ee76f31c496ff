// The passes that a module goes through between front end and layout, in one fixed order (pipeline.cpp). They keep
// everything that a program shows: memory after every run of a task, messages, services and faults in their order, and
// rungs, keys and source lines. Slots that are `transient` show nowhere and may differ. Time and space are nearly
// linear in the size of the module.
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

// `module` has passed the verifier (mode Built). `shape` (or null) gets the module as it is when all is decided that
// memory, chunks and tables follow from: its routines and rungs, their exits, and what they may access. What is done
// afterwards can only take away from that.
void runPasses(Module& module, const PassOptions& options, Module* shape = nullptr);

// The names of the passes that `runPasses` runs to optimise, in their order.
std::span<const std::string_view> optimisingPasses();

} // namespace rung::ir

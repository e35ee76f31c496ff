// Runs one program on two engines in step and tells the first difference, in anything that a user could see.
#pragma once
#include <functional>
#include <optional>
#include <string>

#include "compiler/engines.h"
#include "rtlib/load/engine.h"
#include "rtlib/run/instance.h"

namespace rung::testing {

// What is done to both before each scan, such as setting inputs. May be empty.
using BeforeScan = std::function<void(runtime::Instance& instance, int scan)>;

// Nothing when memory, messages, requests, faults and execution counts agree after each of `scans` scans.
std::optional<std::string> firstDisagreement(runtime::Engine& first, runtime::Engine& second, int scans,
                                             const BeforeScan& before = {});

// A module with its layout in the form that makeEngine takes.
compiler::Compiled compiledFrom(ir::Module module, const ir::LayoutOptions& options = {});

// The same of a module as a front end would have built it, which is kept: its code can be made again.
compiler::Compiled compiledFromBuilt(const ir::Module& built, const ir::LayoutOptions& options = {},
                                     bool optimise = true);

} // namespace rung::testing

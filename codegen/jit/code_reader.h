// How many machine instructions a chunk takes at most: the longest path through its code, with the constant bounds of
// its loops.
#pragma once
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <llvm/Pass.h>

#include "codegen/jit/code_paths.h"

namespace rung::codegen {

// The code of a unit as graphs.
struct CodeUnitCode {
  std::vector<std::string> chunks; // names of their functions
  std::map<std::string, FunctionCode> functions;
};

// For generateCode: fills `code`, which outlives it. What the host's functions do is not in it.
std::unique_ptr<llvm::FunctionPass> makeCodeReader(CodeUnitCode& code);

} // namespace rung::codegen

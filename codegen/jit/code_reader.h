// The most machine instructions that a run of a chunk can take: the longest path through its code, with the constant
// bounds of its loops.
#pragma once
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <llvm/Pass.h>

#include "codegen/jit/code_paths.h"

namespace rung::codegen {

// The code of a code unit as graphs.
struct CodeUnitCode {
  std::vector<std::string> chunks; // names of the chunks' functions
  std::map<std::string, FunctionCode> functions;
};

// A pass for generateCode: fills `code`, which must outlive it. Host functions are not included.
std::unique_ptr<llvm::FunctionPass> makeCodeReader(CodeUnitCode& code);

} // namespace rung::codegen

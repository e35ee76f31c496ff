// The last pass over LLVM's IR, right before instructions are selected: what every earlier one would undo.
#pragma once
#include <memory>

#include <llvm/Pass.h>

namespace rung::codegen {

std::unique_ptr<llvm::FunctionPass> makeBeforeSelection();

} // namespace rung::codegen

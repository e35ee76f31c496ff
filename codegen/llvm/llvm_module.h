// Inside of the LLVM back end, shared with the JIT: from chunks to an optimised llvm::Module. The only header that
// includes LLVM's; see llvm_emitter.h for what others use.
#pragma once
#include <memory>
#include <string>

#include <llvm/IR/IRBuilder.h>
#include <llvm/IR/LLVMContext.h>
#include <llvm/IR/Module.h>
#include <llvm/Pass.h>
#include <llvm/Target/TargetMachine.h>

#include "codegen/llvm/llvm_emitter.h"
#include "codegen/llvm/module_part.h"

namespace rung::codegen {

enum class MachineUse : uint8_t {
  File, // for any machine of the triple
  Jit,  // for exactly this one
};

// Optimisation of the code generator follows the level.
Result<std::unique_ptr<llvm::TargetMachine>> makeTargetMachine(const LlvmOptions& options, MachineUse use);

// Verified; functions of sem.hpp are linked in. Fails only where LLVM refuses what we made.
Result<std::unique_ptr<llvm::Module>> buildModule(llvm::LLVMContext& context, const llvm::TargetMachine& machine,
                                                  const ir::Layout& layout, uint64_t codeHash,
                                                  const LlvmOptions& options, const ModulePart& part);

// The passes of a level, before code generation.
void runPasses(llvm::Module& module, llvm::TargetMachine& machine, LlvmLevel level);

// Assembly or an object file; the module is used up. `reader`, which may be null, sees the instructions of each
// function as they will be written.
Result<std::string> generateCode(llvm::Module& module, llvm::TargetMachine& machine, llvm::CodeGenFileType type,
                                 std::unique_ptr<llvm::FunctionPass> reader = nullptr);

// Target, processor, its features and the version of LLVM: what code depends on besides its source and options.
std::string describeMachine(const llvm::TargetMachine& machine);

} // namespace rung::codegen

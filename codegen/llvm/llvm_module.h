// Internals of the LLVM back end, shared with the JIT: from chunks to an optimised llvm::Module. The only header that
// includes LLVM's; other code uses llvm_emitter.h.
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
  Jit,  // for exactly this computer
};

// The level also determines the optimisation of the code generator.
Result<std::unique_ptr<llvm::TargetMachine>> makeTargetMachine(const LlvmOptions& options, MachineUse use);

// Verified, with the functions of sem.hpp linked in. Fails only if LLVM rejects the generated IR.
Result<std::unique_ptr<llvm::Module>> buildModule(llvm::LLVMContext& context, const llvm::TargetMachine& machine,
                                                  const ir::Layout& layout, uint64_t codeHash,
                                                  const LlvmOptions& options, const ModulePart& part);

// Runs the passes of a level, before code generation.
void runPasses(llvm::Module& module, llvm::TargetMachine& machine, LlvmLevel level);

// Assembly or an object file; `module` cannot be used afterwards. `reader`, which may be null, is run on the final
// instructions of each function.
Result<std::string> generateCode(llvm::Module& module, llvm::TargetMachine& machine, llvm::CodeGenFileType type,
                                 std::unique_ptr<llvm::FunctionPass> reader = nullptr);

// Target, processor, its features and the version of LLVM: everything that code depends on besides its source and
// options.
std::string describeMachine(const llvm::TargetMachine& machine);

} // namespace rung::codegen

// The code units of a program.
#pragma once
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "codegen/llvm/llvm_module.h"

namespace rung::codegen {

// Each unit has consecutive chunks. `chunks`: ascending.
std::vector<ModulePart> partitionIntoUnits(const ir::Partition& partition, std::span<const uint32_t> chunks);

// An object file for this computer. `reader`: as in generateCode.
Result<std::string> compileUnit(const ir::Layout& layout, uint64_t codeHash, const LlvmOptions& options,
                                const ModulePart& unit, std::unique_ptr<llvm::FunctionPass> reader = nullptr);

} // namespace rung::codegen

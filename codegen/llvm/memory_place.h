// Fixed places of the memory block, as the chunk emitter addresses them.
#pragma once
#include <cstdint>
#include <optional>

#include <llvm/IR/Argument.h>
#include <llvm/IR/DataLayout.h>
#include <llvm/IR/Instructions.h>

namespace rung::codegen {

// Where an address points to in the block that `memory` points to.
inline std::optional<int64_t> offsetIn(const llvm::Argument& memory, const llvm::Value& address,
                                       const llvm::DataLayout& data) {
  if (&address == &memory) return 0;
  const auto* element = llvm::dyn_cast<llvm::GetElementPtrInst>(&address);
  if (element == nullptr || element->getPointerOperand() != &memory) return std::nullopt;
  llvm::APInt offset(data.getIndexTypeSizeInBits(address.getType()), 0);
  if (!element->accumulateConstantOffset(data, offset)) return std::nullopt;
  return offset.getSExtValue();
}

// The address once more, computed right before an instruction that does not follow it.
inline llvm::Value& addressBefore(llvm::Value& address, llvm::Instruction& user) {
  const auto* computed = llvm::dyn_cast<llvm::Instruction>(&address);
  if (computed == nullptr) return address;
  llvm::Instruction* again = computed->clone();
  again->insertBefore(user.getIterator());
  return *again;
}

// In the memory of another argument, where nothing else points to the block.
inline bool isElsewhere(const llvm::Argument& memory, const llvm::Value& address) {
  const auto* other = llvm::dyn_cast<llvm::Argument>(address.stripInBoundsConstantOffsets());
  return memory.hasNoAliasAttr() && other != nullptr && other != &memory;
}

inline int64_t bytesOf(const llvm::Type& type, const llvm::DataLayout& data) {
  return static_cast<int64_t>(data.getTypeStoreSize(const_cast<llvm::Type*>(&type)).getFixedValue());
}

} // namespace rung::codegen

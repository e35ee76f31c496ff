// Within a block, where it is known what has been written meanwhile (see reload_values.h).
#include "codegen/llvm/reload_values.h"

#include <llvm/ADT/DenseMap.h>
#include <llvm/IR/Function.h>
#include <llvm/IR/Module.h>
#include <llvm/TargetParser/Triple.h>

#include "codegen/llvm/memory_place.h"

namespace rung::codegen {
namespace {

constexpr uint32_t kFar = 24; // instructions of LLVM's IR: of the values of so many most are in registers

class BlockReloads {
public:
  BlockReloads(const llvm::Argument& memory, const llvm::DataLayout& data, int64_t mostBytes)
      : memory_(memory), data_(data), mostBytes_(mostBytes) {}

  bool run(llvm::BasicBlock& block) {
    for (llvm::Instruction& instruction : block) {
      ++position_;
      if (llvm::isa<llvm::PHINode>(instruction)) continue;
      for (llvm::Use& operand : instruction.operands()) use(operand, instruction);
      if (auto* load = llvm::dyn_cast<llvm::LoadInst>(&instruction))
        note(*load);
      else if (auto* store = llvm::dyn_cast<llvm::StoreInst>(&instruction))
        note(*store);
      else if (instruction.mayWriteToMemory())
        allWritten_ = position_;
    }
    return changed_;
  }

private:
  // Where the memory block has a value.
  struct Held {
    llvm::Value* address = nullptr;
    int64_t offset = 0;
    uint32_t since = 0;         // position
    uint32_t lastUse = 0;       // position
    llvm::Value* now = nullptr; // itself, or what was loaded last
  };

  std::optional<int64_t> offsetOf(const llvm::Value* address) const { return offsetIn(memory_, *address, data_); }

  void note(llvm::LoadInst& load) {
    if (!load.isSimple() || !load.getType()->isIntegerTy()) return;
    if (const std::optional<int64_t> offset = offsetOf(load.getPointerOperand()))
      hold(load, load.getPointerOperand(), *offset);
  }

  void note(llvm::StoreInst& store) {
    const std::optional<int64_t> offset = offsetOf(store.getPointerOperand());
    llvm::Value* value = store.getValueOperand();
    if (!offset || !store.isSimple()) {
      if (!isElsewhere(memory_, *store.getPointerOperand())) allWritten_ = position_;
      return;
    }
    for (int64_t i = 0; i < bytesOf(*value->getType(), data_); ++i) written_[*offset + i] = position_;
    if (llvm::isa<llvm::Instruction>(value) && value->getType()->isIntegerTy())
      hold(*value, store.getPointerOperand(), *offset);
  }

  void hold(llvm::Value& value, llvm::Value* address, int64_t offset) {
    if (bytesOf(*value.getType(), data_) > mostBytes_) return;
    held_[&value] = {address, offset, position_, position_, &value};
  }

  void use(llvm::Use& operand, llvm::Instruction& user) {
    const auto found = held_.find(operand.get());
    if (found == held_.end()) return;
    Held& held = found->second;
    if (position_ - held.lastUse > kFar && isStillThere(held, bytesOf(*operand->getType(), data_)))
      held.now =
          new llvm::LoadInst(operand.get()->getType(), held.address, "", false, llvm::Align(1), user.getIterator());
    held.lastUse = position_;
    if (held.now == operand.get()) return;
    operand.set(held.now);
    changed_ = true;
  }

  bool isStillThere(const Held& held, int64_t size) const {
    if (allWritten_ > held.since) return false;
    for (int64_t i = 0; i < size; ++i) {
      const auto written = written_.find(held.offset + i);
      if (written != written_.end() && written->second > held.since) return false;
    }
    return true;
  }

  const llvm::Argument& memory_;
  const llvm::DataLayout& data_;
  const int64_t mostBytes_;
  uint32_t position_ = 0;
  uint32_t allWritten_ = 0;                   // position at which anything may have been written
  llvm::DenseMap<int64_t, uint32_t> written_; // by offset: position
  llvm::DenseMap<llvm::Value*, Held> held_;
  bool changed_ = false;
};

} // namespace

// RISC-V may load what is not aligned a byte at a time.
bool reloadValues(llvm::Function& function) {
  const llvm::Module& module = *function.getParent();
  const int64_t mostBytes = llvm::Triple(module.getTargetTriple()).isRISCV() ? 1 : 8;
  bool changed = false;
  for (llvm::BasicBlock& block : function)
    if (BlockReloads(*function.getArg(0), module.getDataLayout(), mostBytes).run(block)) changed = true;
  return changed;
}

} // namespace rung::codegen

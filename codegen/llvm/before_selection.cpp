// See before_selection.h.
#include "codegen/llvm/before_selection.h"

#include <llvm/ADT/DenseMap.h>
#include <llvm/ADT/STLExtras.h>
#include <llvm/Analysis/ValueTracking.h>
#include <llvm/IR/BasicBlock.h>
#include <llvm/IR/Function.h>
#include <llvm/IR/IRBuilder.h>
#include <llvm/IR/Instructions.h>
#include <llvm/IR/Module.h>
#include <llvm/IR/PatternMatch.h>
#include <llvm/TargetParser/Triple.h>
#include <llvm/Transforms/Utils/Local.h>

#include <ranges>
#include <vector>

namespace rung::codegen {
namespace {

// Long blocks are split before instruction selection: the selector and the passes after it search a whole block for
// each instruction, so the time would grow with the square of a rung's length.

constexpr uint32_t kMostInstructions = 512;

// The address computation of a place in a memory block that is an argument of the function.
llvm::GetElementPtrInst* addressOf(llvm::Value& value) {
  auto* address = llvm::dyn_cast<llvm::GetElementPtrInst>(&value);
  const bool isPlace =
      address != nullptr && address->hasAllConstantIndices() && llvm::isa<llvm::Argument>(address->getPointerOperand());
  return isPlace ? address : nullptr;
}

// The instructions before which the block is split. Stack allocations come first, and stay in the first block. Address
// computations do not count: they become part of the instructions that use them, and each block has its own.
std::vector<llvm::Instruction*> cutsOf(llvm::BasicBlock& block) {
  std::vector<llvm::Instruction*> cuts;
  uint32_t count = 0;
  for (llvm::Instruction& instruction : block) {
    if (addressOf(instruction) != nullptr) continue;
    const bool mayBegin = !llvm::isa<llvm::PHINode>(instruction) && !llvm::isa<llvm::AllocaInst>(instruction) &&
                          !instruction.isTerminator();
    if (mayBegin && count >= kMostInstructions) {
      cuts.push_back(&instruction);
      count = 0;
    }
    ++count;
  }
  return cuts;
}

// Copies address computations into the block: the selector folds them into instructions of the same block only, and
// keeps those of other blocks in registers.
void takeAddresses(llvm::BasicBlock& block) {
  llvm::DenseMap<llvm::Instruction*, llvm::Instruction*> own;
  for (llvm::Instruction& instruction : block) {
    if (llvm::isa<llvm::PHINode>(instruction)) continue;
    for (llvm::Use& operand : instruction.operands()) {
      llvm::GetElementPtrInst* address = addressOf(*operand);
      if (address == nullptr || address->getParent() == &block) continue;
      llvm::Instruction*& here = own[address];
      if (here == nullptr) {
        here = address->clone();
        here->insertBefore(block.getFirstInsertionPt());
      }
      operand.set(here);
    }
  }
}

// Must run last of the passes over LLVM's IR: others would merge the blocks again. True: it has changed the function.
bool splitBlocks(llvm::Function& function) {
  std::vector<llvm::Instruction*> cuts;
  for (llvm::BasicBlock& block : function) {
    const std::vector<llvm::Instruction*> ofBlock = cutsOf(block);
    cuts.insert(cuts.end(), ofBlock.begin(), ofBlock.end());
  }
  std::vector<llvm::BasicBlock*> made;
  for (llvm::Instruction* cut : std::ranges::reverse_view(cuts)) // the last first: what follows a split is moved
    made.push_back(cut->getParent()->splitBasicBlock(cut));
  for (llvm::BasicBlock* block : made) takeAddresses(*block);
  return !made.empty();
}

// On x86 a comparison can replace a negation: with bits in bytes, a and not b is b < a, whose flag is stored by one
// instruction; for a negation of the whole, the zero flag is stored.

using namespace llvm::PatternMatch;
using llvm::Value;

using Values = llvm::SmallVector<Value*, 4>;
using Operation = llvm::Instruction::BinaryOps;

// The operands of an and, or of an or.
struct Joined {
  Operation by = llvm::Instruction::And;
  Values plain{};
  Values negated{}; // the operands of negations
};

bool isBit(const Value& value, const llvm::DataLayout& data) {
  return llvm::computeKnownBits(&value, data).countMinLeadingZeros() >= value.getType()->getIntegerBitWidth() - 1;
}

// All bits may be inverted if the others are masked afterwards.
Value* negation(Value& value) {
  Value* inner = nullptr;
  const auto ones = m_CombineOr(m_One(), m_AllOnes());
  return match(&value, m_OneUse(m_Xor(m_Value(inner), ones))) ? inner : nullptr;
}

void collect(llvm::BinaryOperator& join, Joined& joined) {
  for (Value* item : join.operands()) {
    auto* further = llvm::dyn_cast<llvm::BinaryOperator>(item);
    if (further != nullptr && further->getOpcode() == joined.by && further->hasOneUse())
      collect(*further, joined);
    else if (Value* inner = negation(*item))
      joined.negated.push_back(inner);
    else
      joined.plain.push_back(item);
  }
}

class Negations {
public:
  explicit Negations(llvm::Function& function)
      : data_(function.getParent()->getDataLayout()), builder_(function.getContext()) {}

  bool run(llvm::BasicBlock& block) {
    bool changed = false;
    for (llvm::Instruction& at : llvm::make_early_inc_range(block)) {
      if (auto* store = llvm::dyn_cast<llvm::StoreInst>(&at))
        changed = runOnStored(*store->getValueOperand()) || changed;
      if (auto* compare = llvm::dyn_cast<llvm::ICmpInst>(&at)) changed = runOnAsked(*compare) || changed;
    }
    return changed;
  }

private:
  bool runOnStored(Value& stored) {
    auto* bit = llvm::dyn_cast<llvm::BinaryOperator>(&stored);
    llvm::ICmpInst* truth = bit != nullptr ? asTruth(*bit) : nullptr;
    if (truth == nullptr) return false;
    bit->replaceAllUsesWith(builder_.CreateZExt(truth, bit->getType()));
    llvm::RecursivelyDeleteTriviallyDeadInstructions(bit);
    return true;
  }

  // Replaces a test whether a bit is 0.
  bool runOnAsked(llvm::ICmpInst& asked) {
    if (!asked.isEquality() || !match(asked.getOperand(1), m_Zero())) return false;
    auto* bit = llvm::dyn_cast<llvm::BinaryOperator>(asked.getOperand(0));
    llvm::ICmpInst* truth = bit != nullptr && bit->hasOneUse() ? asTruth(*bit) : nullptr;
    if (truth == nullptr) return false;
    if (asked.getPredicate() == llvm::ICmpInst::ICMP_EQ) truth->setPredicate(truth->getInversePredicate());
    asked.replaceAllUsesWith(truth);
    llvm::RecursivelyDeleteTriviallyDeadInstructions(&asked);
    return true;
  }

  // A comparison whose flag is the bit. Null: it would save no negation, or the value has another form.
  llvm::ICmpInst* asTruth(llvm::BinaryOperator& bit) {
    if (!bit.getType()->isIntegerTy(8)) return nullptr;
    builder_.SetInsertPoint(&bit);
    Value* inner = nullptr;
    if (match(&bit, m_Xor(m_Value(inner), m_One()))) return isBit(*inner, data_) ? isZero(inner) : nullptr;
    if (bit.getOpcode() != llvm::Instruction::And && bit.getOpcode() != llvm::Instruction::Or) return nullptr;
    Joined joined{.by = bit.getOpcode()};
    collect(bit, joined);
    const bool isAnd = joined.by == llvm::Instruction::And;
    const auto isBitHere = [&](const Value* value) { return isBit(*value, data_); };
    if (joined.negated.empty() || !isBit(bit, data_) || !llvm::all_of(joined.negated, isBitHere)) return nullptr;
    // An or of bits is a bit; for an and, at least one operand must be a bit.
    if (isAnd && !joined.plain.empty() && llvm::none_of(joined.plain, isBitHere)) {
      joined.plain.front() = asBit(*joined.plain.front());
      if (joined.plain.front() == nullptr) return nullptr;
    }
    Value* negated = join(joined.negated, isAnd ? llvm::Instruction::Or : llvm::Instruction::And);
    if (joined.plain.empty()) return isZero(negated);
    Value* plain = join(joined.plain, joined.by);
    return isAnd ? compare(llvm::ICmpInst::ICMP_ULT, negated, plain)
                 : compare(llvm::ICmpInst::ICMP_UGE, plain, negated);
  }

  // Replaces an or that inverts all bits of an operand by one that inverts the lowest. Null: the value has another
  // form.
  Value* asBit(Value& value) {
    auto* both = llvm::dyn_cast<llvm::BinaryOperator>(&value);
    if (both == nullptr || both->getOpcode() != llvm::Instruction::Or) return nullptr;
    Values items;
    for (Value* item : both->operands()) {
      Value* inner = item;
      match(item, m_Not(m_Value(inner)));
      if (!isBit(*inner, data_)) return nullptr;
      items.push_back(inner == item ? item : builder_.CreateXor(inner, 1));
    }
    return join(items, llvm::Instruction::Or);
  }

  llvm::ICmpInst* compare(llvm::ICmpInst::Predicate how, Value* a, Value* b) {
    return builder_.Insert(new llvm::ICmpInst(how, a, b));
  }
  llvm::ICmpInst* isZero(Value* value) {
    return compare(llvm::ICmpInst::ICMP_EQ, value, llvm::ConstantInt::get(value->getType(), 0));
  }

  Value* join(const Values& items, Operation by) {
    Value* all = items.front();
    for (Value* item : llvm::drop_begin(items)) all = builder_.CreateBinOp(by, all, item);
    return all;
  }

  const llvm::DataLayout& data_;
  llvm::IRBuilder<> builder_;
};

// Must run at the end of the passes over LLVM's IR: earlier ones would restore the negations. For functions of chunks,
// on x86. True: it has changed the function.
bool negateInFlags(llvm::Function& function) {
  Negations negations(function);
  bool changed = false;
  for (llvm::BasicBlock& block : function) changed = negations.run(block) || changed;
  return changed;
}

// The pass.
class BeforeSelection final : public llvm::FunctionPass {
public:
  BeforeSelection() : FunctionPass(kId) {}

  bool doInitialization(llvm::Module& module) override {
    isX86_ = llvm::Triple(module.getTargetTriple()).isX86();
    return false;
  }

  bool runOnFunction(llvm::Function& function) override {
    const bool changed = isX86_ && function.hasFnAttribute(kChunkAttribute) && negateInFlags(function);
    return splitBlocks(function) || changed; // the last, because it copies addresses into the blocks that it splits
  }

private:
  static char kId; // LLVM identifies a pass by its address
  bool isX86_ = false;
};

char BeforeSelection::kId = 0;

} // namespace

std::unique_ptr<llvm::FunctionPass> makeBeforeSelection() { return std::make_unique<BeforeSelection>(); }

} // namespace rung::codegen

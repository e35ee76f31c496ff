// See negations_in_flags.h.
#include "codegen/llvm/negations_in_flags.h"

#include <llvm/ADT/STLExtras.h>
#include <llvm/Analysis/ValueTracking.h>
#include <llvm/IR/Function.h>
#include <llvm/IR/IRBuilder.h>
#include <llvm/IR/Module.h>
#include <llvm/IR/PatternMatch.h>
#include <llvm/Transforms/Utils/Local.h>

namespace rung::codegen {
namespace {

using namespace llvm::PatternMatch;
using llvm::Value;

using Values = llvm::SmallVector<Value*, 4>;
using Operation = llvm::Instruction::BinaryOps;

// What an and, or an or, joins.
struct Joined {
  Operation by = llvm::Instruction::And;
  Values plain{};
  Values negated{}; // without their negation
};

bool isBit(const Value& value, const llvm::DataLayout& data) {
  return llvm::computeKnownBits(&value, data).countMinLeadingZeros() >= value.getType()->getIntegerBitWidth() - 1;
}

// All bits may be inverted where the others are cut off afterwards.
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

  // Where it is asked whether a bit is 0.
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

  // Whether a bit is set, by flags. Null: no negation would be saved, or it is something else.
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
    // An or of bits is one; of an and one item at least has to be.
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

  // An or that inverts all bits of an item, with one that inverts the lowest. Null: it is something else.
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

} // namespace

bool negateInFlags(llvm::Function& function) {
  Negations negations(function);
  bool changed = false;
  for (llvm::BasicBlock& block : function) changed = negations.run(block) || changed;
  return changed;
}

} // namespace rung::codegen

// Emits operations with values, and stores, as LLVM instructions (see chunk_emitter.h).
#include "codegen/llvm/chunk_emitter.h"

#include <fmt/format.h>
#include <llvm/IR/MDBuilder.h>
#include <llvm/IR/PatternMatch.h>

#include "ir/core/op_info.h"
#include "ir/core/ops.h"
#include "ir/support/check.h"

namespace rung::codegen {

using namespace ir;

llvm::Type* ChunkEmitter::type(Type type) const {
  llvm::LLVMContext& context = target_.getContext();
  if (type == Type::F64) return llvm::Type::getDoubleTy(context);
  return llvm::Type::getIntNTy(context, std::max(bitWidth(type), bitsAreBytes_ ? 8u : 1u));
}

// An i1 is masked wherever another block or memory uses it, so a byte, 0 or 1, is better for bits that are stored in
// bytes; but a comparison that is combined with bits, and a bit within a byte, must be converted to a byte. The more
// frequent case in the chunk decides.
bool ChunkEmitter::hasMostlyBytes(const ChunkPlan& plan) const {
  uint32_t bytes = 0;
  uint32_t others = 0;
  for (uint32_t i = plan.chunk.firstRung; i < plan.endRung(); ++i) {
    const Rung& rung = plan.routine.rungs[i];
    std::vector<bool> isTruth(rung.values.size(), false); // a comparison's
    for (const Op& op : rung.ops) {
      if (op.resultCount == 1 && opInfo(op.code).result == Constraint::Bit && op.type != Type::Bit)
        isTruth[op.result.index] = true;
      if (op.type != Type::Bit) continue;
      if (opInfo(op.code).attr == Attr::Slot) ++bytes;
      if (op.code == OpCode::Load || op.code == OpCode::Store)
        ++(layout_.memory().bit(SpaceId{op.ref}, static_cast<uint64_t>(op.imm)).wholeByte ? bytes : others);
      if (op.code == OpCode::And || op.code == OpCode::Or || op.code == OpCode::Xor)
        others += isTruth[ir::arg(rung, op, 0).index] || isTruth[ir::arg(rung, op, 1).index] ? 2 : 0;
    }
  }
  return bytes >= 2 * others;
}

// If asBit made the bit from a comparison, that comparison.
ChunkEmitter::Value* ChunkEmitter::isSet(Value* bit) {
  if (!bitsAreBytes_) return bit;
  const auto* extended = llvm::dyn_cast<llvm::ZExtInst>(bit);
  if (extended != nullptr && extended->getSrcTy()->isIntegerTy(1)) return extended->getOperand(0);
  return builder_.CreateIsNotNull(bit);
}

ChunkEmitter::Value* ChunkEmitter::result(const Op& op) {
  if (isEvaluable(opInfo(op.code))) {
    Value* value = instruction(op);
    return value != nullptr ? value : callSem(op);
  }
  switch (op.code) {
  case OpCode::Const:
    if (op.type == Type::F64)
      return builder_.CreateBitCast(builder_.getInt64(static_cast<uint64_t>(op.imm)), type(op.type));
    return llvm::ConstantInt::get(type(op.type), static_cast<uint64_t>(op.imm));
  case OpCode::Load: return load(op);
  case OpCode::LoadAt: return loadAt(op);
  case OpCode::LoadBitAt: return loadBitAt(op);
  case OpCode::SlotLoad: {
    Value* place = at(layout_.memory().slot(SlotId{op.ref}));
    if (op.type == Type::Bit) return readFlag(place);
    return builder_.CreateAlignedLoad(type(op.type), place, alignOf(layout_.memory().slot(SlotId{op.ref}), op.type));
  }
  case OpCode::Now: return builder_.CreateLoad(builder_.getInt64Ty(), ctxField(AbiTypes::kNow));
  case OpCode::ServiceRequest: return serviceRequest(op);
  case OpCode::ServicePoll: return callHost(AbiTypes::kServicePoll, builder_.getInt32Ty(), {arg(op, 0)});
  case OpCode::ServiceResult:
    return callHost(AbiTypes::kServiceResult, builder_.getInt64Ty(), {arg(op, 0), num(static_cast<uint64_t>(op.imm))});
  default: break;
  }
  RUNG_CHECK(false, "not an operation with one result");
  return nullptr;
}

// The LLVM instruction for a value operation, if its semantics are exactly the same; otherwise null.
ChunkEmitter::Value* ChunkEmitter::instruction(const Op& op) {
  switch (op.code) {
  case OpCode::Select: return builder_.CreateSelect(isSet(arg(op, 0)), arg(op, 1), arg(op, 2));
  case OpCode::ZExt: return builder_.CreateZExt(arg(op, 0), type(op.type));
  case OpCode::SExt: {
    const bool byte = bitsAreBytes_ && typeOf(*rung_, ir::arg(*rung_, op, 0)) == Type::Bit;
    return byte ? builder_.CreateNeg(builder_.CreateZExt(arg(op, 0), type(op.type)))
                : builder_.CreateSExt(arg(op, 0), type(op.type));
  }
  case OpCode::Trunc: {
    Value* low = builder_.CreateTrunc(arg(op, 0), type(op.type));
    return bitsAreBytes_ && op.type == Type::Bit ? builder_.CreateAnd(low, 1) : low;
  }
  case OpCode::FNeg: return builder_.CreateFNeg(arg(op, 0));
  case OpCode::FAbs: return builder_.CreateUnaryIntrinsic(llvm::Intrinsic::fabs, arg(op, 0));
  case OpCode::IntToF: return builder_.CreateSIToFP(arg(op, 0), type(op.type));
  case OpCode::BitsToF:
  case OpCode::FToBits: return builder_.CreateBitCast(arg(op, 0), type(op.type));
  case OpCode::PopCount: return builder_.CreateUnaryIntrinsic(llvm::Intrinsic::ctpop, arg(op, 0));
  case OpCode::Add:
  case OpCode::Sub:
  case OpCode::Mul:
  case OpCode::Neg:
  case OpCode::And:
  case OpCode::Or:
  case OpCode::Xor:
  case OpCode::Not:
  case OpCode::Eq:
  case OpCode::Ne:
  case OpCode::LtS:
  case OpCode::LeS:
  case OpCode::LtU:
  case OpCode::LeU:
  case OpCode::FEq:
  case OpCode::FLt:
  case OpCode::FLe: return arithmetic(op);
  case OpCode::DivS:
  case OpCode::DivU:
  case OpCode::RemS:
  case OpCode::RemU: return divide(op);
  case OpCode::Shl:
  case OpCode::ShrU:
  case OpCode::ShrS: return shift(op);
  default: return nullptr;
  }
}

// ---- arithmetic --------------------------------------------------------------------------------------------------

static llvm::CmpInst::Predicate predicateOf(OpCode code) {
  switch (code) {
  case OpCode::Eq: return llvm::CmpInst::ICMP_EQ;
  case OpCode::Ne: return llvm::CmpInst::ICMP_NE;
  case OpCode::LtS: return llvm::CmpInst::ICMP_SLT;
  case OpCode::LeS: return llvm::CmpInst::ICMP_SLE;
  case OpCode::LtU: return llvm::CmpInst::ICMP_ULT;
  case OpCode::LeU: return llvm::CmpInst::ICMP_ULE;
  case OpCode::FEq: return llvm::CmpInst::FCMP_OEQ;
  case OpCode::FLt: return llvm::CmpInst::FCMP_OLT;
  default: RUNG_CHECK(code == OpCode::FLe, "an operation of LLVM's own"); return llvm::CmpInst::FCMP_OLE;
  }
}

namespace {

// Whether `wide` differs from its low bits, sign-extended in `truncated`, as the overflow flag of processors: if `wide`
// is a sum, a difference or a product of numbers with the width of these low bits. Null: it is not.
llvm::Value* overflow(llvm::IRBuilder<>& builder, llvm::Value* truncated, llvm::Value* wide) {
  using namespace llvm::PatternMatch;
  const auto* result = llvm::dyn_cast<llvm::BinaryOperator>(wide);
  if (result == nullptr || !match(truncated, m_SExt(m_Trunc(m_Specific(wide))))) return nullptr;
  llvm::Type* kept = llvm::cast<llvm::SExtInst>(truncated)->getSrcTy();
  if (wide->getType()->getIntegerBitWidth() < 2 * kept->getIntegerBitWidth()) return nullptr;
  llvm::Intrinsic::ID operation = 0;
  if (result->getOpcode() == llvm::Instruction::Add) operation = llvm::Intrinsic::sadd_with_overflow;
  if (result->getOpcode() == llvm::Instruction::Sub) operation = llvm::Intrinsic::ssub_with_overflow;
  if (result->getOpcode() == llvm::Instruction::Mul) operation = llvm::Intrinsic::smul_with_overflow;
  const auto isNarrow = [&](const llvm::Value* operand) {
    const auto* widened = llvm::dyn_cast<llvm::SExtInst>(operand);
    return widened != nullptr && widened->getSrcTy() == kept;
  };
  if (operation == 0 || !isNarrow(result->getOperand(0)) || !isNarrow(result->getOperand(1))) return nullptr;
  const auto narrow = [&](unsigned i) { return llvm::cast<llvm::SExtInst>(result->getOperand(i))->getOperand(0); };
  return builder.CreateExtractValue(builder.CreateBinaryIntrinsic(operation, narrow(0), narrow(1)), 1);
}

} // namespace

ChunkEmitter::Value* ChunkEmitter::arithmetic(const Op& op) {
  Value* a = arg(op, 0);
  if (op.code == OpCode::Neg) return builder_.CreateNeg(a);
  const bool byte = bitsAreBytes_ && op.type == Type::Bit;
  if (op.code == OpCode::Not) return byte ? builder_.CreateXor(a, 1) : builder_.CreateNot(a);
  Value* b = arg(op, 1);
  if (op.code == OpCode::Add) return builder_.CreateAdd(a, b);
  if (op.code == OpCode::Sub) return builder_.CreateSub(a, b);
  if (op.code == OpCode::Mul) return builder_.CreateMul(a, b);
  if (op.code == OpCode::And) return builder_.CreateAnd(a, b);
  if (op.code == OpCode::Or) return builder_.CreateOr(a, b);
  if (op.code == OpCode::Xor) return builder_.CreateXor(a, b);
  if (op.code == OpCode::Ne)
    if (Value* tooWide = overflow(builder_, a, b)) return asBit(tooWide);
  return asBit(builder_.CreateCmp(predicateOf(op.code), a, b));
}

// By a number below the width, LLVM's shifts have the IR's semantics.
ChunkEmitter::Value* ChunkEmitter::shift(const Op& op) {
  const auto* count = llvm::dyn_cast<llvm::ConstantInt>(arg(op, 1));
  if (count == nullptr || count->getZExtValue() >= bitWidth(op.type)) return nullptr;
  Value* a = arg(op, 0);
  if (op.code == OpCode::Shl) return builder_.CreateShl(a, count->getZExtValue());
  if (op.code == OpCode::ShrU) return builder_.CreateLShr(a, count->getZExtValue());
  return builder_.CreateAShr(a, count->getZExtValue());
}

// By a number other than 0 and -1, LLVM's divisions have the IR's semantics.
ChunkEmitter::Value* ChunkEmitter::divide(const Op& op) {
  auto* divisor = llvm::dyn_cast<llvm::ConstantInt>(arg(op, 1));
  if (divisor == nullptr || divisor->isZero() || divisor->isMinusOne()) return nullptr;
  Value* a = arg(op, 0);
  if (op.code == OpCode::DivS) return builder_.CreateSDiv(a, divisor);
  if (op.code == OpCode::DivU) return builder_.CreateUDiv(a, divisor);
  if (op.code == OpCode::RemS) return builder_.CreateSRem(a, divisor);
  return builder_.CreateURem(a, divisor);
}

// The functions take and return bits as bool, which is an i1.
ChunkEmitter::Value* ChunkEmitter::callSem(const Op& op) {
  std::vector<Value*> args;
  std::vector<llvm::Type*> types;
  for (int i = 0; i < op.argCount; ++i) {
    const bool bit = typeOf(*rung_, ir::arg(*rung_, op, i)) == Type::Bit;
    args.push_back(bit ? isSet(arg(op, i)) : arg(op, i));
    types.push_back(args.back()->getType());
  }
  const bool givesBit = typeOf(*rung_, op.result) == Type::Bit;
  llvm::Type* result = givesBit ? builder_.getInt1Ty() : type(op.type);
  const std::string name = fmt::format("rung_sem_{}_{}", opInfo(op.code).name, typeName(op.type));
  llvm::CallInst* call =
      builder_.CreateCall(target_.getOrInsertFunction(name, llvm::FunctionType::get(result, types, false)), args);
  call->setDoesNotThrow();
  return givesBit ? asBit(call) : call;
}

// ---- memory ------------------------------------------------------------------------------------------------------

// The alignment of an offset in the memory block, which is aligned itself: at most that of the type.
llvm::Align ChunkEmitter::alignOf(uint64_t offset, Type type) const {
  return std::min(llvm::commonAlignment(llvm::Align(kBlockAlign), offset), llvm::Align(std::max(1u, byteWidth(type))));
}

// The runtime keeps the byte of an expanded bit at 0 or 1.
ChunkEmitter::Value* ChunkEmitter::readFlag(Value* address) {
  llvm::LoadInst* byte = builder_.CreateLoad(builder_.getInt8Ty(), address);
  byte->setMetadata(llvm::LLVMContext::MD_range,
                    llvm::MDBuilder(builder_.getContext()).createRange(llvm::APInt(8, 0), llvm::APInt(8, 2)));
  return bitsAreBytes_ ? byte : builder_.CreateTrunc(byte, builder_.getInt1Ty());
}

ChunkEmitter::Value* ChunkEmitter::readBit(Value* address, Value* bit) {
  Value* byte = builder_.CreateLoad(builder_.getInt8Ty(), address);
  return asBit(builder_.CreateIsNotNull(builder_.CreateAnd(byte, builder_.CreateShl(builder_.getInt8(1), bit))));
}

void ChunkEmitter::writeBit(Value* address, Value* bit, Value* value) {
  Value* mask = builder_.CreateShl(builder_.getInt8(1), bit);
  Value* others = builder_.CreateAnd(builder_.CreateLoad(builder_.getInt8Ty(), address), builder_.CreateNot(mask));
  builder_.CreateStore(builder_.CreateOr(others, builder_.CreateShl(asByte(value), bit)), address);
}

ChunkEmitter::Value* ChunkEmitter::load(const Op& op) {
  if (op.type == Type::Bit) {
    const BitLocation place = layout_.memory().bit(SpaceId{op.ref}, static_cast<uint64_t>(op.imm));
    if (!place.wholeByte) return readBit(at(place.offset), builder_.getInt8(static_cast<uint8_t>(place.bit)));
    return readFlag(at(place.offset));
  }
  const uint32_t offset = layout_.memory().byte(SpaceId{op.ref}, static_cast<uint32_t>(op.imm / 8));
  return builder_.CreateAlignedLoad(type(op.type), at(offset), alignOf(offset, op.type));
}

void ChunkEmitter::store(const Op& op) {
  Value* value = arg(op, 0);
  if (op.type == Type::Bit) {
    const BitLocation place = layout_.memory().bit(SpaceId{op.ref}, static_cast<uint64_t>(op.imm));
    if (!place.wholeByte) return writeBit(at(place.offset), builder_.getInt8(static_cast<uint8_t>(place.bit)), value);
    builder_.CreateStore(asByte(value), at(place.offset));
    return;
  }
  const uint32_t offset = layout_.memory().byte(SpaceId{op.ref}, static_cast<uint32_t>(op.imm / 8));
  builder_.CreateAlignedStore(value, at(offset), alignOf(offset, op.type));
}

void ChunkEmitter::slotStore(const Op& op) {
  Value* value = arg(op, 0);
  if (op.type == Type::Bit) value = asByte(value);
  const uint32_t offset = layout_.memory().slot(SlotId{op.ref});
  builder_.CreateAlignedStore(value, at(offset), alignOf(offset, op.type));
}

// A place in a window that a computed index may miss.
struct ChunkEmitter::Element {
  Value* inside;  // whether the access is legal
  Value* address; // always valid: that of element 0 if the index is out of range
  Value* bit;     // i8, for an access to a bit
  llvm::Align align;
};

ChunkEmitter::Element ChunkEmitter::element(const Op& op, bool isBit) {
  const uint32_t unit = module_.spaces[op.ref].unitBytes;
  const uint32_t base = layout_.memory().byte(SpaceId{op.ref}, static_cast<uint32_t>(op.imm / 8));
  Value* inside = builder_.CreateICmpULT(arg(op, 0), num(op.count));
  if (isBit) inside = builder_.CreateAnd(inside, builder_.CreateICmpULT(arg(op, 1), num(uint64_t{unit} * 8)));
  const auto legal = [&](Value* index) {
    return builder_.CreateZExt(builder_.CreateSelect(inside, index, num(0)), builder_.getInt64Ty());
  };
  Value* offset = builder_.CreateMul(legal(arg(op, 0)), builder_.getInt64(unit));
  Value* bit = nullptr;
  if (isBit) {
    Value* number = legal(arg(op, 1));
    offset = builder_.CreateAdd(offset, builder_.CreateLShr(number, 3));
    bit = builder_.CreateTrunc(builder_.CreateAnd(number, 7), builder_.getInt8Ty());
  }
  return {inside, builder_.CreateInBoundsGEP(builder_.getInt8Ty(), at(base), offset), bit,
          llvm::commonAlignment(alignOf(base, op.type), unit)};
}

ChunkEmitter::Value* ChunkEmitter::loadAt(const Op& op) {
  llvm::Constant* none = llvm::Constant::getNullValue(type(op.type));
  if (op.count == 0) return none;
  const Element place = element(op, false);
  return builder_.CreateSelect(place.inside, builder_.CreateAlignedLoad(type(op.type), place.address, place.align),
                               none);
}

ChunkEmitter::Value* ChunkEmitter::loadBitAt(const Op& op) {
  if (op.count == 0) return llvm::ConstantInt::get(type(Type::Bit), 0);
  const Element place = element(op, true);
  return builder_.CreateAnd(asBit(place.inside), readBit(place.address, place.bit));
}

void ChunkEmitter::storeAt(const Op& op) {
  if (op.count == 0) return;
  const bool isBit = op.code == OpCode::StoreBitAt;
  const Element place = element(op, isBit);
  Value* value = arg(op, isBit ? 2 : 1);
  llvm::BasicBlock* write = block("write");
  llvm::BasicBlock* done = block("done");
  builder_.CreateCondBr(place.inside, write, done);
  builder_.SetInsertPoint(write);
  if (isBit)
    writeBit(place.address, place.bit, value);
  else
    builder_.CreateAlignedStore(value, place.address, place.align);
  builder_.CreateBr(done);
  builder_.SetInsertPoint(done);
}

} // namespace rung::codegen

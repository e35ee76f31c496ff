// Emits chunks, regions, exits and host calls (see chunk_emitter.h); operations with values are in value_emitter.cpp.
#include "codegen/llvm/chunk_emitter.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <llvm/IR/IntrinsicsAArch64.h>
#include <llvm/IR/IntrinsicsX86.h>
#include <llvm/IR/MDBuilder.h>

#include "codegen/llvm/before_selection.h"
#include "ir/core/op_info.h"
#include "ir/core/ops.h"
#include "ir/support/check.h"

namespace rung::codegen {

using namespace ir;

ChunkEmitter::ChunkEmitter(llvm::Module& target, const Layout& layout, const LlvmOptions& options, DebugInfo* debug,
                           const CodeUnitNumbers* numbers)
    : target_(target), layout_(layout), module_(layout.module()), options_(options), debug_(debug), numbers_(numbers),
      abi_(target.getContext()), builder_(target.getContext()),
      extendsWords_(llvm::Triple(target.getTargetTriple()).isRISCV64()) {
  abi_.check(target.getDataLayout());
}

llvm::Function* ChunkEmitter::emit(uint32_t chunk) {
  const ChunkPlan plan = planOf(layout_, chunk);
  beginFunction(plan);
  if (plan.addsWeight) builder_.CreateStore(num(0), scratch(extra_, builder_.getInt32Ty()));
  for (uint32_t i = plan.chunk.firstRung; i < plan.endRung(); ++i) {
    if (!beginRung(i)) continue;
    emitRung(plan.routine.rungs[i], layout_.partition().rungNumber(plan.chunk.routine, i));
    emitExit(plan.exit(i));
  }
  return function_;
}

void ChunkEmitter::beginFunction(const ChunkPlan& plan) {
  bitsAreBytes_ = hasMostlyBytes(plan);
  const Rung& first = plan.routine.rungs[plan.chunk.firstRung];
  const bool isNamed = numbers_ == nullptr || debug_ != nullptr; // else the cached code may serve elsewhere
  const std::string name = isNamed ? fmt::format("{}.{}", plan.routine.name, plan.chunk.firstRung) : "chunk";
  auto* signature = llvm::FunctionType::get(builder_.getInt32Ty(),
                                            {builder_.getPtrTy(), builder_.getPtrTy(), builder_.getInt32Ty()}, false);
  function_ = llvm::Function::Create(signature, llvm::GlobalValue::InternalLinkage, name, target_);
  function_->setDoesNotThrow();
  function_->addFnAttr("frame-pointer", "non-leaf");
  function_->addFnAttr(kChunkAttribute);
  if (!plan.hostReads) function_->addParamAttr(0, llvm::Attribute::NoAlias);
  if (extendsWords_) function_->addRetAttr(llvm::Attribute::SExt);
  mem_ = function_->getArg(0);
  mem_->setName("mem");
  ctx_ = function_->getArg(1);
  ctx_->setName("ctx");
  function_->getArg(2)->setName("chunk");
  messageSpace_ = argsSpace_ = valueSpace_ = extra_ = nullptr;
  if (debug_ != nullptr) debug_->beginFunction(*function_, name, first.begin.file, first.begin.line);
  builder_.SetInsertPoint(block("entry"));
  builder_.SetCurrentDebugLocation({}); // not that of another function
  firstRung_ = plan.chunk.firstRung;
  rungBlocks_.assign(plan.chunk.rungCount, nullptr);
  if (debug_ != nullptr) showMemory();
}

// False: control never reaches the rung. All jumps to a rung come from rungs above it.
bool ChunkEmitter::beginRung(uint32_t rung) {
  llvm::BasicBlock* own = rungBlocks_[rung - firstRung_];
  const bool falls = builder_.GetInsertBlock()->getTerminator() == nullptr;
  if (own == nullptr) return falls;
  if (falls) {
    builder_.SetCurrentDebugLocation({});
    builder_.CreateBr(own);
  }
  if (own != &function_->back()) own->moveAfter(&function_->back());
  builder_.SetInsertPoint(own);
  return true;
}

void ChunkEmitter::setLine(uint32_t line) {
  if (debug_ != nullptr)
    builder_.SetCurrentDebugLocation(debug_->at(rung_->begin.file, line != 0 ? line : rung_->begin.line));
}

// The number as the address of a symbol, whose value the linker supplies.
llvm::GlobalVariable* ChunkEmitter::symbol(CodeUnitNumbers::Kind kind, uint32_t number) {
  const std::string name = CodeUnitNumbers::name(numbers_->index(kind, number));
  if (llvm::GlobalVariable* known = target_.getNamedGlobal(name)) return known;
  auto* made =
      new llvm::GlobalVariable(target_, builder_.getInt8Ty(), true, llvm::GlobalValue::ExternalLinkage, nullptr, name);
  llvm::Type* word = builder_.getIntPtrTy(target_.getDataLayout());
  llvm::Metadata* range[] = {llvm::ConstantAsMetadata::get(llvm::ConstantInt::get(word, 0)),
                             llvm::ConstantAsMetadata::get(llvm::ConstantInt::get(word, uint64_t{1} << 31))};
  made->setMetadata(llvm::LLVMContext::MD_absolute_symbol, llvm::MDNode::get(target_.getContext(), range));
  return made;
}

llvm::Constant* ChunkEmitter::number(CodeUnitNumbers::Kind kind, uint32_t number) {
  if (numbers_ == nullptr) return builder_.getInt32(number);
  return llvm::ConstantExpr::getPtrToInt(symbol(kind, number), builder_.getInt32Ty());
}

// Stores the address of the memory block where a debugger finds it throughout the function.
void ChunkEmitter::showMemory() {
  llvm::AllocaInst* slot = builder_.CreateAlloca(builder_.getPtrTy());
  builder_.CreateStore(mem_, slot, true); // volatile, or the slot would be optimised away
  debug_->declareMemory(slot, builder_.GetInsertBlock());
}

// With debug information, stores of earlier lines reach memory before a line begins, and its loads come after that: a
// fence within the thread, which generates no instruction.
void ChunkEmitter::settleMemory(const Op& op) {
  if (debug_ == nullptr || options_.level == LlvmLevel::Fast) return;
  const uint32_t line = lineOf(*rung_, op);
  if (line != settledLine_)
    builder_.CreateFence(llvm::AtomicOrdering::SequentiallyConsistent, llvm::SyncScope::SingleThread);
  const bool border = op.code == OpCode::If || op.code == OpCode::Else || op.code == OpCode::EndIf ||
                      op.code == OpCode::Loop || op.code == OpCode::EndLoop;
  settledLine_ = border ? 0 : line;
}

void ChunkEmitter::emitRung(const Rung& rung, uint32_t number) {
  rung_ = &rung;
  number_ = number;
  settledLine_ = 0;
  values_.assign(rung.values.size(), nullptr);
  throughMemory_ = valuesThroughMemory(rung);
  join_.reset();
  for (const Op& op : rung.ops) {
    setLine(op.line);
    settleMemory(op);
    emitOp(op);
  }
  RUNG_CHECK(regions_.empty(), "regions are closed within their rung");
}

void ChunkEmitter::emitOp(const Op& op) {
  switch (op.code) {
  case OpCode::Store: return store(op);
  case OpCode::StoreAt:
  case OpCode::StoreBitAt: return storeAt(op);
  case OpCode::SlotStore: return slotStore(op);
  case OpCode::If: return openIf(op);
  case OpCode::Else: return turnElse(op);
  case OpCode::EndIf: return closeIf(op);
  case OpCode::Loop: return openLoop(op);
  case OpCode::EndLoop: return closeLoop(op);
  case OpCode::Message: return message(op);
  case OpCode::Trap: return trap(op);
  case OpCode::Note: return;
  case OpCode::ProfEnter: return profEnter();
  case OpCode::ProfLeave: return profLeave();
  default: break; // one result each, handled by result()
  }
  Value* value = result(op);
  const bool through = !throughMemory_.empty() && throughMemory_[op.result.index];
  values_[op.result.index] = through ? throughMemory(value) : value;
}

// See regions.h; volatile, or it would be optimised away.
ChunkEmitter::Value* ChunkEmitter::throughMemory(Value* value) {
  Value* place = scratch(valueSpace_, builder_.getInt64Ty());
  builder_.CreateStore(value, place, true);
  return builder_.CreateLoad(value->getType(), place, true);
}

// ---- regions -----------------------------------------------------------------------------------------------------

void ChunkEmitter::openIf(const Op& op) {
  llvm::BasicBlock* then = block("then");
  llvm::BasicBlock* other = block("else");
  llvm::MDBuilder branchWeights(builder_.getContext());
  llvm::MDNode* weights = nullptr;
  if (op.ref == kMostly) weights = branchWeights.createLikelyBranchWeights();
  if (op.ref == kSeldom) weights = branchWeights.createUnlikelyBranchWeights();
  builder_.CreateCondBr(isSet(arg(op, 0)), then, other, weights);
  regions_.push_back({.opener = &op, .head = builder_.GetInsertBlock(), .other = other, .end = other});
  builder_.SetInsertPoint(then);
}

void ChunkEmitter::turnElse(const Op& op) {
  Region& region = regions_.back();
  for (int i = 0; i < op.argCount; ++i) region.yields.push_back(arg(op, i));
  region.end = block("endif");
  builder_.CreateBr(region.end);
  region.firstExit = builder_.GetInsertBlock();
  builder_.SetInsertPoint(region.other);
}

void ChunkEmitter::closeIf(const Op& op) {
  const Region region = std::move(regions_.back());
  regions_.pop_back();
  std::vector<Value*> yields;
  for (int i = 0; i < op.argCount; ++i) yields.push_back(arg(op, i));
  builder_.CreateBr(region.end);
  llvm::BasicBlock* secondExit = builder_.GetInsertBlock();
  builder_.SetInsertPoint(region.end);
  if (op.resultCount == 0) {
    const bool hasElse = region.firstExit != nullptr;
    join_ = {.cond = ir::arg(*rung_, *region.opener, 0),
             .end = region.end,
             .whenTrue = hasElse ? region.firstExit : secondExit,
             .whenFalse = hasElse ? secondExit : region.head};
  }
  for (size_t i = 0; i < op.resultCount; ++i) {
    llvm::PHINode* phi = builder_.CreatePHI(yields[i]->getType(), 2);
    phi->addIncoming(region.yields[i], region.firstExit);
    phi->addIncoming(yields[i], secondExit);
    values_[op.result.index + i] = phi;
  }
}

void ChunkEmitter::openLoop(const Op& op) {
  std::vector<Value*> first{num(0)};
  for (int i = 0; i < op.argCount; ++i) first.push_back(arg(op, i));
  llvm::BasicBlock* before = builder_.GetInsertBlock();
  Region region{.opener = &op, .head = block("loop"), .other = block("endloop"), .end = nullptr};
  llvm::BasicBlock* body = block("pass");
  builder_.CreateBr(region.head);
  builder_.SetInsertPoint(region.head);
  for (size_t i = 0; i < first.size(); ++i) {
    region.phis.push_back(builder_.CreatePHI(first[i]->getType(), 2));
    region.phis.back()->addIncoming(first[i], before);
    values_[op.result.index + i] = region.phis.back();
  }
  builder_.CreateCondBr(builder_.CreateICmpULT(region.phis[0], num(op.count)), body, region.other);
  builder_.SetInsertPoint(body);
  regions_.push_back(std::move(region));
}

void ChunkEmitter::closeLoop(const Op& op) {
  const Region region = std::move(regions_.back());
  regions_.pop_back();
  llvm::BasicBlock* latch = builder_.GetInsertBlock();
  region.phis[0]->addIncoming(builder_.CreateAdd(region.phis[0], num(1)), latch);
  for (size_t i = 1; i < region.phis.size(); ++i) region.phis[i]->addIncoming(arg(op, static_cast<int>(i) - 1), latch);
  builder_.CreateBr(region.head);
  builder_.SetInsertPoint(region.other);
  for (size_t i = 0; i < op.resultCount; ++i) values_[op.result.index + i] = region.phis[i + 1];
}

// ---- host --------------------------------------------------------------------------------------------------------

ChunkEmitter::Value* ChunkEmitter::scratch(Value*& kept, llvm::Type* type) {
  if (kept == nullptr) {
    llvm::IRBuilder<>::InsertPointGuard guard(builder_);
    builder_.SetInsertPoint(&function_->getEntryBlock(), function_->getEntryBlock().begin());
    kept = builder_.CreateAlloca(type);
  }
  return kept;
}

ChunkEmitter::Value* ChunkEmitter::callHost(AbiTypes::HostField function, llvm::Type* result,
                                            std::vector<Value*> args) {
  args.insert(args.begin(), ctx_);
  std::vector<llvm::Type*> types;
  for (Value* value : args) types.push_back(value->getType());
  Value* host = builder_.CreateLoad(builder_.getPtrTy(), ctxField(AbiTypes::kHost));
  Value* pointer = builder_.CreateLoad(builder_.getPtrTy(), builder_.CreateStructGEP(abi_.hostApi, host, function));
  llvm::CallInst* call = builder_.CreateCall(llvm::FunctionType::get(result, types, false), pointer, args);
  call->setDoesNotThrow();
  if (!extendsWords_) return call;
  for (unsigned i = 0; i < types.size(); ++i)
    if (types[i]->isIntegerTy(32)) call->addParamAttr(i, llvm::Attribute::SExt);
  if (result->isIntegerTy(32)) call->addRetAttr(llvm::Attribute::SExt);
  return call;
}

void ChunkEmitter::message(const Op& op) {
  Value* space = scratch(messageSpace_, abi_.message);
  const auto set = [&](AbiTypes::MessageField field, Value* value) {
    builder_.CreateStore(value, builder_.CreateStructGEP(abi_.message, space, field));
  };
  Value* value = arg(op, 3);
  const bool real = value->getType()->isDoubleTy();
  set(AbiTypes::kMessageOp, num(op.ref));
  set(AbiTypes::kNumber, arg(op, 0));
  set(AbiTypes::kChannel, arg(op, 1));
  set(AbiTypes::kIndex, arg(op, 2));
  set(AbiTypes::kValue, real ? builder_.CreateBitCast(value, builder_.getInt64Ty()) : value);
  set(AbiTypes::kReal, num(real ? 1 : 0));
  set(AbiTypes::kRung, number(CodeUnitNumbers::Kind::Rung, number_));
  callHost(AbiTypes::kMessage, builder_.getVoidTy(), {space});
}

ChunkEmitter::Value* ChunkEmitter::serviceRequest(const Op& op) {
  auto* array = llvm::ArrayType::get(builder_.getInt64Ty(), RUNG_MAX_SERVICE_ARGS);
  Value* space = scratch(argsSpace_, array);
  for (int i = 0; i < op.argCount; ++i)
    builder_.CreateStore(arg(op, i), builder_.CreateConstInBoundsGEP2_32(array, space, 0, static_cast<unsigned>(i)));
  return callHost(AbiTypes::kServiceRequest, builder_.getInt32Ty(), {num(op.ref), space, num(op.argCount)});
}

void ChunkEmitter::trap(const Op& op) {
  llvm::BasicBlock* fault = block("fault");
  llvm::BasicBlock* go = block("go");
  llvm::MDBuilder branchWeights(builder_.getContext());
  builder_.CreateCondBr(isSet(arg(op, 0)), fault, go, branchWeights.createUnlikelyBranchWeights());
  builder_.SetInsertPoint(fault);
  Value* record = ctxField(AbiTypes::kFault);
  const auto set = [&](AbiTypes::FaultField field, Value* value) {
    builder_.CreateStore(value, builder_.CreateStructGEP(abi_.fault, record, field));
  };
  set(AbiTypes::kFaultCode, num(op.ref));
  set(AbiTypes::kFaultRung, number(CodeUnitNumbers::Kind::Rung, number_));
  set(AbiTypes::kFaultLine, number(CodeUnitNumbers::Kind::Line, lineOf(*rung_, op)));
  builder_.CreateRet(num(RUNG_PC_FAULT));
  builder_.SetInsertPoint(go);
}

ChunkEmitter::Value* ChunkEmitter::profOfRung() {
  Value* counters = builder_.CreateLoad(builder_.getPtrTy(), ctxField(AbiTypes::kProf));
  return builder_.CreateInBoundsGEP(abi_.prof, counters, number(CodeUnitNumbers::Kind::Rung, number_));
}

// In order: everything before has been completed when the counter is read, and nothing after it has begun. Otherwise a
// rung would be measured while the processor still works on the one before, and its time would be attributed to reading
// the counter. The counter is the one that the host calibrates (rtlib/core/ticks.h): the time stamp counter of x86,
// cntvct_el0 of ARM64. On other machines the host asks the kernel, which compiled code does not: rungs are counted
// there but not timed.
ChunkEmitter::Value* ChunkEmitter::ticks() {
  const llvm::Triple triple(target_.getTargetTriple());
  if (triple.isX86()) {
    const auto fence = [&] { builder_.CreateIntrinsic(builder_.getVoidTy(), llvm::Intrinsic::x86_sse2_lfence, {}); };
    fence();
    Value* now = builder_.CreateIntrinsic(builder_.getInt64Ty(), llvm::Intrinsic::readcyclecounter, {});
    fence();
    return now;
  }
  if (triple.isAArch64()) { // by name: LLVM 19 turns readsteadycounter into a constant 0
    builder_.CreateIntrinsic(builder_.getVoidTy(), llvm::Intrinsic::aarch64_isb, {builder_.getInt32(15)});
    llvm::LLVMContext& context = target_.getContext();
    auto* name = llvm::MDNode::get(context, llvm::MDString::get(context, "cntvct_el0"));
    return builder_.CreateIntrinsic(builder_.getInt64Ty(), llvm::Intrinsic::read_volatile_register,
                                    {llvm::MetadataAsValue::get(context, name)});
  }
  return builder_.getInt64(0);
}

void ChunkEmitter::profEnter() {
  Value* prof = profOfRung();
  builder_.CreateStore(ticks(), profField(prof, AbiTypes::kStarted));
}

void ChunkEmitter::profLeave() {
  Value* prof = profOfRung();
  llvm::Type* i64 = builder_.getInt64Ty();
  const auto load = [&](AbiTypes::ProfField field) { return builder_.CreateLoad(i64, profField(prof, field)); };
  const auto store = [&](AbiTypes::ProfField field, Value* value) {
    builder_.CreateStore(value, profField(prof, field));
  };
  Value* used = builder_.CreateSub(ticks(), load(AbiTypes::kStarted));
  store(AbiTypes::kCount, builder_.CreateAdd(load(AbiTypes::kCount), builder_.getInt64(1)));
  store(AbiTypes::kTotal, builder_.CreateAdd(load(AbiTypes::kTotal), used));
  Value* max = load(AbiTypes::kMax);
  store(AbiTypes::kMax, builder_.CreateSelect(builder_.CreateICmpUGT(used, max), used, max));
}

// ---- exits -------------------------------------------------------------------------------------------------------

void ChunkEmitter::returnValue(Value* chunk) {
  if (extra_ != nullptr)
    builder_.CreateStore(builder_.CreateLoad(builder_.getInt32Ty(), extra_), ctxField(AbiTypes::kExtraWeight));
  builder_.CreateRet(chunk);
}

void ChunkEmitter::returnToCaller() {
  Value* spField = ctxField(AbiTypes::kSp);
  Value* sp = builder_.CreateSub(builder_.CreateLoad(builder_.getInt32Ty(), spField), num(1));
  builder_.CreateStore(sp, spField);
  Value* index = builder_.CreateZExt(sp, builder_.getInt64Ty());
  Value* entry = builder_.CreateInBoundsGEP(builder_.getInt32Ty(), ctxField(AbiTypes::kStack), index);
  returnValue(builder_.CreateLoad(builder_.getInt32Ty(), entry));
}

// The first block of a rung of this chunk that is the target of a jump.
llvm::BasicBlock* ChunkEmitter::rungBlock(uint32_t rung) {
  llvm::BasicBlock*& own = rungBlocks_[rung - firstRung_];
  if (own == nullptr) own = block("rung");
  return own;
}

void ChunkEmitter::goTo(const Destination& to) {
  if (to.inside()) {
    if (to.extra != 0)
      builder_.CreateStore(builder_.CreateAdd(builder_.CreateLoad(builder_.getInt32Ty(), extra_), num(to.extra)),
                           extra_);
    builder_.CreateBr(rungBlock(to.rung));
  } else if (to.chunk == RUNG_NONE) {
    returnToCaller();
  } else {
    returnValue(number(CodeUnitNumbers::Kind::Chunk, to.chunk));
  }
}

// A block from which control goes to the destination.
llvm::BasicBlock* ChunkEmitter::blockOf(const Destination& to) {
  if (to.inside() && to.extra == 0) return rungBlock(to.rung);
  llvm::IRBuilder<>::InsertPointGuard guard(builder_);
  llvm::BasicBlock* made = block("transfer");
  builder_.SetInsertPoint(made);
  goTo(to);
  return made;
}

void ChunkEmitter::pushReturn(uint32_t chunk) {
  Value* spField = ctxField(AbiTypes::kSp);
  Value* sp = builder_.CreateLoad(builder_.getInt32Ty(), spField);
  Value* index = builder_.CreateZExt(sp, builder_.getInt64Ty());
  builder_.CreateStore(number(CodeUnitNumbers::Kind::Chunk, chunk),
                       builder_.CreateInBoundsGEP(builder_.getInt32Ty(), ctxField(AbiTypes::kStack), index));
  builder_.CreateStore(builder_.CreateAdd(sp, num(1)), spField);
}

// If all targets are chunks, the number of the next one comes from a table.
void ChunkEmitter::emitSwitch(const Exit& exit) {
  Value* value = values_[exit.value.index];
  const auto inside = [](const Destination& to) { return to.inside(); };
  if (std::any_of(exit.targets.begin(), exit.targets.end(), inside)) {
    llvm::SwitchInst* jump = builder_.CreateSwitch(value, blockOf(exit.targets[0]));
    for (uint32_t i = 1; i < exit.targets.size(); ++i) jump->addCase(builder_.getInt32(i), blockOf(exit.targets[i]));
    return;
  }
  const bool areSymbols = numbers_ != nullptr; // then of the size of addresses, which every linker can put into data
  llvm::Type* type = areSymbols ? static_cast<llvm::Type*>(builder_.getPtrTy()) : builder_.getInt32Ty();
  std::vector<llvm::Constant*> chunks;
  for (const Destination& to : exit.targets)
    chunks.push_back(areSymbols ? static_cast<llvm::Constant*>(symbol(CodeUnitNumbers::Kind::Chunk, to.chunk))
                                : builder_.getInt32(to.chunk));
  llvm::Constant* table = llvm::ConstantArray::get(llvm::ArrayType::get(type, chunks.size()), chunks);
  auto* variable =
      new llvm::GlobalVariable(target_, table->getType(), true, llvm::GlobalValue::PrivateLinkage, table, "targets");
  Value* index = builder_.CreateSelect(builder_.CreateICmpULT(value, num(chunks.size())), value, num(0));
  Value* entry = builder_.CreateInBoundsGEP(type, variable, builder_.CreateZExt(index, builder_.getInt64Ty()));
  Value* chunk = builder_.CreateLoad(type, entry);
  returnValue(areSymbols ? builder_.CreatePtrToInt(chunk, builder_.getInt32Ty()) : chunk);
}

// After an if with the condition of the jump, its two regions leave separately without joining.
bool ChunkEmitter::leaveFromRegions(const Exit& exit) {
  const bool same = join_ && join_->cond == exit.cond && join_->end == builder_.GetInsertBlock() && join_->end->empty();
  if (!same) return false;
  join_->whenTrue->getTerminator()->replaceSuccessorWith(join_->end, blockOf(exit.taken));
  join_->whenFalse->getTerminator()->replaceSuccessorWith(join_->end, blockOf(exit.otherwise));
  builder_.SetInsertPoint(join_->whenTrue);
  join_->end->eraseFromParent();
  return true;
}

void ChunkEmitter::emitExit(const Exit& exit) {
  setLine(rung_->transferLine);
  if (exit.kind == TransferKind::Switch) return emitSwitch(exit);
  if (exit.kind == TransferKind::Next) {
    if (!exit.otherwise.inside()) goTo(exit.otherwise);
    return; // otherwise the rung below follows here
  }
  if (exit.cond.valid()) {
    const bool jumps = exit.kind == TransferKind::Goto;
    if (jumps && leaveFromRegions(exit)) return;
    llvm::BasicBlock* leave = jumps ? blockOf(exit.taken) : block("leave");
    builder_.CreateCondBr(isSet(values_[exit.cond.index]), leave, blockOf(exit.otherwise));
    if (jumps) return;
    builder_.SetInsertPoint(leave);
  }
  switch (exit.kind) {
  case TransferKind::Next:
  case TransferKind::Switch:
  case TransferKind::Goto: return goTo(exit.taken);
  case TransferKind::Call:
    // A call at the end of a routine needs no return address: the callee returns to the caller.
    if (exit.otherwise.chunk != RUNG_NONE) pushReturn(exit.otherwise.chunk);
    return goTo(exit.taken);
  case TransferKind::Ret: return returnToCaller();
  case TransferKind::End: return returnValue(num(RUNG_PC_DONE));
  }
}

} // namespace rung::codegen

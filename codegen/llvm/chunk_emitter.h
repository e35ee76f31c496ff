// Writes chunks as LLVM functions, operation by operation: each value of a rung is one LLVM value, regions are blocks
// with phis. LLVM instructions are used only if LLVM's semantics are those of the IR (never one that may give poison);
// all other arithmetic calls the functions of sem.hpp.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "codegen/llvm/abi_types.h"
#include "codegen/llvm/code_unit_numbers.h"
#include "codegen/llvm/debug_info.h"
#include "codegen/llvm/llvm_module.h"
#include "codegen/plan/chunk_plan.h"
#include "ir/core/regions.h"

namespace rung::codegen {

class ChunkEmitter {
public:
  // `debug` may be null: no debug information. `numbers`: of the code unit that contains all chunks; null: the chunks
  // are the whole program, and numbers are written in the code.
  ChunkEmitter(llvm::Module& target, const ir::Layout& layout, const LlvmOptions& options, DebugInfo* debug,
               const CodeUnitNumbers* numbers);

  llvm::Function* emit(uint32_t chunk);

private:
  using Value = llvm::Value;

  // An open if or loop.
  struct Region {
    const ir::Op* opener;
    llvm::BasicBlock* head;                // if: the block that branches; loop: the block with the phis
    llvm::BasicBlock* other;               // if: begins the second region, or what follows; loop: what follows
    llvm::BasicBlock* end;                 // if: what follows
    llvm::BasicBlock* firstExit = nullptr; // if: the end of the first region, once it is reached
    std::vector<Value*> yields{};          // results of the first region
    std::vector<llvm::PHINode*> phis{};    // loop: number of the iteration, carried values
  };

  // The end of an if without results: the last blocks of its two regions.
  struct Join {
    ir::ValueId cond;
    llvm::BasicBlock* end;
    llvm::BasicBlock* whenTrue;
    llvm::BasicBlock* whenFalse;
  };

  void beginFunction(const ChunkPlan& plan);
  bool beginRung(uint32_t rung);
  void emitRung(const ir::Rung& rung, uint32_t number);
  void emitOp(const ir::Op& op);
  Value* throughMemory(Value* value);
  void emitExit(const ir::Exit& exit);
  void setLine(uint32_t line);
  void showMemory();
  void settleMemory(const ir::Op& op);

  // Emits operations with one result.
  Value* result(const ir::Op& op);
  Value* instruction(const ir::Op& op);
  Value* arithmetic(const ir::Op& op);
  Value* shift(const ir::Op& op);
  Value* divide(const ir::Op& op);
  Value* callSem(const ir::Op& op);
  Value* load(const ir::Op& op);
  Value* loadAt(const ir::Op& op);
  Value* loadBitAt(const ir::Op& op);

  void store(const ir::Op& op);
  void storeAt(const ir::Op& op);
  void slotStore(const ir::Op& op);
  struct Element;
  Element element(const ir::Op& op, bool isBit);
  llvm::Align alignOf(uint64_t offset, ir::Type type) const;
  Value* readFlag(Value* address);
  Value* readBit(Value* address, Value* bit);
  void writeBit(Value* address, Value* bit, Value* value);

  void openIf(const ir::Op& op);
  void turnElse(const ir::Op& op);
  void closeIf(const ir::Op& op);
  void openLoop(const ir::Op& op);
  void closeLoop(const ir::Op& op);

  void message(const ir::Op& op);
  Value* serviceRequest(const ir::Op& op);
  Value* callHost(AbiTypes::HostField function, llvm::Type* result, std::vector<Value*> args);
  void trap(const ir::Op& op);
  void profEnter();
  void profLeave();
  Value* ticks();

  llvm::BasicBlock* rungBlock(uint32_t rung);
  void goTo(const ir::Destination& to);
  llvm::BasicBlock* blockOf(const ir::Destination& to);
  void returnToCaller();
  void returnValue(Value* chunk);
  void emitSwitch(const ir::Exit& exit);
  bool leaveFromRegions(const ir::Exit& exit);
  void pushReturn(uint32_t chunk);

  llvm::GlobalVariable* symbol(CodeUnitNumbers::Kind kind, uint32_t number);
  llvm::Constant* number(CodeUnitNumbers::Kind kind, uint32_t number);

  Value* arg(const ir::Op& op, int i) const { return values_[ir::arg(*rung_, op, i).index]; }
  llvm::Type* type(ir::Type type) const;
  // Conversions between the IR's bits and the i1 of LLVM's comparisons and branches.
  Value* isSet(Value* bit);
  Value* asBit(Value* truth) { return builder_.CreateZExt(truth, type(ir::Type::Bit)); }
  Value* asByte(Value* bit) { return builder_.CreateZExt(bit, builder_.getInt8Ty()); }
  bool hasMostlyBytes(const ChunkPlan& plan) const;
  Value* num(uint64_t value) { return builder_.getInt32(static_cast<uint32_t>(value)); }
  // An address in the memory block.
  Value* at(uint64_t offset) { return builder_.CreateConstInBoundsGEP1_64(builder_.getInt8Ty(), mem_, offset); }
  Value* ctxField(unsigned field) { return builder_.CreateStructGEP(abi_.ctx, ctx_, field); }
  Value* profField(Value* base, unsigned field) { return builder_.CreateStructGEP(abi_.prof, base, field); }
  Value* profOfRung();
  // Space for values passed to the host by address; one per function.
  Value* scratch(llvm::Value*& kept, llvm::Type* type);
  llvm::BasicBlock* block(const char* name) { return llvm::BasicBlock::Create(target_.getContext(), name, function_); }

  llvm::Module& target_;
  const ir::Layout& layout_;
  const ir::Module& module_;
  const LlvmOptions& options_;
  DebugInfo* debug_;
  const CodeUnitNumbers* numbers_;
  AbiTypes abi_;
  llvm::IRBuilder<> builder_;
  bool extendsWords_;         // the ABI wants 32-bit arguments and results sign-extended
  bool bitsAreBytes_ = false; // whether the chunk's bits are bytes; otherwise i1

  // Of the current chunk and rung.
  llvm::Function* function_ = nullptr;
  Value* mem_ = nullptr;
  Value* ctx_ = nullptr;
  Value* messageSpace_ = nullptr;
  Value* argsSpace_ = nullptr;
  Value* valueSpace_ = nullptr;
  Value* extra_ = nullptr; // where the chunk accumulates its extra weight, if it has any
  uint32_t firstRung_ = 0;
  std::vector<llvm::BasicBlock*> rungBlocks_; // of the chunk's rungs that are targets of jumps
  const ir::Rung* rung_ = nullptr;
  uint32_t settledLine_ = 0; // the line at whose beginning memory was last brought up to date; 0: none
  uint32_t number_ = 0;
  std::vector<Value*> values_;
  std::vector<bool> throughMemory_; // by value; empty: none
  std::vector<Region> regions_;
  std::optional<Join> join_; // the last one of the rung
};

} // namespace rung::codegen

// Reads the graph of each function at the end of code generation (see code_reader.h).
#include "codegen/jit/code_reader.h"

#include <llvm/Analysis/LoopInfo.h>
#include <llvm/Analysis/ScalarEvolution.h>
#include <llvm/CodeGen/MachineFunctionPass.h>
#include <llvm/CodeGen/MachineInstr.h>
#include <llvm/CodeGen/MachineLoopInfo.h>
#include <llvm/CodeGen/TargetOpcodes.h>
#include <llvm/IR/Constants.h>
#include <llvm/IR/InstIterator.h>
#include <llvm/IR/InstrTypes.h>
#include <llvm/InitializePasses.h>
#include <llvm/PassRegistry.h>

#include "codegen/llvm/llvm_module.h"

namespace rung::codegen {
namespace {

// Padding before an aligned block is executed where control falls into the block.
uint64_t paddingAfter(const llvm::MachineBasicBlock& block) {
  constexpr uint64_t kShortestNop = 4; // bytes; as many as fit
  const llvm::MachineBasicBlock* next = block.getNextNode();
  return next == nullptr ? 0 : (next->getAlignment().value() - 1) / kShortestNop;
}

// The bounds of loops are those of the IR from which the code was made: its blocks refer to their IR blocks, and code
// generation adds no loops and no iterations.
class CodeReader final : public llvm::MachineFunctionPass {
public:
  explicit CodeReader(CodeUnitCode& code) : MachineFunctionPass(kId), code_(code) {
    llvm::PassRegistry& registry = *llvm::PassRegistry::getPassRegistry();
    llvm::initializeScalarEvolutionWrapperPassPass(registry);
    llvm::initializeLoopInfoWrapperPassPass(registry);
    llvm::initializeMachineLoopInfoWrapperPassPass(registry);
  }

  void getAnalysisUsage(llvm::AnalysisUsage& usage) const override {
    usage.addRequired<llvm::ScalarEvolutionWrapperPass>();
    usage.addRequired<llvm::LoopInfoWrapperPass>();
    usage.addRequired<llvm::MachineLoopInfoWrapperPass>();
    usage.setPreservesAll();
    MachineFunctionPass::getAnalysisUsage(usage);
  }

  bool doInitialization(llvm::Module& module) override {
    const llvm::Constant* table = module.getNamedGlobal(kCodeUnitTable)->getInitializer();
    for (unsigned i = 0; const llvm::Constant* chunk = table->getAggregateElement(i); ++i)
      code_.chunks.push_back(chunk->stripPointerCasts()->getName().str());
    return false;
  }

  bool runOnMachineFunction(llvm::MachineFunction& function) override {
    machineLoops_ = &getAnalysis<llvm::MachineLoopInfoWrapperPass>().getLI();
    loops_ = &getAnalysis<llvm::LoopInfoWrapperPass>().getLoopInfo();
    evolution_ = &getAnalysis<llvm::ScalarEvolutionWrapperPass>().getSE();
    FunctionCode& code = code_.functions[function.getName().str()];
    blocks_.clear();
    loopNumbers_.clear();
    byPointer_ = 0;
    for (const llvm::MachineBasicBlock& block : function)
      blocks_.try_emplace(&block, static_cast<uint32_t>(blocks_.size()));
    for (const llvm::MachineLoop* loop : *machineLoops_) addLoop(*loop, kNoLoop, code);
    for (const llvm::MachineBasicBlock& block : function) code.blocks.push_back(read(block, code));
    if (byPointer_ > hostCalls(function.getFunction())) code.unknown = "it calls a function through a pointer";
    return false;
  }

private:
  static char kId; // LLVM identifies a pass by its address

  void addLoop(const llvm::MachineLoop& loop, uint32_t parent, FunctionCode& code) {
    const auto number = static_cast<uint32_t>(code.loops.size());
    loopNumbers_[&loop] = number;
    code.loops.push_back({.header = blocks_.at(loop.getHeader()), .parent = parent, .rounds = roundsOf(loop)});
    for (const llvm::MachineLoop* inner : loop) addLoop(*inner, number, code);
  }

  // If several loops of the IR have one header in the code, the code has one loop for them.
  uint64_t roundsOf(const llvm::MachineLoop& loop) {
    const auto irLoopOf = [&](const llvm::MachineLoop* of) -> const llvm::Loop* {
      const llvm::BasicBlock* block = of == nullptr ? nullptr : of->getHeader()->getBasicBlock();
      return block == nullptr ? nullptr : loops_->getLoopFor(block);
    };
    const llvm::Loop* around = irLoopOf(loop.getParentLoop());
    const llvm::Loop* own = irLoopOf(&loop);
    if (own == nullptr || own == around) return 0;
    uint64_t rounds = 1;
    for (; own != nullptr && own != around; own = own->getParentLoop()) {
      const unsigned most = evolution_->getSmallConstantMaxTripCount(own);
      if (most == 0 || rounds > UINT32_MAX) return 0;
      rounds *= most;
    }
    return rounds;
  }

  CodeBlock read(const llvm::MachineBasicBlock& block, FunctionCode& code) {
    CodeBlock out{.instructions = paddingAfter(block)};
    if (const llvm::MachineLoop* loop = machineLoops_->getLoopFor(&block)) out.loop = loopNumbers_.at(loop);
    for (const llvm::MachineBasicBlock* next : block.successors()) out.next.push_back(blocks_.at(next));
    for (const llvm::MachineInstr& instruction : block) {
      if (instruction.isMetaInstruction() || instruction.getOpcode() == llvm::TargetOpcode::MEMBARRIER) continue;
      ++out.instructions;
      if (instruction.isInlineAsm()) code.unknown = "it contains inline assembly";
      if (instruction.isCall()) addCall(instruction, out);
    }
    return out;
  }

  void addCall(const llvm::MachineInstr& call, CodeBlock& block) {
    for (const llvm::MachineOperand& operand : call.operands()) {
      if (operand.isGlobal()) return block.calls.push_back(operand.getGlobal()->getName().str());
      if (operand.isSymbol()) return block.calls.push_back(operand.getSymbolName());
    }
    ++byPointer_;
  }

  // Calls by pointer are calls of host functions, which are not part of the code.
  static uint32_t hostCalls(const llvm::Function& function) {
    uint32_t calls = 0;
    for (const llvm::Instruction& instruction : llvm::instructions(function)) {
      const auto* call = llvm::dyn_cast<llvm::CallBase>(&instruction);
      if (call != nullptr && call->isIndirectCall()) ++calls;
    }
    return calls;
  }

  CodeUnitCode& code_;
  // Of the current function.
  const llvm::MachineLoopInfo* machineLoops_ = nullptr;
  const llvm::LoopInfo* loops_ = nullptr;
  llvm::ScalarEvolution* evolution_ = nullptr;
  std::map<const llvm::MachineBasicBlock*, uint32_t> blocks_;
  std::map<const llvm::MachineLoop*, uint32_t> loopNumbers_;
  uint32_t byPointer_ = 0; // number of calls by pointer
};

char CodeReader::kId = 0;

} // namespace

std::unique_ptr<llvm::FunctionPass> makeCodeReader(CodeUnitCode& code) { return std::make_unique<CodeReader>(code); }

} // namespace rung::codegen

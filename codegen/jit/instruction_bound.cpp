// Reads the graph of each function at the end of code generation (see instruction_bound.h).
#include "codegen/jit/instruction_bound.h"

#include <numeric>

#include <llvm/Analysis/LoopInfo.h>
#include <llvm/Analysis/ScalarEvolution.h>
#include <llvm/CodeGen/MachineFunctionPass.h>
#include <llvm/CodeGen/MachineInstr.h>
#include <llvm/CodeGen/MachineLoopInfo.h>
#include <llvm/CodeGen/TargetOpcodes.h>
#include <llvm/IR/Constants.h>
#include <llvm/InitializePasses.h>
#include <llvm/PassRegistry.h>

#include "codegen/jit/pieces.h"
#include "codegen/llvm/llvm_module.h"

namespace rung::codegen {
namespace {

// The bounds of loops are those of the IR that the code was made of: its blocks know which they come from, and code
// generation makes no loop of its own and repeats none more often.
class CodeReader final : public llvm::MachineFunctionPass {
public:
  explicit CodeReader(std::map<std::string, FunctionCode>& functions)
      : MachineFunctionPass(kId), functions_(functions) {
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

  bool runOnMachineFunction(llvm::MachineFunction& function) override {
    machineLoops_ = &getAnalysis<llvm::MachineLoopInfoWrapperPass>().getLI();
    loops_ = &getAnalysis<llvm::LoopInfoWrapperPass>().getLoopInfo();
    evolution_ = &getAnalysis<llvm::ScalarEvolutionWrapperPass>().getSE();
    FunctionCode& code = functions_[function.getName().str()];
    blocks_.clear();
    loopNumbers_.clear();
    for (const llvm::MachineBasicBlock& block : function)
      blocks_.try_emplace(&block, static_cast<uint32_t>(blocks_.size()));
    for (const llvm::MachineLoop* loop : *machineLoops_) addLoop(*loop, kNoLoop, code);
    for (const llvm::MachineBasicBlock& block : function) code.blocks.push_back(read(block, code));
    return false;
  }

private:
  static char kId; // LLVM knows a pass by its address

  void addLoop(const llvm::MachineLoop& loop, uint32_t parent, FunctionCode& code) {
    const auto number = static_cast<uint32_t>(code.loops.size());
    loopNumbers_[&loop] = number;
    code.loops.push_back({.header = blocks_.at(loop.getHeader()), .parent = parent, .rounds = roundsOf(loop)});
    for (const llvm::MachineLoop* inner : loop) addLoop(*inner, number, code);
  }

  // Where loops of the IR have one header in the code, the code has one loop for them.
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
    CodeBlock out;
    if (const llvm::MachineLoop* loop = machineLoops_->getLoopFor(&block)) out.loop = loopNumbers_.at(loop);
    for (const llvm::MachineBasicBlock* next : block.successors()) out.next.push_back(blocks_.at(next));
    for (const llvm::MachineInstr& instruction : block) {
      if (instruction.isMetaInstruction() || instruction.getOpcode() == llvm::TargetOpcode::MEMBARRIER) continue;
      ++out.instructions;
      if (instruction.isInlineAsm()) code.unknown = "it has assembly in it";
      if (instruction.isCall()) addCall(instruction, out, code);
    }
    return out;
  }

  // Only the host's functions are called by a pointer.
  static void addCall(const llvm::MachineInstr& call, CodeBlock& block, FunctionCode& code) {
    for (const llvm::MachineOperand& operand : call.operands()) {
      if (operand.isGlobal()) return block.calls.push_back(operand.getGlobal()->getName().str());
      if (operand.isSymbol()) return block.calls.push_back(operand.getSymbolName());
    }
    code.callsHost = true;
  }

  std::map<std::string, FunctionCode>& functions_;
  // Of the function in hand.
  const llvm::MachineLoopInfo* machineLoops_ = nullptr;
  const llvm::LoopInfo* loops_ = nullptr;
  llvm::ScalarEvolution* evolution_ = nullptr;
  std::map<const llvm::MachineBasicBlock*, uint32_t> blocks_;
  std::map<const llvm::MachineLoop*, uint32_t> loopNumbers_;
};

char CodeReader::kId = 0;

// The names of the functions in the piece's table.
std::vector<std::string> chunkNames(const llvm::Module& module, const ModulePart& piece) {
  const llvm::Constant* table = module.getNamedGlobal(piece.tableName)->getInitializer();
  std::vector<std::string> names;
  for (uint32_t i = 0; i < piece.chunkCount; ++i)
    names.push_back(table->getAggregateElement(i)->stripPointerCasts()->getName().str());
  return names;
}

Result<void> boundPiece(const ir::Layout& layout, uint64_t codeHash, const LlvmOptions& options,
                        const ModulePart& piece, std::vector<CodeLength>& lengths) {
  Result<std::unique_ptr<llvm::TargetMachine>> machine = makeTargetMachine(options, MachineUse::Jit);
  if (!machine.ok()) return machine.failure();
  llvm::LLVMContext context;
  context.setDiscardValueNames(true);
  Result<std::unique_ptr<llvm::Module>> module =
      buildModule(context, *machine.value(), layout, codeHash, options, piece);
  if (!module.ok()) return module.failure();
  runPasses(*module.value(), *machine.value(), options.level);
  const std::vector<std::string> names = chunkNames(*module.value(), piece);
  std::map<std::string, FunctionCode> functions;
  const Result<std::string> object = generateCode(*module.value(), *machine.value(), llvm::CodeGenFileType::ObjectFile,
                                                  std::make_unique<CodeReader>(functions));
  if (!object.ok()) return object.failure();
  CodeLengths measured(std::move(functions));
  for (const std::string& name : names) lengths.push_back(measured.of(name));
  return {};
}

} // namespace

Result<std::vector<CodeLength>> boundInstructions(const ir::Layout& layout, uint64_t codeHash,
                                                  const LlvmOptions& options) {
  std::vector<uint32_t> all(layout.chunks().size());
  std::iota(all.begin(), all.end(), 0);
  std::vector<CodeLength> lengths;
  for (const ModulePart& piece : cutPieces(layout, all))
    if (const Result<void> done = boundPiece(layout, codeHash, options, piece, lengths); !done.ok())
      return done.failure();
  return lengths;
}

} // namespace rung::codegen

// From a layout to an optimised llvm::Module (see llvm_module.h).
#include "codegen/llvm/llvm_module.h"

#include <unordered_set>

#include <fmt/format.h>
#include <llvm/Bitcode/BitcodeReader.h>
#include <llvm/IR/InstIterator.h>
#include <llvm/IR/IntrinsicInst.h>
#include <llvm/IR/Verifier.h>
#include <llvm/Linker/Linker.h>
#include <llvm/Passes/PassBuilder.h>
#include <llvm/Support/MemoryBuffer.h>
#include <llvm/Transforms/IPO/AlwaysInliner.h>
#include <llvm/Transforms/InstCombine/InstCombine.h>
#include <llvm/Transforms/Scalar/DeadStoreElimination.h>
#include <llvm/Transforms/Scalar/EarlyCSE.h>
#include <llvm/Transforms/Scalar/JumpThreading.h>
#include <llvm/Transforms/Scalar/Reassociate.h>
#include <llvm/Transforms/Scalar/SROA.h>
#include <llvm/Transforms/Scalar/SimplifyCFG.h>
#include <llvm/Transforms/Utils/Local.h>

#include "codegen/llvm/abi_types.h"
#include "codegen/llvm/chunk_emitter.h"
#include "codegen/llvm/code_unit_numbers.h"
#include "codegen/llvm/embedded.h"
#include "ir/image/program_image.h"

namespace rung::codegen {
namespace {

// The attributes of a function or a call that say how arguments are passed. An argument by value is a copy that belongs
// to the callee: without that attribute, a call that is marked as not accessing its caller's frame (`tail`) would be
// wrong, and stores to such an argument would be considered dead.
llvm::AttributeList whatIsPassed(llvm::LLVMContext& context, const llvm::AttributeList& all, unsigned parameters) {
  llvm::AttributeList kept;
  for (unsigned i = 0; i < parameters; ++i) {
    if (!all.hasParamAttr(i, llvm::Attribute::ByVal)) continue;
    kept = kept.addParamAttribute(context, i, all.getParamAttr(i, llvm::Attribute::ByVal));
    kept = kept.addParamAttribute(context, i, all.getParamAttr(i, llvm::Attribute::Alignment));
  }
  return kept;
}

// The bitcode was made for another machine and with other options: none of these attributes may prevent inlining.
// Intrinsics keep theirs: a memory copy says in them how its places are aligned, and becomes a call if they are not.
void adopt(llvm::Function& function) {
  llvm::LLVMContext& context = function.getContext();
  const bool shared = function.hasFnAttribute(llvm::Attribute::NoInline);
  function.setComdat(nullptr);
  function.setLinkage(llvm::GlobalValue::InternalLinkage);
  function.setAttributes(whatIsPassed(context, function.getAttributes(), static_cast<unsigned>(function.arg_size())));
  function.addFnAttr(shared ? llvm::Attribute::NoInline : llvm::Attribute::AlwaysInline);
  function.addFnAttr("frame-pointer", "non-leaf");
  function.setDoesNotThrow();
  for (llvm::Instruction& instruction : llvm::instructions(function))
    if (auto* call = llvm::dyn_cast<llvm::CallInst>(&instruction);
        call != nullptr && !llvm::isa<llvm::IntrinsicInst>(call))
      call->setAttributes(whatIsPassed(context, call->getAttributes(), call->arg_size()));
}

// Adds the functions of sem.hpp that the module calls.
Result<void> linkSem(llvm::Module& module) {
  const llvm::MemoryBufferRef buffer(semBitcode(), "sem");
  llvm::Expected<std::unique_ptr<llvm::Module>> sem = llvm::getLazyBitcodeModule(buffer, module.getContext());
  if (!sem) return failure(fmt::format("LLVM cannot read its own bitcode: {}", llvm::toString(sem.takeError())));
  std::unordered_set<const llvm::GlobalValue*> own;
  for (const llvm::GlobalObject& object : module.global_objects())
    if (!object.isDeclaration()) own.insert(&object);
  (*sem)->setTargetTriple(module.getTargetTriple());
  (*sem)->setDataLayout(module.getDataLayout());
  // Its module flags for the machine it was made for would conflict with this module's.
  for (const char* name : {"llvm.module.flags", "llvm.ident"})
    if (llvm::NamedMDNode* node = (*sem)->getNamedMetadata(name)) node->eraseFromParent();
  if (llvm::Linker::linkModules(module, std::move(*sem), llvm::Linker::LinkOnlyNeeded))
    return failure("LLVM cannot link its own bitcode");
  for (llvm::Function& function : module)
    if (!function.isDeclaration() && !own.contains(&function)) adopt(function);
  for (llvm::GlobalVariable& table : module.globals()) {
    if (table.isDeclaration() || own.contains(&table)) continue;
    table.setComdat(nullptr);
    table.setLinkage(llvm::GlobalValue::InternalLinkage);
  }
  return {};
}

void addFlags(llvm::Module& module, const llvm::TargetMachine& machine) {
  module.setTargetTriple(machine.getTargetTriple().str());
  module.setDataLayout(machine.createDataLayout());
  module.setPICLevel(llvm::PICLevel::BigPIC);
  module.setFramePointer(llvm::FramePointerKind::NonLeaf);
  const std::string& abi = machine.Options.MCOptions.ABIName;
  if (!abi.empty())
    module.addModuleFlag(llvm::Module::Error, "target-abi", llvm::MDString::get(module.getContext(), abi));
}

llvm::GlobalVariable* addChunkTable(llvm::Module& module, const std::vector<llvm::Constant*>& functions, bool isUnit) {
  auto* type = llvm::ArrayType::get(llvm::PointerType::getUnqual(module.getContext()), functions.size());
  const auto linkage = isUnit ? llvm::GlobalValue::ExternalLinkage : llvm::GlobalValue::PrivateLinkage;
  return new llvm::GlobalVariable(module, type, true, linkage, llvm::ConstantArray::get(type, functions),
                                  isUnit ? kCodeUnitTable : "chunks");
}

void addIdentity(llvm::Module& module, const ModulePart& part) {
  llvm::LLVMContext& context = module.getContext();
  llvm::Constant* value =
      llvm::ConstantStruct::getAnon({llvm::ConstantDataArray::get(context, part.key),
                                     llvm::ConstantInt::get(llvm::Type::getInt32Ty(context), part.chunkCount)});
  new llvm::GlobalVariable(module, value->getType(), true, llvm::GlobalValue::ExternalLinkage, value,
                           kCodeUnitIdentity);
}

} // namespace

Result<std::unique_ptr<llvm::Module>> buildModule(llvm::LLVMContext& context, const llvm::TargetMachine& machine,
                                                  const ir::Layout& layout, uint64_t codeHash,
                                                  const LlvmOptions& options, const ModulePart& part) {
  auto module = std::make_unique<llvm::Module>(layout.module().name, context);
  addFlags(*module, machine);
  std::optional<DebugInfo> debug;
  if (options.debugInfo)
    debug.emplace(*module, layout.module(),
                  part.members != nullptr ? *part.members : ir::memoryMembers(layout.memory()),
                  options.level == LlvmLevel::Opt);
  std::optional<CodeUnitNumbers> numbers;
  if (part.isUnit) numbers.emplace(layout.partition(), part);
  ChunkEmitter emitter(*module, layout, options, debug ? &*debug : nullptr, numbers ? &*numbers : nullptr);
  std::vector<llvm::Constant*> functions;
  for (uint32_t i = 0; i < part.chunkCount; ++i) functions.push_back(emitter.emit(part.firstChunk + i));
  if (debug) debug->finish();
  llvm::GlobalVariable* table = addChunkTable(*module, functions, part.isUnit);
  if (!part.isUnit) {
    const ir::ProgramImage image(layout, codeHash);
    addProgramTables(*module, image.program(), table);
  } else {
    addIdentity(*module, part);
  }
  if (Result<void> linked = linkSem(*module); !linked.ok()) return linked.failure();
  std::string text;
  llvm::raw_string_ostream report(text);
  if (llvm::verifyModule(*module, &report)) return failure(fmt::format("LLVM refuses the generated code: {}", text));
  return module;
}

void runPasses(llvm::Module& module, llvm::TargetMachine& machine, LlvmLevel level) {
  if (level == LlvmLevel::Fast) return;
  llvm::LoopAnalysisManager loops;
  llvm::FunctionAnalysisManager functions;
  llvm::CGSCCAnalysisManager components;
  llvm::ModuleAnalysisManager modules;
  llvm::PassBuilder builder(&machine);
  builder.registerModuleAnalyses(modules);
  builder.registerCGSCCAnalyses(components);
  builder.registerFunctionAnalyses(functions);
  builder.registerLoopAnalyses(loops);
  builder.crossRegisterProxies(loops, functions, components, modules);
  llvm::FunctionPassManager perFunction;
  perFunction.addPass(llvm::SROAPass(llvm::SROAOptions::ModifyCFG));
  perFunction.addPass(llvm::EarlyCSEPass(true));
  perFunction.addPass(llvm::InstCombinePass());
  perFunction.addPass(llvm::SimplifyCFGPass());
  // For consecutive rungs: loads of values stored above, equal conditions, overwritten stores. Running it again after
  // each step finds as much as GVN does; all passes together take a third less time with it.
  perFunction.addPass(llvm::ReassociatePass());
  perFunction.addPass(llvm::EarlyCSEPass(true));
  perFunction.addPass(llvm::JumpThreadingPass());
  perFunction.addPass(llvm::EarlyCSEPass(true));
  perFunction.addPass(llvm::DSEPass());
  perFunction.addPass(llvm::InstCombinePass());
  llvm::ModulePassManager passes;
  passes.addPass(llvm::AlwaysInlinerPass(false));
  passes.addPass(llvm::createModuleToFunctionPassAdaptor(std::move(perFunction)));
  passes.run(module, modules);
}

} // namespace rung::codegen

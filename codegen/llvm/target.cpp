// The machines for which code is generated (see llvm_module.h).
#include <mutex>

#include <fmt/format.h>
#include <llvm/CodeGen/MachineModuleInfo.h>
#include <llvm/CodeGen/Passes.h>
#include <llvm/CodeGen/TargetPassConfig.h>
#include <llvm/Config/llvm-config.h>
#include <llvm/IR/LegacyPassManager.h>
#include <llvm/MC/TargetRegistry.h>
#include <llvm/Support/ErrorHandling.h>
#include <llvm/Support/TargetSelect.h>
#include <llvm/TargetParser/Host.h>
#include <llvm/TargetParser/SubtargetFeature.h>

#include "codegen/llvm/before_selection.h"
#include "codegen/llvm/llvm_module.h"
#include "ir/support/check.h"

namespace rung::codegen {
namespace {

// Processor and features that Debian's ports require.
struct TargetRow {
  std::string_view triple;
  const char* cpu;
  const char* features;
  const char* abi;
  bool hardFloat;
};
constexpr TargetRow kTargets[] = {
    {"x86_64-linux-gnu", "x86-64", "", "", false},
    {"aarch64-linux-gnu", "generic", "", "", false},
    {"armv7-linux-gnueabihf", "generic", "+vfp3d16,-neon", "", true},
    {"riscv64-linux-gnu", "generic-rv64", "+m,+a,+f,+d,+c", "lp64d", false},
};

// A fatal error of LLVM is treated as an internal error of Rung: in a library it throws (ThrowingChecks).
void fatalError(void*, const char* reason, bool) { checkFailed("LLVM", reason, __FILE__, __LINE__); }

void initialiseLlvm() {
  static std::once_flag once;
  std::call_once(once, [] {
    llvm::install_fatal_error_handler(&fatalError);
    llvm::InitializeAllTargetInfos();
    llvm::InitializeAllTargets();
    llvm::InitializeAllTargetMCs();
    llvm::InitializeAllAsmPrinters();
  });
}

// The row of this computer; for one that is not in the table, only the triple is known.
TargetRow hostRow(const std::string& triple) {
  for (const TargetRow& row : kTargets)
    if (llvm::Triple(llvm::Triple::normalize(row.triple)).getArch() == llvm::Triple(triple).getArch()) return row;
  return {triple, "", "", "", false};
}

std::string hostFeatures() {
  llvm::SubtargetFeatures features;
  for (const auto& feature : llvm::sys::getHostCPUFeatures()) features.AddFeature(feature.first(), feature.second);
  return features.getString();
}

// Like LLVM's addPassesToEmitFile, which offers no way to omit a pass. False: the target does not support the output.
bool addCodeGenerator(llvm::LLVMTargetMachine& machine, llvm::legacy::PassManager& passes, llvm::raw_pwrite_stream& out,
                      llvm::CodeGenFileType type, std::unique_ptr<llvm::FunctionPass> reader) {
  llvm::TargetPassConfig* config = machine.createPassConfig(passes);
  // x86 reorders instructions itself. The scheduler compares all accesses of a block with each other: its time would
  // grow faster than the length of a chunk, and the code would not become faster.
  if (machine.getTargetTriple().isX86()) config->disablePass(&llvm::MachineSchedulerID);
  auto* info = new llvm::MachineModuleInfoWrapperPass(&machine);
  if (machine.getOptLevel() != llvm::CodeGenOptLevel::None) { // otherwise instructions are selected one by one
    const std::unique_ptr<llvm::FunctionPass> last(llvm::createCodeGenPrepareLegacyPass());
    config->insertPass(last->getPassID(), makeBeforeSelection().release());
  }
  passes.add(config);
  passes.add(info);
  if (config->addISelPasses()) return false;
  config->addMachinePasses();
  config->setInitialized();
  if (reader != nullptr) passes.add(reader.release());
  if (machine.addAsmPrinter(passes, out, nullptr, type, info->getMMI().getContext())) return false;
  passes.add(llvm::createFreeMachineFunctionPass());
  return true;
}

} // namespace

std::vector<std::string_view> llvmTargets() {
  std::vector<std::string_view> names;
  for (const TargetRow& row : kTargets) names.push_back(row.triple);
  return names;
}

Result<std::unique_ptr<llvm::TargetMachine>> makeTargetMachine(const LlvmOptions& options, MachineUse use) {
  initialiseLlvm();
  const std::string host = llvm::sys::getProcessTriple();
  TargetRow row = hostRow(host);
  if (!options.target.empty()) {
    const auto* found = std::find_if(std::begin(kTargets), std::end(kTargets),
                                     [&](const TargetRow& r) { return r.triple == options.target; });
    if (found == std::end(kTargets))
      return failure(fmt::format("unknown target '{}'; known are {}", options.target, fmt::join(llvmTargets(), ", ")));
    row = *found;
  }
  const std::string triple = llvm::Triple::normalize(row.triple);
  std::string error;
  const llvm::Target* target = llvm::TargetRegistry::lookupTarget(triple, error);
  if (target == nullptr) return failure(error);

  llvm::TargetOptions machineOptions;
  machineOptions.AllowFPOpFusion = llvm::FPOpFusion::Strict;
  machineOptions.MCOptions.ABIName = row.abi;
  if (row.hardFloat) machineOptions.FloatABIType = llvm::FloatABI::Hard;
  const llvm::CodeGenOptLevel level =
      options.level == LlvmLevel::Fast ? llvm::CodeGenOptLevel::None : llvm::CodeGenOptLevel::Less;
  const bool jit = use == MachineUse::Jit;
  // The JIT's linker keeps the contents of an object together. LLVM would assume large distances, and call by address.
  const bool isNear = jit && llvm::Triple(host).isX86();
  const std::optional<llvm::CodeModel::Model> model = isNear ? std::optional(llvm::CodeModel::Small) : std::nullopt;
  std::unique_ptr<llvm::TargetMachine> machine(target->createTargetMachine(
      jit ? host : triple, jit ? llvm::sys::getHostCPUName() : row.cpu, jit ? hostFeatures() : row.features,
      machineOptions, llvm::Reloc::PIC_, model, level, jit));
  if (machine == nullptr) return failure(fmt::format("no code generator for '{}'", triple));
  return machine;
}

Result<std::string> generateCode(llvm::Module& module, llvm::TargetMachine& machine, llvm::CodeGenFileType type,
                                 std::unique_ptr<llvm::FunctionPass> reader) {
  llvm::SmallVector<char, 0> bytes;
  llvm::raw_svector_ostream out(bytes);
  llvm::legacy::PassManager passes;
  if (!addCodeGenerator(static_cast<llvm::LLVMTargetMachine&>(machine), passes, out, type, std::move(reader)))
    return failure("LLVM has no such output for this target");
  passes.run(module);
  return std::string(bytes.begin(), bytes.end());
}

std::string describeMachine(const llvm::TargetMachine& machine) {
  return fmt::format("{} {} {} {}", machine.getTargetTriple().str(), machine.getTargetCPU().str(),
                     machine.getTargetFeatureString().str(), LLVM_VERSION_STRING);
}

} // namespace rung::codegen

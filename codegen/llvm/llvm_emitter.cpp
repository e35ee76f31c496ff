// Returns the LLVM back end's results as text and bytes (see llvm_emitter.h).
#include "codegen/llvm/llvm_emitter.h"

#include <llvm/Support/raw_ostream.h>

#include "codegen/llvm/llvm_module.h"

namespace rung::codegen {
namespace {

// Passes the optimised module to `use`, which returns the result. Names of values are for readers only.
template <class Use>
Result<std::string> withModule(const ir::Layout& layout, uint64_t codeHash, const LlvmOptions& options, bool names,
                               Use use) {
  Result<std::unique_ptr<llvm::TargetMachine>> machine = makeTargetMachine(options, MachineUse::File);
  if (!machine.ok()) return machine.failure();
  llvm::LLVMContext context;
  context.setDiscardValueNames(!names);
  const ModulePart whole{.chunkCount = static_cast<uint32_t>(layout.partition().chunks().size())};
  Result<std::unique_ptr<llvm::Module>> module =
      buildModule(context, *machine.value(), layout, codeHash, options, whole);
  if (!module.ok()) return module.failure();
  runPasses(*module.value(), *machine.value(), options.level);
  return use(*module.value(), *machine.value());
}

Result<std::string> generate(const ir::Layout& layout, uint64_t codeHash, const LlvmOptions& options,
                             llvm::CodeGenFileType type) {
  return withModule(layout, codeHash, options, false, [&](llvm::Module& module, llvm::TargetMachine& machine) {
    return generateCode(module, machine, type);
  });
}

} // namespace

Result<std::string> emitLlvmIr(const ir::Layout& layout, uint64_t codeHash, const LlvmOptions& options) {
  return withModule(layout, codeHash, options, true,
                    [](llvm::Module& module, llvm::TargetMachine&) -> Result<std::string> {
                      std::string text;
                      llvm::raw_string_ostream out(text);
                      module.print(out, nullptr);
                      return text;
                    });
}

Result<std::string> emitAssembly(const ir::Layout& layout, uint64_t codeHash, const LlvmOptions& options) {
  return generate(layout, codeHash, options, llvm::CodeGenFileType::AssemblyFile);
}

Result<std::string> emitObject(const ir::Layout& layout, uint64_t codeHash, const LlvmOptions& options) {
  return generate(layout, codeHash, options, llvm::CodeGenFileType::ObjectFile);
}

} // namespace rung::codegen

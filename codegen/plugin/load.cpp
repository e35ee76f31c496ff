// The part in the programs (see functions.h): each function of the LLVM back end loads the plug-in and calls it.
#include "codegen/llvm/embedded.h"
#include "codegen/plugin/functions.h"
#include "rtlib/load/plugin.h"

namespace rung::codegen {
namespace {

// May be called on any thread; the plug-in is loaded once.
Result<const LlvmFunctions*> llvmFunctions() {
  static const runtime::Plugin plugin(kLlvmPlugin, codeVersion());
  if (!plugin.ok()) return failure("LLVM cannot be loaded: " + plugin.problem());
  return plugin.function<GetLlvmFunctions>(kGetLlvmFunctions)();
}

template <auto member, class... Arguments>
auto call(Arguments&&... arguments) {
  const Result<const LlvmFunctions*> functions = llvmFunctions();
  using Answer = decltype((functions.value()->*member)(std::forward<Arguments>(arguments)...));
  if (!functions.ok()) return Answer(functions.failure());
  return (functions.value()->*member)(std::forward<Arguments>(arguments)...);
}

} // namespace

Result<std::string> emitLlvmIr(const ir::Layout& layout, uint64_t codeHash, const LlvmOptions& options) {
  return call<&LlvmFunctions::irText>(layout, codeHash, options);
}

Result<std::string> emitAssembly(const ir::Layout& layout, uint64_t codeHash, const LlvmOptions& options) {
  return call<&LlvmFunctions::assembly>(layout, codeHash, options);
}

Result<std::string> buildLlvmSharedObject(const ir::Layout& layout, uint64_t codeHash, const LlvmOptions& options) {
  return call<&LlvmFunctions::sharedObject>(layout, codeHash, options);
}

Result<std::string> withSection(std::string_view object, std::string_view name, std::string_view contents) {
  return call<&LlvmFunctions::withSection>(object, name, contents);
}

Result<std::optional<std::string>> sectionOf(std::string_view object, std::string_view name) {
  return call<&LlvmFunctions::sectionOf>(object, name);
}

Result<std::unique_ptr<JitCode>> makeJitCode(const JitOptions& options) {
  return call<&LlvmFunctions::jitCode>(options);
}

} // namespace rung::codegen

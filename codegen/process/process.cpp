// Child processes by LLVM (see process.h).
#include "codegen/process/process.h"

#include <array>
#include <cstring>
#include <vector>

#include <llvm/Support/Program.h>

namespace rung::codegen {
namespace {

std::optional<llvm::StringRef> refOf(const std::optional<std::string>& path) {
  return path ? std::optional<llvm::StringRef>(*path) : std::nullopt;
}

} // namespace

std::optional<std::string> findProgram(std::string_view name) {
  if (name.empty()) return std::nullopt; // LLVM asserts that there is a name
  llvm::ErrorOr<std::string> found = llvm::sys::findProgramByName(name);
  if (!found || !llvm::sys::fs::can_execute(*found)) return std::nullopt;
  return std::move(*found);
}

Result<int> runProgram(std::span<const std::string> words, const ProcessOutput& output) {
  const std::string name = words.empty() ? "" : words.front();
  const std::optional<std::string> program = findProgram(name);
  if (!program) return failure("'" + name + "' is not an executable file, nor is it in a folder of PATH");
  const std::vector<llvm::StringRef> arguments(words.begin(), words.end());
  const std::array<std::optional<llvm::StringRef>, 3> redirects = {std::nullopt, refOf(output.out),
                                                                   refOf(output.error)};
  std::string error;
  const int code = llvm::sys::ExecuteAndWait(*program, arguments, std::nullopt, redirects, 0, 0, &error);
  if (code < 0) return failure("'" + *program + "': " + error);
  return code;
}

} // namespace rung::codegen

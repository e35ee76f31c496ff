// Other programs: where PATH has them, and running them. No shell takes part.
#pragma once
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "ir/support/result.h"

namespace rung::codegen {

/// Files that a program's output goes to, which must not exist yet; the same path for both is one file. Without a path
/// the output goes where this program's own does.
struct ProcessOutput {
  std::optional<std::string> out;
  std::optional<std::string> error;
};

/// The path of an executable file: `name` itself when it has a slash, else the first of that name in the folders of
/// PATH. Nothing when there is none.
std::optional<std::string> findProgram(std::string_view name);

/// Runs a program, words[0] as in findProgram with words as its arguments, and waits for its end, without a limit.
/// Gives its exit code, or a failure when it could not be started or a signal has ended it. From any thread.
Result<int> runProgram(std::span<const std::string> words, const ProcessOutput& output);

} // namespace rung::codegen

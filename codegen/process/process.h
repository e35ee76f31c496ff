// Finds programs in PATH and runs them, without a shell.
#pragma once
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "ir/support/result.h"

namespace rung::codegen {

/// Files for a program's output, which must not exist yet; the same path for both means one file. Without a path the
/// output goes where this program's own goes.
struct ProcessOutput {
  std::optional<std::string> out;
  std::optional<std::string> error;
};

/// The path of an executable file: `name` itself if it has a slash, otherwise the first file of that name in the
/// folders of PATH. Nothing if there is none.
std::optional<std::string> findProgram(std::string_view name);

/// Runs a program, words[0] as in findProgram with `words` as its arguments, and waits for its end, without a time
/// limit. Returns its exit code; fails if it could not be started or was ended by a signal. May be called on any
/// thread.
Result<int> runProgram(std::span<const std::string> words, const ProcessOutput& output);

} // namespace rung::codegen

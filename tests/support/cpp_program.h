// Programs as generated C++, built by the compiler and with the sanitizer of the tests themselves: the JIT's code
// carries no instrumentation.
#pragma once
#include <span>
#include <string>

#include "frontend/dialects/dialect.h"
#include "ir/support/result.h"

namespace rung::test {

// The bytes of the program's shared object, or what is wrong.
Result<std::string> buildCppProgram(const frontend::Dialect& dialect, SourceManager& sources,
                                    std::span<const FileId> files, const frontend::CompileOptions& options = {});

} // namespace rung::test

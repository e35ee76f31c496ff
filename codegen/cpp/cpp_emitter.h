// C++ back end: a module as one readable C++ file for g++ or clang++, without std and without globals except constant
// tables. Each rung is preceded by its comment and its source text, #line gives debuggers the PLC source, comments name
// the symbols.
#pragma once
#include <string>
#include <string_view>

#include "ir/shape/layout.h"
#include "ir/support/result.h"
#include "rtlib/text/embedded.h"

namespace rung::codegen {

struct CppOptions {
  // For compilation with debug information: memory has the program's names, and is up to date at the beginning of each
  // line.
  bool debugInfo = false;
};

// The text of the file. `codeHash` goes into the program's tables.
std::string emitCpp(const ir::Layout& layout, uint64_t codeHash, const CppOptions& options);

struct CppBuildOptions {
  // A compiler driver, with flags after it if needed: clang++-19, g++, aarch64-linux-gnu-g++ …
  std::string compiler = "c++";
  std::string optimisation = "-O2";
  bool debugInfo = true;
};

// Everything that determines the bytes that buildCppSharedObject makes: the text with its headers, the options, and the
// compiler's identity.
std::string cppBuildIdentity(std::string_view text, const CppBuildOptions& options);

// Compiles the text to the bytes of a shared object. The error is the compiler's output.
Result<std::string> buildCppSharedObject(std::string_view text, const CppBuildOptions& options);

// The headers of rtlib/abi that the text includes, by the names it uses: "rung/gen.hpp". The build makes this function.
std::span<const text::EmbeddedFile> abiHeaders();

} // namespace rung::codegen

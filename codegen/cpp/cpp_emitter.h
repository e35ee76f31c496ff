// C++ back end: a module as one readable C++ file for g++ or clang++, without std and without globals but constant
// tables. Above each rung are its comment and its source text, #line gives debuggers the PLC source, comments name
// the symbols.
#pragma once
#include <string>
#include <string_view>

#include "ir/shape/layout.h"
#include "ir/support/result.h"
#include "rtlib/text/embedded.h"

namespace rung::codegen {

struct CppOptions {
  // For a compiler that is asked for debug information: memory has the program's names, and is up to date where a line
  // begins.
  bool debugInfo = false;
};

// The text of the file. `codeHash` goes into the program's tables.
std::string emitCpp(const ir::Layout& layout, uint64_t codeHash, const CppOptions& options);

struct CppBuildOptions {
  // A driver, with flags of its own after it if need be: clang++-19, g++, aarch64-linux-gnu-g++ …
  std::string compiler = "c++";
  std::string optimisation = "-O2";
  bool debugInfo = true;
};

// All that decides the bytes of buildCppSharedObject: the text with its headers, the options, and which compiler it is.
std::string cppBuildIdentity(std::string_view text, const CppBuildOptions& options);

// Compiles the text to the bytes of a shared object. Fails with what the compiler said.
Result<std::string> buildCppSharedObject(std::string_view text, const CppBuildOptions& options);

// The headers of rtlib/abi that the text includes, by their names there: "rung/gen.hpp". The build makes this function.
std::span<const text::EmbeddedFile> abiHeaders();

} // namespace rung::codegen

// The engines by name, and the creation of an engine for a compiled program.
#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "codegen/jit/jit_engine.h"
#include "compiler/compile.h"
#include "ir/interp/interp.h"
#include "ir/support/result.h"
#include "rtlib/load/engine.h"
#include "rtlib/run/instance.h"

namespace rung::compiler {

enum class EngineKind : uint8_t {
  Interp, // the reference interpreter
  Cpp,    // generated C++, built to a shared object and loaded
  Llvm,   // LLVM object file, linked to a shared object and loaded
  Jit,    // LLVM, compiled in the process
  Tiered, // the interpreter until the JIT has compiled the code (tiered.h)
};

std::string_view engineName(EngineKind kind);
std::optional<EngineKind> engineFromName(std::string_view name);
// The engines that each translate a program in their own way: all but the last.
std::span<const EngineKind> allEngines();

struct EngineOptions {
  bool optimise = true;         // false: fastest compilation
  bool debugger = false;        // with debug information; the JIT registers its code with gdb
  std::string cacheFolder;      // of earlier code (object_folder.h, JitOptions); empty: no cache
  std::string cppCompiler;      // empty: the first of clang++-19, g++, c++ that is installed
  bool virtualClock = false;    // tiered: code need not keep up with a real clock
  bool countOperations = false; // interp: profile counters count operations executed, not time
  // interp: makes the observer of the program's rungs. May be empty.
  std::function<std::unique_ptr<ir::RungObserver>(const Compiled&)> observer;
};

// `compiled` must outlive the engine.
Result<std::unique_ptr<runtime::Engine>> makeEngine(EngineKind kind, const Compiled& compiled,
                                                    const EngineOptions& options);

// The program as a shared object, not sealed.
Result<std::string> sharedObject(const Compiled& compiled, const EngineOptions& options);

// The options of the JIT and the interpreter.
codegen::JitOptions jitOptionsOf(const EngineOptions& options);
ir::Counting countingOf(const EngineOptions& options);

// Problems of code that is compiled while the program runs; waits for code that is to be cached. "" also if no such
// code is made. The engine works in any case.
std::string codeTrouble(runtime::Engine& engine);

// The default C++ compiler: $CXX, otherwise the first installed one of clang++-19, g++, c++.
std::string defaultCppCompiler();

} // namespace rung::compiler

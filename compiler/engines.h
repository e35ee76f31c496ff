// The engines by name, and one of each kind for a compiled program.
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
  Tiered, // the interpreter until the code of the JIT is there (tiered.h)
};

std::string_view engineName(EngineKind kind);
std::optional<EngineKind> engineFromName(std::string_view name);
// Those that translate a program each in its own way: all but the last.
std::span<const EngineKind> allEngines();

struct EngineOptions {
  bool optimise = true;         // false: fastest compilation
  bool debugger = false;        // with debug information, and the code of the JIT is reported to gdb
  std::string cacheFolder;      // of code made before (object_folder.h, JitOptions); empty: no cache
  std::string cppCompiler;      // empty: the first of clang++-19, g++, c++ that is installed
  bool virtualClock = false;    // tiered: no code has to keep up with a clock
  bool countOperations = false; // interp: profile counters count operations executed, not time
  // Interpreter: makes what observes the program's rungs. May be empty.
  std::function<std::unique_ptr<ir::RungObserver>(const Compiled&)> observer;
};

// `compiled` outlives the engine.
Result<std::unique_ptr<runtime::Engine>> makeEngine(EngineKind kind, const Compiled& compiled,
                                                    const EngineOptions& options);

// The program as a shared object, not sealed.
Result<std::string> sharedObject(const Compiled& compiled, const EngineOptions& options);

// What the engines themselves are given.
codegen::JitOptions jitOptionsOf(const EngineOptions& options);
ir::Counting countingOf(const EngineOptions& options);

// What was wrong with code that is made while the program runs already; waits for it where a cache keeps it. "" also
// when none is made. The engine works either way.
std::string codeTrouble(runtime::Engine& engine);

// The C++ compiler to use when none is named: $CXX, else the first installed of clang++-19, g++, c++.
std::string defaultCppCompiler();

} // namespace rung::compiler

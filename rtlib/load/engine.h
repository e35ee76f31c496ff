// An engine: something that holds a runnable program, be it a loaded .so, JIT code or an interpreter's tables.
#pragma once
#include <string_view>

#include "rung/program.h"

namespace rung::runtime {

class Engine {
public:
  Engine() = default;
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;
  virtual ~Engine() = default;

  // Valid while the engine lives, as is every instance of it.
  virtual const rung_program& program() const = 0;
  virtual std::string_view name() const = 0; // "so", "jit", "interp"
  // What the program's chunks find in rung_ctx::engine.
  virtual void* context() { return nullptr; }
};

} // namespace rung::runtime

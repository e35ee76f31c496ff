// An engine owns a runnable program: a loaded .so, JIT code or an interpreter's tables.
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

  // The program; valid, like every instance of it, as long as the engine exists.
  virtual const rung_program& program() const = 0;
  virtual std::string_view name() const = 0; // "so", "jit", "interp"
  // rung_ctx::engine of the program's chunks.
  virtual void* context() { return nullptr; }
};

} // namespace rung::runtime

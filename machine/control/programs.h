// The source of programs, and of code with forced cells, for a controller. A test provides prepared ones.
#pragma once
#include <memory>
#include <string>

#include "rung/runtime.hpp"

namespace rung::control {

class Programs {
public:
  virtual ~Programs() = default;
  // Loads a compiled program; throws rung::Error if it cannot be loaded.
  virtual Image open(const std::string& path) = 0;
  // From now on code with forced cells can be made for a program of this image (rung_forces_new).
  virtual void serveForces(const Image& image) = 0;
  // Cancels the code that is being made.
  virtual void abandon() = 0;
};

// Programs from files, and code from the compiler process (machine/compile).
std::unique_ptr<Programs> programsOfMachine();

} // namespace rung::control

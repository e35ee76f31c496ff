// Where a controller gets programs and code with forced cells from. A test has them made already.
#pragma once
#include <memory>
#include <string>

#include "rung/runtime.hpp"

namespace rung::control {

class Programs {
public:
  virtual ~Programs() = default;
  // A compiled program; throws rung::Error where it cannot be loaded.
  virtual Image open(const std::string& path) = 0;
  // From now on code with forced cells can be had for a program of this image (rung_forces_new).
  virtual void serveForces(const Image& image) = 0;
  // What is being made is not wanted any more.
  virtual void abandon() = 0;
};

// Files, and the compiler process of the machine.
std::unique_ptr<Programs> programsOfMachine();

} // namespace rung::control

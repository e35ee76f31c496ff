// See image.h.
#include "machine/compile/image.h"

#include <stdexcept>

#include "machine/compile/compilation.h"

namespace rung::compile {

Image compiledImage(const std::string& path, uid_t user, std::string& warnings) {
  Compilation compilation({path}, user);
  const Compilation::State state = compilation.wait();
  if (state == Compilation::State::Errors) throw std::runtime_error(compilation.report()); // each with its file
  if (state != Compilation::State::Compiled)
    throw std::runtime_error("cannot compile " + path + ": " + compilation.report());
  warnings = compilation.report();
  return Image::ofMemory(compilation.image(), path);
}

} // namespace rung::compile

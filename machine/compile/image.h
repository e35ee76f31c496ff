// The program of a host at its start: a compiled one, or sources that are compiled first.
#pragma once
#include <sys/types.h>

#include <string>

#include "rung/runtime.hpp"

namespace rung::compile {

// Compiles a source file, or a project (its folder or project file), in a process of its own that reads it with the
// rights of `user`; waits for that. `warnings` gets what rungc would print. Throws std::runtime_error with all errors.
Image compiledImage(const std::string& path, uid_t user, std::string& warnings);

} // namespace rung::compile

// The program that a host starts to compile sources, rung-compile.
#pragma once
#include <string>

namespace rung::compile {

// Its path. An unprivileged process (rtlib/load/trust.h) takes the one of the environment variable RUNG_COMPILE, if
// that is set, or else one beside its own program, where a build has it, or where an installation below the prefix of
// that program has it. Empty, and `problem` says why: it is not there, or others than root, or the process's own user,
// could have changed it.
std::string compilerProgram(std::string& problem);

} // namespace rung::compile

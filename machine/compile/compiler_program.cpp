// See compiler_program.h.
#include "machine/compile/compiler_program.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <optional>

#include "rtlib/load/plugin.h"
#include "rtlib/load/trust.h"

namespace rung::compile {
namespace {

constexpr const char* kProgram = RUNG_COMPILE_PROGRAM; // where it is installed

std::string fileProblem(const std::string& path, const runtime::ProcessIds& ids) {
  const int file = open(path.c_str(), O_PATH | O_CLOEXEC);
  const std::optional<runtime::FileFacts> facts = runtime::factsOf(file);
  const std::string problem = facts ? runtime::ownerProblem(*facts, ids) : std::strerror(errno);
  if (file >= 0) close(file);
  return problem;
}

// What an unprivileged process takes.
std::string chosenProgram() {
  if (const char* named = secure_getenv("RUNG_COMPILE"); named != nullptr && *named == '/') return named;
  for (const char* place : {"/rung-compile", "/../libexec/rung/rung-compile"}) {
    std::string near = runtime::folderOfProgram() + place;
    if (access(near.c_str(), F_OK) == 0) return near;
  }
  return kProgram;
}

} // namespace

std::string compilerProgram(std::string& problem) {
  const runtime::ProcessIds ids = runtime::idsOfThisThread();
  const bool privileged = runtime::isPrivileged(ids);
  std::string path = privileged ? kProgram : chosenProgram();
  problem = privileged ? runtime::rootsFileProblem(path) : fileProblem(path, ids);
  if (problem.empty()) return path;
  problem = "sources cannot be compiled here: " + path + ": " + problem + "; install the package rung" +
            (privileged ? "" : ", or start the host with RUNG_COMPILE set to the path of rung-compile");
  return {};
}

} // namespace rung::compile

// See compiler_program.h.
#include "tools/sources/compiler_program.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <optional>

#include "rtlib/host/plugin.h"
#include "rtlib/host/trust.h"

namespace rung::sources {
namespace {

constexpr const char* kProgram = RUNG_COMPILE_PROGRAM; // where it is installed

std::string fileProblem(const std::string& path, const host::ProcessIds& ids) {
  const int file = open(path.c_str(), O_PATH | O_CLOEXEC);
  const std::optional<host::FileFacts> facts = host::factsOf(file);
  const std::string problem = facts ? host::ownerProblem(*facts, ids) : std::strerror(errno);
  if (file >= 0) close(file);
  return problem;
}

// What an unprivileged process takes.
std::string chosenProgram() {
  if (const char* named = secure_getenv("RUNG_COMPILE"); named != nullptr && *named == '/') return named;
  for (const char* place : {"/rung-compile", "/../libexec/rung/rung-compile"}) {
    std::string near = host::folderOfProgram() + place;
    if (access(near.c_str(), F_OK) == 0) return near;
  }
  return kProgram;
}

} // namespace

std::string compilerProgram(std::string& problem) {
  const host::ProcessIds ids = host::idsOfThisThread();
  const bool privileged = host::isPrivileged(ids);
  std::string path = privileged ? kProgram : chosenProgram();
  problem = privileged ? host::rootsFileProblem(path) : fileProblem(path, ids);
  if (problem.empty()) return path;
  problem = "sources cannot be compiled here: " + path + ": " + problem + "; install the package rung" +
            (privileged ? "" : ", or start the host with RUNG_COMPILE set to the path of rung-compile");
  return {};
}

} // namespace rung::sources

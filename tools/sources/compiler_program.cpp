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

} // namespace

std::string compilerProgram(std::string& problem) {
  const host::ProcessIds ids = host::idsOfThisThread();
  std::string path = kProgram;
  if (host::isPrivileged(ids)) {
    problem = host::rootsFileProblem(path);
  } else {
    const char* named = secure_getenv("RUNG_COMPILE");
    const std::string beside = host::folderOfProgram() + "/rung-compile";
    if (named != nullptr && *named == '/')
      path = named;
    else if (access(beside.c_str(), F_OK) == 0)
      path = beside;
    problem = fileProblem(path, ids);
  }
  if (problem.empty()) return path;
  problem = "sources cannot be compiled here: " + path + ": " + problem + "; the package rung has this program";
  return {};
}

} // namespace rung::sources

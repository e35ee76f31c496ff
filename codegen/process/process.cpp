// Runs child processes (see process.h).
#include "codegen/process/process.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <vector>

namespace rung::codegen {
namespace {

// Redirects a child's output.
class Redirects {
public:
  explicit Redirects(const ProcessOutput& output) {
    posix_spawn_file_actions_init(&actions_);
    if (output.out) open(STDOUT_FILENO, *output.out);
    if (output.error && output.error == output.out)
      posix_spawn_file_actions_adddup2(&actions_, STDOUT_FILENO, STDERR_FILENO);
    else if (output.error)
      open(STDERR_FILENO, *output.error);
  }
  ~Redirects() { posix_spawn_file_actions_destroy(&actions_); }
  Redirects(const Redirects&) = delete;
  Redirects& operator=(const Redirects&) = delete;
  const posix_spawn_file_actions_t* actions() const { return &actions_; }

private:
  void open(int file, const std::string& path) {
    constexpr int kNew = O_WRONLY | O_CREAT | O_TRUNC;
    posix_spawn_file_actions_addopen(&actions_, file, path.c_str(), kNew, 0666);
  }
  posix_spawn_file_actions_t actions_{};
};

bool isExecutable(const std::string& path) {
  std::error_code error;
  return std::filesystem::is_regular_file(path, error) && access(path.c_str(), X_OK) == 0;
}

// How the child ended, as waitpid reports it; nothing, with errno, if that is unknown.
std::optional<int> waitFor(pid_t child) {
  int status = 0;
  pid_t ended = 0;
  do ended = waitpid(child, &status, 0);
  while (ended < 0 && errno == EINTR);
  return ended == child ? std::optional(status) : std::nullopt;
}

} // namespace

std::optional<std::string> findProgram(std::string_view name) {
  if (name.empty()) return std::nullopt;
  if (name.find('/') != std::string_view::npos)
    return isExecutable(std::string(name)) ? std::optional<std::string>(name) : std::nullopt;
  const char* path = std::getenv("PATH");
  std::string_view rest = path == nullptr ? "" : path;
  while (!rest.empty()) {
    const size_t end = std::min(rest.find(':'), rest.size());
    std::string candidate = std::string(rest.substr(0, end)).append("/").append(name);
    if (end > 0 && isExecutable(candidate)) return candidate;
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return std::nullopt;
}

Result<int> runProgram(std::span<const std::string> words, const ProcessOutput& output) {
  const std::string name = words.empty() ? "" : words.front();
  const std::optional<std::string> program = findProgram(name);
  if (!program) return failure("'" + name + "' is not an executable file, nor is it in a folder of PATH");
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  const Redirects redirects(output);
  pid_t child = 0;
  const int error = posix_spawn(&child, program->c_str(), redirects.actions(), nullptr, arguments.data(), environ);
  if (error != 0) return failure("'" + *program + "': " + std::strerror(error));
  const std::optional<int> status = waitFor(child);
  if (!status) return failure("'" + *program + "': " + std::strerror(errno));
  if (WIFSIGNALED(*status)) return failure("'" + *program + "': " + strsignal(WTERMSIG(*status)));
  return WEXITSTATUS(*status);
}

} // namespace rung::codegen

// Runs a C++ compiler on generated text (see cpp_emitter.h).
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <optional>
#include <spawn.h>
#include <sstream>
#include <sys/wait.h>
#include <vector>

#include "codegen/cpp/cpp_emitter.h"
#include "codegen/cpp/embedded_headers.h"
#include "ir/support/temporary_folder.h"

extern char** environ;

namespace rung::codegen {
namespace {

namespace fs = std::filesystem;

bool writeFile(const fs::path& path, std::string_view text) {
  std::error_code error;
  fs::create_directories(path.parent_path(), error);
  std::ofstream out(path, std::ios::binary);
  out.write(text.data(), static_cast<std::streamsize>(text.size()));
  return out.good();
}

// Runs a program with its output in `log`. Gives its exit code, or a failure when it could not be started.
Result<int> run(const std::vector<std::string>& words, const fs::path& log) {
  std::vector<char*> argv;
  for (const std::string& word : words) argv.push_back(const_cast<char*>(word.c_str()));
  argv.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
  pid_t child = 0;
  const int error = posix_spawnp(&child, argv[0], &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) return failure(fmt::format("cannot run the C++ compiler '{}': {}", words[0], std::strerror(error)));
  int status = 0;
  while (waitpid(child, &status, 0) < 0)
    if (errno != EINTR) return failure(fmt::format("cannot wait for '{}': {}", words[0], std::strerror(errno)));
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

void appendWords(std::string_view text, std::vector<std::string>& words) {
  std::istringstream in{std::string(text)};
  for (std::string word; in >> word;) words.push_back(word);
}

} // namespace

Result<std::string> buildCppSharedObject(std::string_view text, const CppBuildOptions& options) {
  TemporaryFolder folder;
  if (!folder.ok()) return failure(fmt::format("cannot make a temporary folder: {}", std::strerror(errno)));
  bool written = writeFile(folder / "program.cpp", text);
  for (const EmbeddedHeader& header : embeddedHeaders())
    written = written && writeFile(folder / header.name, header.text);
  if (!written) return failure("cannot write the generated C++ to a temporary folder");

  std::vector<std::string> words;
  appendWords(options.compiler, words);
  // Vectors would be of coils of neighbouring rungs, and cost more to put together than their stores do.
  appendWords("-x c++ -std=c++20 -fPIC -shared -fvisibility=hidden -fno-exceptions -fno-rtti -ffp-contract=off "
              "-fno-math-errno -fno-strict-aliasing -fno-tree-slp-vectorize -w",
              words);
  words.push_back(options.optimisation);
  if (options.debugInfo) words.push_back("-gdwarf-4");
  for (std::string word : {std::string("-I"), (folder / ".").string(), (folder / "program.cpp").string(),
                           std::string("-o"), (folder / "program.so").string()})
    words.push_back(std::move(word));
  Result<int> code = run(words, folder / "log");
  if (!code.ok()) return code.failure();
  if (code.value() != 0)
    return failure(fmt::format("the C++ compiler '{}' failed:\n{}", words[0], folder.contentsOf("log").value_or("")));
  std::optional<std::string> image = folder.contentsOf("program.so");
  if (!image) return failure(fmt::format("the C++ compiler '{}' made no shared object", words[0]));
  return std::move(*image);
}

} // namespace rung::codegen

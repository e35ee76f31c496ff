// See rungc.h.
#include "machine/rungctl/rungc.h"

#include <unistd.h>

#include <filesystem>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace rung::rungctl {

namespace {

// Of this installation, otherwise any: execvp looks a name without a folder up.
std::string programPath() {
  std::error_code none;
  const std::filesystem::path beside = std::filesystem::read_symlink("/proc/self/exe", none).parent_path() / "rungc";
  return std::filesystem::exists(beside, none) ? beside.string() : "rungc";
}

// This process becomes rungc, which connects to the host itself.
int becomeRungc(std::vector<std::string> words) {
  words.insert(words.begin(), programPath());
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  (void)execvp(arguments[0], arguments.data());
  return fail("cannot start rungc, which draws programs and plays recordings: it is neither beside rungctl nor in the "
              "PATH; both are in the package rung",
              cli::kEnvironment);
}

std::vector<std::string> commandOf(Client& client, const char* command) { return {command, "--host", client.host()}; }

} // namespace

int web(Client& client, const Words& words) {
  std::vector<std::string> command = commandOf(client, "web");
  if (!words.listen.empty()) command.insert(command.end(), {"--listen", words.listen});
  command.insert(command.end(), words.files.begin(), words.files.end());
  return becomeRungc(std::move(command));
}

int why(Client& client, const Words& words) {
  std::vector<std::string> command = commandOf(client, "replay");
  command.insert(command.end(), {"--why", words.name});
  if (words.common.asJson) command.emplace_back("--json");
  return becomeRungc(std::move(command));
}

} // namespace rung::rungctl

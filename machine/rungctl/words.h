// The arguments of commands, and the functions that all commands share: request, print and fail.
#pragma once
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "machine/command-line/usage.h"
#include "machine/control/client.h"

namespace rung::rungctl {

using control::asked;
using control::Client;

// Arguments of all commands.
struct Common {
  std::string host;
  bool asJson = false;
};

// The arguments of a command.
struct Words {
  Common common;
  std::vector<std::string> names;
  std::string name;
  std::string value;
  std::string file;
  std::vector<std::string> files;
  std::string listen;
  double seconds = 0;
  bool all = false;
  bool follow = false;
  bool on = false;
  unsigned shadow = 0; // number of scans
  bool yes = false;
  bool late = false;
  unsigned top = 20;
  std::string by = "time";
  bool reset = false;
  bool acknowledge = false;
  std::optional<uint64_t> most; // entries of the log
  std::string since;
  std::vector<std::string> kinds;
  bool once = false;
  bool profile = false; // the sources are compiled with profile counters
};

// Prints the reason on standard error; returns the exit status.
int fail(const std::string& message, int status = cli::kWrong);
// A JSON value as text; strings without quotes.
std::string shown(const nlohmann::json& value);
// Prints the answer with --json, otherwise the text.
void print(const Words& words, const nlohmann::json& answer, const std::string& text);

} // namespace rung::rungctl

// The command rungctl status, and its parts for other views.
#pragma once
#include <string>
#include <vector>

#include "machine/rungctl/words.h"

namespace rung::rungctl {

int status(Client& client, const Words& words);

// Texts from the answer to `status`:
// "running: 124 scans, 0 missed; program time 0.992 s", or why it does not run; one line, or two.
std::string stateText(const nlohmann::json& status);
// A function that the program has not finished, or a request to its CNC that is not answered.
struct Waiting {
  std::string text;
  bool late = false; // longer than the mapping file expects
};
std::vector<Waiting> waitingOf(const nlohmann::json& status);

} // namespace rung::rungctl

// The command line as data, for what describes it elsewhere: manual pages and completion.
#pragma once
#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace rung::rungc {

// In the order in which they are listed.
std::vector<const CLI::App*> commandsOf(const CLI::App& app);

struct OptionText {
  std::vector<std::string> names;   // "-q", "--quiet"; of a word that is not an option, none
  std::string word;                 // what follows it, "TEXT"; "" of a flag
  std::vector<std::string> choices; // the only values that it takes; empty: any
  std::string description;          // one line
  bool repeated = false;            // more than one value
  bool required = false;
};

// Options that may be seen, then words, each in the order in which they were added.
std::vector<OptionText> optionsOf(const CLI::App& command);

} // namespace rung::rungc

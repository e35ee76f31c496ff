// rungc help, and wrong command lines (see usage.h).
#include "tools/rungc/usage.h"

#include <algorithm>
#include <fmt/format.h>
#include <iostream>
#include <memory>
#include <string_view>

#include "ir/support/similar.h"
#include "tools/rungc/commands.h"
#include "tools/rungc/manual.h"

namespace rung::rungc {
namespace {

std::string shortHelp(const CommandLine& app) {
  std::string text = app.root().description() + "\n\n";
  for (const Command& command : app.commands())
    text += fmt::format("  rungc {:<9} {}\n", command.name(), command.description());
  return text + "\nrungc help COMMAND says more about one; docs/guide.md shows them at work.\n";
}

// " (did you mean check?)"
std::string didYouMean(const Similar& similar, std::string_view dashes = "") {
  return similar.best().empty() ? "" : fmt::format("; did you mean {}{}?", dashes, similar.best());
}

std::string unknownCommand(const CommandLine& app, const std::string& word) {
  Similar similar(word);
  for (const Command& command : app.commands()) similar.offer(command.name());
  return fmt::format("there is no command '{}'{} `rungc help` lists them", word,
                     similar.best().empty() ? ";" : didYouMean(similar));
}

std::string unknownOption(Command command, const std::string& word) {
  const std::string name =
      word.substr(0, word.find('=')).substr(std::min<size_t>(word.find_first_not_of('-'), word.size()));
  const std::vector<OptionText> options = command.options();
  Similar similar(name);
  for (const OptionText& option : options)
    for (const std::string_view known : option.names)
      if (known.starts_with("--")) similar.offer(known.substr(2));
  return fmt::format("rungc {} has no option '{}'{}", command.name(), word, didYouMean(similar, "--"));
}

std::string wrongWord(Command command, const std::string& word) {
  if (word.starts_with('-')) return unknownOption(command, word);
  return fmt::format("rungc {} takes no further word: '{}'", command.name(), word);
}

} // namespace

int wrongUsage(const CommandLine& app, const WrongWords& words) {
  if (!words.command && words.unread.empty()) {
    std::cerr << shortHelp(app);
    return kUsage;
  }
  if (!words.command) return usageError(unknownCommand(app, words.unread.front()));
  const Command& command = *words.command;
  const std::string text = words.unread.empty() ? fmt::format("{}: {}", command.name(), words.text)
                                                : wrongWord(command, words.unread.front());
  return usageError(fmt::format("{}; `rungc help {}` shows what it takes", text, command.name()));
}

void addHelp(CommandLine& app, int& status) {
  Command command = app.add("help", "List the commands, or say what one takes");
  auto word = std::make_shared<std::string>();
  auto man = std::make_shared<bool>(false);
  command.option("COMMAND", *word, "The command");
  command.flag("--man", *man, "As the source of a manual page, for man -l -");
  command.onRun([&app, word, man, &status] {
    if (word->empty()) {
      std::cout << (*man ? manualPage(app, app.root()) : shortHelp(app));
      return;
    }
    const std::vector<Command> commands = app.commands();
    const auto named = std::ranges::find(commands, *word, &Command::name);
    if (named == commands.end())
      status = usageError(unknownCommand(app, *word));
    else
      std::cout << (*man ? manualPage(app, *named) : named->help());
  });
}

} // namespace rung::rungc

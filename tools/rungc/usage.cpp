// rungc help, and wrong command lines (see usage.h).
#include "tools/rungc/usage.h"

#include <algorithm>
#include <fmt/format.h>
#include <iostream>

#include "ir/support/similar.h"
#include "tools/rungc/commands.h"

namespace rung::rungc {
namespace {

std::vector<const CLI::App*> commandsOf(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App*) { return true; });
}

std::string shortHelp(const CLI::App& app) {
  std::string text = app.get_description() + "\n\n";
  for (const CLI::App* command : commandsOf(app))
    text += fmt::format("  rungc {:<9} {}\n", command->get_name(), command->get_description());
  return text + "\nrungc help COMMAND says more about one; docs/guide.md shows them at work.\n";
}

// " (did you mean check?)"
std::string didYouMean(const Similar& similar, std::string_view dashes = "") {
  return similar.best().empty() ? "" : fmt::format("; did you mean {}{}?", dashes, similar.best());
}

std::string unknownCommand(const CLI::App& app, const std::string& word) {
  Similar similar(word);
  for (const CLI::App* command : commandsOf(app)) similar.offer(command->get_name());
  return fmt::format("there is no command '{}'{} `rungc help` lists them", word,
                     similar.best().empty() ? ";" : didYouMean(similar));
}

std::string unknownOption(const CLI::App& command, const std::string& word) {
  const std::string name =
      word.substr(0, word.find('=')).substr(std::min<size_t>(word.find_first_not_of('-'), word.size()));
  Similar similar(name);
  for (const CLI::Option* option : command.get_options())
    for (const std::string& known : option->get_lnames()) similar.offer(known);
  return fmt::format("rungc {} has no option '{}'{}", command.get_name(), word, didYouMean(similar, "--"));
}

const CLI::App* commandOf(const CLI::App& app) {
  const auto named = app.get_subcommands();
  return named.empty() ? nullptr : named.front();
}

std::string wrongWord(const CLI::App& command, const std::string& word) {
  if (word.starts_with('-')) return unknownOption(command, word);
  return fmt::format("rungc {} takes no further word: '{}'", command.get_name(), word);
}

} // namespace

int wrongUsage(const CLI::App& app, const CLI::ParseError& error) {
  const CLI::App* command = commandOf(app);
  const std::vector<std::string> unread = command == nullptr ? app.remaining() : command->remaining();
  if (command == nullptr && unread.empty()) {
    std::cerr << shortHelp(app);
    return kUsage;
  }
  if (command == nullptr) return usageError(unknownCommand(app, unread.front()));
  const std::string text =
      unread.empty() ? fmt::format("{}: {}", command->get_name(), error.what()) : wrongWord(*command, unread.front());
  return usageError(fmt::format("{}; `rungc help {}` shows what it takes", text, command->get_name()));
}

void addHelp(CLI::App& app, int& status) {
  CLI::App* command = app.add_subcommand("help", "List the commands, or say what one takes");
  auto word = std::make_shared<std::string>();
  command->add_option("COMMAND", *word, "The command");
  command->callback([&app, word, &status] {
    if (word->empty()) {
      std::cout << shortHelp(app);
      return;
    }
    const std::vector<const CLI::App*> commands = commandsOf(app);
    const auto named =
        std::find_if(commands.begin(), commands.end(), [&](const CLI::App* c) { return c->get_name() == *word; });
    if (named == commands.end())
      status = usageError(unknownCommand(app, *word));
    else
      std::cout << (*named)->help("rungc");
  });
}

} // namespace rung::rungc

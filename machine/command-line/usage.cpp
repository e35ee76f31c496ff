// See usage.h.
#include "machine/command-line/usage.h"

#include <algorithm>
#include <fmt/format.h>
#include <iostream>
#include <memory>
#include <optional>
#include <string_view>

#include "machine/command-line/completion.h"
#include "machine/command-line/manual.h"
#include "rtlib/text/similar.h"

namespace rung::cli {
namespace {

std::string shortHelp(const CommandLine& app) {
  size_t width = 0;
  for (const Command& command : app.commands()) width = std::max(width, command.name().size());
  std::string text = app.root().description() + "\n";
  for (const Command& command : app.commands())
    text += fmt::format("  {} {:<{}} {}\n", app.text().name, command.name(), width, command.description());
  return text + fmt::format("\n{} help COMMAND shows the options of a command; {} has examples.\n", app.text().name,
                            app.text().guide);
}

std::string unknownCommand(const CommandLine& app, const std::string& word) {
  const std::string_view meant = text::mostSimilar(word, app.commands(), &Command::name);
  return fmt::format("there is no command '{}'{} `{} help` lists them", word,
                     meant.empty() ? ";" : text::didYouMean(meant), app.text().name);
}

std::string unknownOption(const std::string& program, Command command, const std::string& word) {
  const std::string name =
      word.substr(0, word.find('=')).substr(std::min<size_t>(word.find_first_not_of('-'), word.size()));
  const std::vector<OptionText> options = command.options();
  text::Similar similar(name);
  for (const OptionText& option : options)
    for (const std::string_view known : option.names)
      if (known.starts_with("--")) similar.offer(known.substr(2));
  const std::string meant = similar.best().empty() ? "" : fmt::format("--{}", similar.best());
  return fmt::format("{} {} has no option '{}'{}", program, command.name(), word, text::didYouMean(meant));
}

std::string wrongWord(const std::string& program, Command command, const std::string& word) {
  if (word.starts_with('-')) return unknownOption(program, command, word);
  return fmt::format("{} {} takes no further argument: '{}'", program, command.name(), word);
}

} // namespace

std::string wrongUsage(const CommandLine& app, const WrongWords& words) {
  if (!words.command && words.unread.empty()) return shortHelp(app);
  const std::string& program = app.text().name;
  if (!words.command) return fmt::format("{}: {}\n", program, unknownCommand(app, words.unread.front()));
  const Command& command = *words.command;
  const std::string text = words.unread.empty() ? fmt::format("{}: {}", command.name(), words.text)
                                                : wrongWord(program, command, words.unread.front());
  return fmt::format("{0}: {1}; `{0} help {2}` shows its arguments and options\n", program, text, command.name());
}

// The text that `help` prints; nothing if there is no such command.
std::optional<std::string> help(const CommandLine& app, const std::string& word, bool asManual) {
  if (word.empty()) return asManual ? manualPage(app, app.root()) : shortHelp(app);
  const std::vector<Command> commands = app.commands();
  const auto named = std::ranges::find(commands, word, &Command::name);
  if (named == commands.end()) return std::nullopt;
  return asManual ? manualPage(app, *named) : named->help();
}

void addUsage(CommandLine& app, int& status) {
  if (app.commands().empty())
    return app.root().textFlag("--man", "Print the source of the manual page, for man -l -",
                               [&app] { return manualPage(app, app.root()); });
  struct Words {
    std::string word;
    bool man = false;
  };
  auto words = std::make_shared<Words>();
  Command completion = app.add("completion", "Print the completion script of a shell");
  auto shell = std::make_shared<std::string>();
  completion.option("SHELL", *shell, "The shell for which completions are printed").required().oneOf({"bash", "zsh"});
  completion.onRun([&app, shell] { std::cout << (*shell == "bash" ? bashCompletion(app) : zshCompletion(app)); });
  Command command = app.add("help", "List the commands, or show the options of one");
  command.option("COMMAND", words->word, "The command");
  command.flag("--man", words->man, "Print the source of a manual page, for man -l -");
  command.onRun([&app, words, &status] {
    const std::optional<std::string> text = help(app, words->word, words->man);
    if (text) {
      std::cout << *text;
      return;
    }
    std::cerr << app.text().name << ": " << unknownCommand(app, words->word) << '\n';
    status = kUsage;
  });
}

} // namespace rung::cli

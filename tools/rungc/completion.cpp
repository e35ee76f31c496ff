// See completion.h; the command prints what it is in the packages of shells.
#include "tools/rungc/completion.h"

#include <fmt/format.h>
#include <iostream>

#include "tools/rungc/command_line.h"
#include "tools/rungc/commands.h"

namespace rung::rungc {
namespace {

std::string joined(const std::vector<std::string>& words) { return fmt::format("{}", fmt::join(words, " ")); }

std::vector<std::string> namesOf(const std::vector<const CLI::App*>& commands) {
  std::vector<std::string> names;
  for (const CLI::App* command : commands) names.push_back(command->get_name());
  return names;
}

// What is left of a command's choices where `help` takes the name of one.
std::vector<std::string> choicesOf(const CLI::App& app, const CLI::App& command, const OptionText& option) {
  const bool helped = command.get_name() == "help" && option.word == "COMMAND";
  return helped ? namesOf(commandsOf(app)) : option.choices;
}

// ---- bash ----------------------------------------------------------------------------------------------------------

std::string bashCase(const CLI::App& app, const CLI::App& command) {
  std::string values; // of the option before the word
  std::vector<std::string> words, free;
  for (const OptionText& option : optionsOf(command)) {
    words.insert(words.end(), option.names.begin(), option.names.end());
    const std::vector<std::string> choices = choicesOf(app, command, option);
    if (option.names.empty())
      free.insert(free.end(), choices.begin(), choices.end());
    else if (!choices.empty())
      values += fmt::format("        {}) values=\"{}\" ;;\n", fmt::join(option.names, "|"), joined(choices));
  }
  std::string text = fmt::format("    {})\n", command.get_name());
  if (!values.empty()) text += "      case $previous in\n" + values + "      esac\n";
  text += fmt::format("      options=\"{}\"\n", joined(words));
  if (!free.empty()) text += fmt::format("      words=\"{}\"\n", joined(free));
  return text + "      ;;\n";
}

// ---- zsh -----------------------------------------------------------------------------------------------------------

// Within single quotes and brackets.
std::string zshText(const std::string& text) {
  std::string quoted;
  for (const char c : text) {
    if (c == '\'')
      quoted += "'\\''";
    else if (c == '[' || c == ']' || c == '\\' || c == ':')
      quoted += std::string("\\") + c;
    else
      quoted += c;
  }
  return quoted;
}

// "-q" and "--quiet" are one option: after one of them neither is offered.
std::string zshBefore(const OptionText& option) {
  if (option.repeated) return "*";
  return option.names.size() > 1 ? "(" + joined(option.names) + ")" : "";
}

// Of a word that may be left out there are two colons.
std::string zshColons(const OptionText& option) {
  if (option.repeated) return "*";
  return option.required ? "" : ":";
}

std::string zshValue(const OptionText& option, const std::vector<std::string>& choices) {
  if (option.word.empty()) return "";
  return fmt::format(":{}:{}", option.word, choices.empty() ? "_files" : "(" + joined(choices) + ")");
}

std::string zshCase(const CLI::App& app, const CLI::App& command) {
  std::string text = fmt::format("    {})\n      _arguments", command.get_name());
  for (const OptionText& option : optionsOf(command)) {
    const std::string value = zshValue(option, choicesOf(app, command, option));
    if (option.names.empty()) text += fmt::format(" \\\n        '{}{}'", zshColons(option), value);
    for (const std::string& name : option.names)
      text += fmt::format(" \\\n        '{}{}[{}]{}'", zshBefore(option), name, zshText(option.description), value);
  }
  return text + "\n      ;;\n";
}

} // namespace

std::string bashCompletion(const CLI::App& app) {
  std::string text = R"(# Completion of rungc in bash, made by `rungc completion bash`.
_rungc() {
  local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD-1]}
  local command= options= words= values= i
  # Readline takes the = of --via=cpp for a word.
  if [[ $current == = ]]; then
    current=
  elif [[ $previous == = ]]; then
    previous=${COMP_WORDS[COMP_CWORD-2]}
  fi
  for ((i = 1; i < COMP_CWORD; ++i)); do
    if [[ ${COMP_WORDS[i]} != -* ]]; then command=${COMP_WORDS[i]}; break; fi
  done
  COMPREPLY=()
  case $command in
)";
  text += fmt::format("    '') options=\"--help --version\" words=\"{}\" ;;\n", joined(namesOf(commandsOf(app))));
  for (const CLI::App* command : commandsOf(app)) text += bashCase(app, *command);
  return text + R"(  esac
  for ((++i; i < COMP_CWORD; ++i)); do # the word that has a choice is there: files follow
    if [[ " $words " == *" ${COMP_WORDS[i]} "* ]]; then words=; fi
  done
  if [[ -n $values ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$values" -- "$current")
  elif [[ $current == -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$options" -- "$current")
  elif [[ -n $words ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$words" -- "$current")
  fi
}
complete -o bashdefault -o default -F _rungc rungc
)";
}

std::string zshCompletion(const CLI::App& app) {
  std::string text = R"(#compdef rungc
# Completion of rungc in zsh, made by `rungc completion zsh`.
_rungc() {
  local -a commands
  commands=(
)";
  for (const CLI::App* command : commandsOf(app))
    text += fmt::format("    '{}:{}'\n", command->get_name(), zshText(command->get_description()));
  text += R"(  )
  if (( CURRENT == 2 )); then
    _describe command commands
    return
  fi
  local command=$words[2]
  shift words
  (( CURRENT-- ))
  case $command in
)";
  for (const CLI::App* command : commandsOf(app)) text += zshCase(app, *command);
  return text + R"(  esac
}
_rungc "$@"
)";
}

void addCompletion(CLI::App& app, int& status) {
  CLI::App* command = app.add_subcommand("completion", "Print the completion of command lines for a shell");
  auto shell = std::make_shared<std::string>();
  command->add_option("SHELL", *shell, "The shell; bash and zsh read it from the file that they look for")
      ->required()
      ->check(CLI::IsMember({"bash", "zsh"}));
  command->callback([&app, shell, &status] {
    std::cout << (*shell == "bash" ? bashCompletion(app) : zshCompletion(app));
    status = kOk;
  });
}

} // namespace rung::rungc

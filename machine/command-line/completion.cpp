// See completion.h.
#include "machine/command-line/completion.h"

#include <fmt/format.h>

namespace rung::cli {
namespace {

std::string joined(const std::vector<std::string>& words) { return fmt::format("{}", fmt::join(words, " ")); }

std::vector<std::string> namesOf(const std::vector<Command>& commands) {
  std::vector<std::string> names;
  for (const Command& command : commands) names.push_back(command.name());
  return names;
}

// The choices of an option; for the argument of `help`, the names of the commands.
std::vector<std::string> choicesOf(const CommandLine& app, Command command, const OptionText& option) {
  const bool helped = command.name() == "help" && option.word == "COMMAND";
  return helped ? namesOf(app.commands()) : option.choices;
}

// ---- bash ----------------------------------------------------------------------------------------------------------

std::string bashCase(const CommandLine& app, Command command) {
  std::string values; // cases for the option before the word
  std::vector<std::string> words, free;
  for (const OptionText& option : command.options()) {
    words.insert(words.end(), option.names.begin(), option.names.end());
    const std::vector<std::string> choices = choicesOf(app, command, option);
    if (option.names.empty())
      free.insert(free.end(), choices.begin(), choices.end());
    else if (!choices.empty())
      values += fmt::format("        {}) values=\"{}\" ;;\n", fmt::join(option.names, "|"), joined(choices));
  }
  std::string text = fmt::format("    {})\n", command.name());
  if (!values.empty()) text += "      case $previous in\n" + values + "      esac\n";
  text += fmt::format("      options=\"{}\"\n", joined(words));
  if (!free.empty()) text += fmt::format("      words=\"{}\"\n", joined(free));
  return text + "      ;;\n";
}

// ---- zsh -----------------------------------------------------------------------------------------------------------

// Escapes a text within single quotes and brackets.
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

// "-q" and "--quiet" are one option: after one of them, neither is offered.
std::string zshBefore(const OptionText& option) {
  if (option.repeated) return "*";
  return option.names.size() > 1 ? "(" + joined(option.names) + ")" : "";
}

// An optional argument has two colons.
std::string zshColons(const OptionText& option) {
  if (option.repeated) return "*";
  return option.required ? "" : ":";
}

std::string zshValue(const OptionText& option, const std::vector<std::string>& choices) {
  if (option.word.empty()) return "";
  return fmt::format(":{}:{}", option.word, choices.empty() ? "_files" : "(" + joined(choices) + ")");
}

std::string zshCase(const CommandLine& app, Command command) {
  std::string text = fmt::format("    {})\n      _arguments", command.name());
  for (const OptionText& option : command.options()) {
    const std::string value = zshValue(option, choicesOf(app, command, option));
    if (option.names.empty()) text += fmt::format(" \\\n        '{}{}'", zshColons(option), value);
    for (const std::string& name : option.names)
      text += fmt::format(" \\\n        '{}{}[{}]{}'", zshBefore(option), name, zshText(option.description), value);
  }
  return text + "\n      ;;\n";
}

} // namespace

std::string bashCompletion(const CommandLine& app) {
  const std::string& name = app.text().name;
  std::string text = fmt::format("# Completion of {0} in bash, made by `{0} completion bash`.\n_{0}() {{\n", name);
  text += R"(  local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD-1]}
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
  text += fmt::format("    '') options=\"--help --version\" words=\"{}\" ;;\n", joined(namesOf(app.commands())));
  for (const Command& command : app.commands()) text += bashCase(app, command);
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
)" + fmt::format("complete -o bashdefault -o default -F _{0} {0}\n", name);
}

std::string zshCompletion(const CommandLine& app) {
  const std::string& name = app.text().name;
  std::string text =
      fmt::format("#compdef {0}\n# Completion of {0} in zsh, made by `{0} completion zsh`.\n_{0}() {{\n", name);
  text += R"(  local -a commands
  commands=(
)";
  for (const Command& command : app.commands())
    text += fmt::format("    '{}:{}'\n", command.name(), zshText(command.description()));
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
  for (const Command& command : app.commands()) text += zshCase(app, command);
  return text + R"(  esac
}
)" + fmt::format("_{} \"$@\"\n", name);
}

} // namespace rung::cli

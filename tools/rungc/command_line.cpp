// See command_line.h.
#include "tools/rungc/command_line.h"

#include <algorithm>

namespace rung::rungc {
namespace {

// CLI11 writes the choices into the name of the type: "TEXT:{auto,always,never}".
std::vector<std::string> choicesIn(const std::string& type) {
  const size_t begin = type.find('{');
  if (begin == std::string::npos) return {};
  return CLI::detail::split(type.substr(begin + 1, type.find('}', begin) - begin - 1), ',');
}

// "--engine" and "--scans" of those that the option needs or excludes.
std::string namesOf(const std::set<CLI::Option*>& options) {
  std::vector<std::string> names;
  for (const CLI::Option* option : options) names.push_back(option->get_name());
  std::ranges::sort(names);
  return CLI::detail::join(names, ", ");
}

std::string describe(const CLI::Option& option) {
  std::string text = option.get_description();
  if (!option.get_default_str().empty()) text += "; default: " + option.get_default_str();
  if (!option.get_needs().empty()) text += "; needs " + namesOf(option.get_needs());
  if (!option.get_excludes().empty()) text += "; not with " + namesOf(option.get_excludes());
  return text;
}

OptionText textOf(const CLI::Option& option) {
  OptionText text;
  for (const std::string& name : option.get_snames()) text.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) text.names.push_back("--" + name);
  if (option.get_type_size() != 0) {
    const std::string type = option.get_type_name();
    text.word = option.get_positional() ? option.get_name(true) : type.substr(0, type.find(':'));
    text.choices = choicesIn(type);
  }
  text.description = describe(option);
  text.repeated = option.get_expected_max() > 1;
  text.required = option.get_required();
  return text;
}

} // namespace

std::vector<const CLI::App*> commandsOf(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App*) { return true; });
}

std::vector<OptionText> optionsOf(const CLI::App& command) {
  std::vector<OptionText> texts;
  for (const bool positional : {false, true})
    for (const CLI::Option* option : command.get_options())
      if (option->get_positional() == positional && !option->get_group().empty()) texts.push_back(textOf(*option));
  return texts;
}

} // namespace rung::rungc

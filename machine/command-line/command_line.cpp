// See command_line.h.
#include "machine/command-line/command_line.h"

#include <fcntl.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <iostream>
#include <set>
#include <string_view>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "rtlib/text/version.h"

namespace rung::cli {
namespace {

// CLI11 includes the choices in the name of the type: "TEXT:{auto,always,never}".
std::vector<std::string> choicesIn(const std::string& type) {
  const size_t begin = type.find('{');
  if (begin == std::string::npos) return {};
  return CLI::detail::split(type.substr(begin + 1, type.find('}', begin) - begin - 1), ',');
}

// The names of options that an option needs or excludes: "--engine" and "--scans".
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

WrongWords wrongWords(CLI::App& app, const CLI::ParseError& error) {
  const std::vector<CLI::App*> named = app.get_subcommands();
  if (named.empty()) return {std::nullopt, app.remaining(), error.what()};
  return {Command(named.front()), named.front()->remaining(), error.what()};
}

} // namespace

Option Option::required() { return Option(option_->required()); }
Option Option::oneOf(std::vector<std::string> choices) {
  return Option(option_->check(CLI::IsMember(std::move(choices))));
}
Option Option::between(int least, int most) { return Option(option_->check(CLI::Range(least, most))); }
Option Option::between(unsigned least, unsigned most) { return Option(option_->check(CLI::Range(least, most))); }
Option Option::between(uint64_t least, uint64_t most) { return Option(option_->check(CLI::Range(least, most))); }
Option Option::between(double least, double most) {
  const std::string range = fmt::format("FLOAT in [{} - {}]", least, most);
  // CLI::Range accepts "nan", which is neither below nor above.
  const auto check = [least, most, range](const std::string& text) {
    double value = 0;
    const bool isInside = CLI::detail::lexical_cast(text, value) && value >= least && value <= most;
    return isInside ? "" : fmt::format("Value {} is not a {}", text, range);
  };
  return Option(option_->check(check, range));
}
Option Option::excludes(Option other) { return Option(option_->excludes(other.option_)); }
Option Option::needs(Option other) { return Option(option_->needs(other.option_)); }
Option Option::oneValue() { return Option(option_->allow_extra_args(false)); }
Option Option::manyValues() { return Option(option_->allow_extra_args()); }
Option Option::showDefault() { return Option(option_->capture_default_str()); }

Option Command::option(const std::string& names, std::string& value, const std::string& description) {
  return Option(app_->add_option(names, value, description));
}
Option Command::option(const std::string& names, std::vector<std::string>& value, const std::string& description) {
  return Option(app_->add_option(names, value, description));
}
Option Command::option(const std::string& names, int& value, const std::string& description) {
  return Option(app_->add_option(names, value, description));
}
Option Command::option(const std::string& names, unsigned& value, const std::string& description) {
  return Option(app_->add_option(names, value, description));
}
Option Command::option(const std::string& names, std::optional<uint64_t>& value, const std::string& description) {
  return Option(app_->add_option(names, value, description));
}
Option Command::option(const std::string& names, double& value, const std::string& description) {
  return Option(app_->add_option(names, value, description));
}
Option Command::flag(const std::string& names, bool& value, const std::string& description) {
  return Option(app_->add_flag(names, value, description));
}

void Command::onParsed(std::function<int()> then) {
  app_->parse_complete_callback([app = app_, then = std::move(then)] {
    if (!app->remaining().empty()) return; // unknown words are reported first
    if (const int status = then(); status != 0) throw CLI::RuntimeError(status);
  });
}
void Command::onRun(std::function<void()> run) { app_->callback(std::move(run)); }
bool Command::given(const std::string& option) const { return app_->count(option) > 0; }

void Command::textFlag(const std::string& name, const std::string& description, std::function<std::string()> text) {
  const auto print = [text = std::move(text)] {
    std::cout << text();
    throw CLI::Success();
  };
  app_->add_flag_callback(name, print, description);
}

namespace {

constexpr std::string_view kStatusHead = "Exit status: ";

std::string statusFooter(const std::string& text) { return std::string(kStatusHead) + text + "."; }

} // namespace

void Command::exitStatus(const std::string& text) { app_->footer(statusFooter(text)); }
std::string Command::exitStatus() const { return app_->get_footer().substr(kStatusHead.size()); }

const std::string& Command::name() const { return app_->get_name(); }
std::string Command::description() const { return app_->get_description(); }
std::string Command::help() const {
  return app_->help(app_->get_parent() == nullptr ? "" : app_->get_parent()->get_name());
}

std::vector<OptionText> Command::options() const {
  std::vector<OptionText> texts;
  for (const bool positional : {false, true})
    for (const CLI::Option* option : std::as_const(*app_).get_options())
      if (option->get_positional() == positional && !option->get_group().empty()) texts.push_back(textOf(*option));
  return texts;
}

namespace {

// Opens closed standard files: otherwise the next file to be opened would get their number, and output would go there.
void openStandardFiles() {
  for (int file = open("/dev/null", O_RDWR); file >= 0; file = open("/dev/null", O_RDWR))
    if (file > STDERR_FILENO) {
      close(file);
      return;
    }
}

} // namespace

CommandLine::CommandLine(ProgramText text)
    : text_(std::move(text)), app_(std::make_unique<CLI::App>(text_.description, text_.name)) {
  openStandardFiles();
  app_->set_version_flag("--version", version());
  app_->footer(statusFooter(text_.exitStatus));
}
CommandLine::~CommandLine() = default;

Command CommandLine::add(const std::string& name, const std::string& description) {
  app_->require_subcommand(1);
  return Command(app_->add_subcommand(name, description));
}
std::string CommandLine::version() const { return text_.name + " " + text::version(); }
Command CommandLine::root() const { return Command(app_.get()); }

std::vector<Command> CommandLine::commands() const {
  std::vector<Command> commands;
  for (CLI::App* app : app_->get_subcommands([](CLI::App*) { return true; })) commands.emplace_back(app);
  return commands;
}

void CommandLine::takeRest(Command command, std::vector<std::string>& words) { rests_[command.name()] = &words; }

namespace {

// The index of `--` among the words; their number if there is none.
int dashesIn(int argc, char** argv) {
  for (int i = 1; i < argc; ++i)
    if (std::string_view(argv[i]) == "--") return i;
  return argc;
}

} // namespace

std::optional<int> CommandLine::run(int argc, char** argv, const std::function<int(const WrongWords&)>& wrong) {
  const auto rest = argc > 1 ? rests_.find(argv[1]) : rests_.end();
  const int words = rest == rests_.end() ? argc : dashesIn(argc, argv);
  if (words < argc) rest->second->assign(argv + words + 1, argv + argc);
  std::optional<int> decided;
  try {
    decided = parse(words, argv, wrong);
  } catch (const std::system_error&) { // from fmt::print
    if (std::ferror(stdout) == 0 && std::ferror(stderr) == 0) throw;
  }
  if (std::ferror(stderr) != 0) return kEnvironment; // the reason cannot be reported
  std::cout.flush();
  std::fflush(stdout);
  if (std::cout && std::ferror(stdout) == 0) return decided;
  std::cerr << text_.name << ": cannot write to standard output\n";
  return kEnvironment;
}

std::optional<int> CommandLine::parse(int argc, char** argv, const std::function<int(const WrongWords&)>& wrong) {
  try {
    app_->parse(argc, argv);
    return std::nullopt;
  } catch (const CLI::RuntimeError& error) {
    return error.get_exit_code(); // the cause has been printed
  } catch (const CLI::Success& asked) {
    return app_->exit(asked); // --help, --version
  } catch (const CLI::ParseError& error) {
    return wrong(wrongWords(*app_, error));
  }
}

} // namespace rung::cli

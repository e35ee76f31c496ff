// See manual.h; groff_man(7) has the macros.
#include "machine/command-line/manual.h"

#include <fmt/format.h>
#include <string_view>
#include <vector>

#include "rtlib/text/letters.h"

namespace rung::cli {
namespace {

// Escapes characters that roff would set as an accent, a quotation mark or a hyphen, so that they can be copied into a
// terminal.
std::string escaped(std::string_view text) {
  std::string roff;
  for (const char c : text) {
    switch (c) {
    case '\\': roff += "\\e"; break;
    case '-': roff += "\\-"; break;
    case '\'': roff += "\\(aq"; break;
    case '`': roff += "\\(ga"; break;
    case '^': roff += "\\(ha"; break;
    case '~': roff += "\\(ti"; break;
    default: roff += c;
    }
  }
  return roff;
}

// A line of text, which roff does not take for a macro.
std::string line(std::string_view text) { return (text.starts_with('.') ? "\\&" : "") + escaped(text) + "\n"; }

std::string bold(std::string_view text) { return "\\fB" + escaped(text) + "\\fR"; }
std::string italic(std::string_view text) { return "\\fI" + escaped(text) + "\\fR"; }

std::string valueOf(const OptionText& option) {
  return option.choices.empty() ? italic(option.word) : escaped(fmt::format("{}", fmt::join(option.choices, "|")));
}

std::string headOf(const OptionText& option) {
  if (option.names.empty()) return italic(option.word);
  std::string head;
  for (const std::string& name : option.names) head += (head.empty() ? "" : ", ") + bold(name);
  return option.word.empty() ? head : head + " " + valueOf(option);
}

std::string synopsisOf(const std::string& words, const std::vector<OptionText>& options) {
  std::string text = bold(words) + " [" + italic("OPTION") + "...]";
  for (const OptionText& option : options) {
    if (!option.names.empty()) continue;
    std::string word = italic(option.word) + (option.repeated ? "..." : "");
    text += option.required ? " " + word : " [" + word + "]";
  }
  return text;
}

std::string pageName(const CommandLine& app, Command command) {
  return command == app.root() ? app.text().name : app.text().name + "-" + command.name();
}

std::string commandList(const CommandLine& app) {
  std::string text = ".SH COMMANDS\n";
  for (const Command& command : app.commands())
    text += ".TP\n" + bold(command.name()) + "\n" + line(command.description());
  return text;
}

// "rung.toml(5)" is .BR rung.toml (5).
std::string reference(std::string_view page) {
  const size_t bracket = page.find('(');
  return ".BR " + escaped(page.substr(0, bracket)) + " " + std::string(page.substr(bracket));
}

std::string optionList(const std::vector<OptionText>& options) {
  std::string text = ".SH OPTIONS\n";
  for (const OptionText& option : options) text += ".TP\n" + headOf(option) + "\n" + line(option.description);
  return text;
}

} // namespace

std::string manualPage(const CommandLine& app, Command command) {
  const bool whole = command == app.root();
  const std::vector<OptionText> options = command.options();
  const std::string name = pageName(app, command);
  // No date: the same command line results in the same page.
  std::string text = fmt::format(".TH \"{}\" 1 \"\" \"{}\" \"Rung\"\n", escaped(text::upper(name)), app.version());
  text += ".SH NAME\n" + escaped(name) + " \\- " + escaped(command.description()) + "\n";
  const bool chooses = whole && !app.commands().empty();
  text += ".SH SYNOPSIS\n" +
          (chooses ? bold(app.text().name) + " " + italic("COMMAND") + " [" + italic("ARGUMENT") + "...]"
                   : synopsisOf(whole ? name : app.text().name + " " + command.name(), options)) +
          "\n";
  if (chooses) text += commandList(app);
  text += optionList(options);
  text += ".SH EXIT STATUS\n" + line(command.exitStatus());
  text += ".SH SEE ALSO\n";
  if (!whole) return text + reference(app.text().name + "(1)") + "\n";
  std::vector<std::string> others;
  for (const Command& other : app.commands()) others.push_back(reference(pageName(app, other) + "(1)"));
  for (const std::string& page : app.text().seeAlso) others.push_back(reference(page));
  return text + fmt::format("{}\n", fmt::join(others, ",\n"));
}

} // namespace rung::cli

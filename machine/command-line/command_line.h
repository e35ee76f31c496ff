// The command line of a program: its commands and options, and the parsing of the words that a user has typed. Only
// command_line.cpp includes CLI11, which does the parsing, because CLI11 takes long to compile.
#pragma once
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
} // namespace CLI

namespace rung::cli {

enum ExitStatus { kOk = 0, kWrong = 1, kUsage = 2, kEnvironment = 3 };

// Handle of an option or of a positional argument of a command; copies refer to the same one. Each setter returns the
// option, so that calls can be chained.
class Option {
public:
  explicit Option(CLI::Option* option) : option_(option) {}
  Option required();
  Option oneOf(std::vector<std::string> choices);
  Option between(int least, int most);
  Option between(unsigned least, unsigned most);
  Option between(uint64_t least, uint64_t most);
  Option between(double least, double most);
  Option excludes(Option other);
  Option needs(Option other);
  Option oneValue();   // list: one value each time; the next word is another argument
  Option manyValues(); // list: takes all words up to the next option
  Option showDefault();

private:
  CLI::Option* option_;
};

struct OptionText {
  std::vector<std::string> names;   // "-q", "--quiet"; empty for a positional argument
  std::string word;                 // name of the value, "TEXT"; "" for a flag
  std::vector<std::string> choices; // the permitted values; empty: any
  std::string description;          // one line
  bool repeated = false;            // can have several values
  bool required = false;
};

// Handle of a command, or of the program itself, as part of a CommandLine.
class Command {
public:
  explicit Command(CLI::App* app) : app_(app) {}
  bool operator==(const Command&) const = default;

  // Adds an option. `value` must live until the command has run. `names` is "-o,--output", or "FILE" for a positional
  // argument.
  Option option(const std::string& names, std::string& value, const std::string& description);
  Option option(const std::string& names, std::vector<std::string>& value, const std::string& description);
  Option option(const std::string& names, int& value, const std::string& description);
  Option option(const std::string& names, unsigned& value, const std::string& description);
  Option option(const std::string& names, std::optional<uint64_t>& value, const std::string& description);
  Option option(const std::string& names, double& value, const std::string& description);
  Option flag(const std::string& names, bool& value, const std::string& description);
  // Calls `then` after the words of the command have been parsed without unknown ones; a result other than 0 ends the
  // program with that exit status.
  void onParsed(std::function<int()> then);
  void onRun(std::function<void()> run);
  bool given(const std::string& option) const;
  // Adds a flag that prints this text and does nothing else.
  void textFlag(const std::string& name, const std::string& description, std::function<std::string()> text);

  // Sets the text "0 …, 1 …" of a command whose exit statuses differ from those of the program.
  void exitStatus(const std::string& text);

  const std::string& name() const;
  std::string description() const;
  std::string exitStatus() const;
  std::string help() const; // the output of --help
  // Visible options, then positional arguments, each in the order in which they were added.
  std::vector<OptionText> options() const;

private:
  CLI::App* app_;
};

// The words of a wrong command line: unknown to the command, or missing.
struct WrongWords {
  std::optional<Command> command; // the command that was named
  std::vector<std::string> unread;
  std::string text; // CLI11's message
};

// A program's description in help and manual pages; --version prints its name and the version of Rung.
struct ProgramText {
  std::string name; // "rungc"
  std::string description;
  std::string exitStatus;           // "0 ok, 1 …"
  std::string guide;                // the page that shows the commands in use
  std::vector<std::string> seeAlso; // manual pages, "rung.toml(5)"
};

class CommandLine {
public:
  explicit CommandLine(ProgramText text);
  ~CommandLine();

  // Adds a command. A program with commands requires one of them; a program without commands has only the options of
  // its root.
  Command add(const std::string& name, const std::string& description);
  Command root() const;
  const ProgramText& text() const { return text_; }
  std::string version() const;           // "rungc 0.1"
  std::vector<Command> commands() const; // in the order of the help text

  // Puts the words after `--` into `words`, which must live until the command has run.
  void takeRest(Command command, std::vector<std::string>& words);

  // Runs the named command. Returns the exit status if the command line itself decides it (--help, a wrong project), or
  // the result of `wrong`, which is called for wrong words. Returns nothing if the command has run and its output has
  // been written; a failed write is reported here and returns kEnvironment.
  std::optional<int> run(int argc, char** argv, const std::function<int(const WrongWords&)>& wrong);

private:
  std::optional<int> parse(int argc, char** argv, const std::function<int(const WrongWords&)>& wrong);

  ProgramText text_;
  std::unique_ptr<CLI::App> app_;
  std::map<std::string, std::vector<std::string>*> rests_; // by command
};

} // namespace rung::cli

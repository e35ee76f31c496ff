// The command line of a program: commands with their options, and what becomes of the words that a user has typed.
// CLI11 does it, which command_line.cpp alone includes, as compiling it takes long.
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

// An option or a word of a command, as a handle: a copy is the same one. Each call gives the option back.
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
  Option oneValue();   // of a list: one value each time, what follows is another word
  Option manyValues(); // of a list: all that follows
  Option showDefault();

private:
  CLI::Option* option_;
};

struct OptionText {
  std::vector<std::string> names;   // "-q", "--quiet"; of a word that is not an option, none
  std::string word;                 // what follows it, "TEXT"; "" of a flag
  std::vector<std::string> choices; // the only values that it takes; empty: any
  std::string description;          // one line
  bool repeated = false;            // more than one value
  bool required = false;
};

// A command, or the program itself, as a handle to a part of a CommandLine.
class Command {
public:
  explicit Command(CLI::App* app) : app_(app) {}
  bool operator==(const Command&) const = default;

  // The value lives until the command has run. `names` is "-o,--output", or "FILE" for a word.
  Option option(const std::string& names, std::string& value, const std::string& description);
  Option option(const std::string& names, std::vector<std::string>& value, const std::string& description);
  Option option(const std::string& names, int& value, const std::string& description);
  Option option(const std::string& names, unsigned& value, const std::string& description);
  Option option(const std::string& names, std::optional<uint64_t>& value, const std::string& description);
  Option option(const std::string& names, double& value, const std::string& description);
  Option flag(const std::string& names, bool& value, const std::string& description);
  // When the words of the command are read and each is known; a status other than 0 ends the program.
  void onParsed(std::function<int()> then);
  void onRun(std::function<void()> run);
  bool given(const std::string& option) const;
  // A flag that prints this text in the place of all else.
  void textFlag(const std::string& name, const std::string& description, std::function<std::string()> text);

  // Of a command whose statuses mean something else than those of the program: "0 …, 1 …".
  void exitStatus(const std::string& text);

  const std::string& name() const;
  std::string description() const;
  std::string exitStatus() const;
  std::string help() const; // what --help prints
  // Options that may be seen, then words, each in the order in which they were added.
  std::vector<OptionText> options() const;

private:
  CLI::App* app_;
};

// Words that no command takes, or that are missing.
struct WrongWords {
  std::optional<Command> command; // that was named
  std::vector<std::string> unread;
  std::string text; // what CLI11 says
};

// What a program says of itself; --version prints its name and the version of Rung.
struct ProgramText {
  std::string name; // "rungc"
  std::string description;
  std::string exitStatus;           // "0 ok, 1 …"
  std::string guide;                // the file that shows the commands at work
  std::vector<std::string> seeAlso; // manual pages, "rung.toml(5)"
};

class CommandLine {
public:
  explicit CommandLine(ProgramText text);
  ~CommandLine();

  // With a command one is needed; a program without any has the options of its root.
  Command add(const std::string& name, const std::string& description);
  Command root() const;
  const ProgramText& text() const { return text_; }
  std::string version() const;           // "rungc 0.1"
  std::vector<Command> commands() const; // in the order in which they are listed

  // What follows a -- among the words of the command goes into `words`, which lives until it has run.
  void takeRest(Command command, std::vector<std::string>& words);

  // Runs the command that is named. The exit status where the command line itself decides it: --help, a wrong project;
  // `wrong` is called for wrong words and gives it. Nothing where the command has run, and all that it has printed has
  // been written: else that is said here, and the status is kEnvironment.
  std::optional<int> run(int argc, char** argv, const std::function<int(const WrongWords&)>& wrong);

private:
  std::optional<int> parse(int argc, char** argv, const std::function<int(const WrongWords&)>& wrong);

  ProgramText text_;
  std::unique_ptr<CLI::App> app_;
  std::map<std::string, std::vector<std::string>*> rests_; // by command
};

} // namespace rung::cli

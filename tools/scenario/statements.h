// The table of statements, and the parser of one line, used by the reader of files.
#pragma once
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "tools/scenario/scenario.h"

namespace rung::scenario {

class LineParser;
class Session;

// How a statement is written and what it does, for help and completion.
struct StatementForm {
  std::string_view word;
  std::string_view form;
  std::string_view meaning;
};

// The phase in which a statement takes effect.
enum class Stage : uint8_t {
  Run,      // while the program runs
  Include,  // before all others: the statements of the file replace it
  Compile,  // decides what is compiled, or whether it has to compile
  Warnings, // after the program has been compiled
  Start,    // before the first scan
};

// What the words after the first one name; a singular applies to the first of them, a plural to all.
enum class Words : uint8_t {
  Other,
  Value, // of the program or the NC, in Statement::name
  Values,
  Service,
  File,
  Files,
  PlcCommand,
  BlockCommand,
  Statement, // a statement, for help at the prompt
};

// What a statement advances.
enum class Advance : uint8_t {
  Nothing,
  Scans, // Statement::count whole scans
  Parts, // Statement::count parts of a scan
  Time,  // whole scans for Statement::microseconds
};

// How the session uses the program that a statement names.
enum class OtherProgram : uint8_t { None, TakesOver, Beside };

// A row of statements.def: what parser, runner, profiler, prompt, completion and recording know about a statement.
struct StatementInfo {
  Kind kind = Kind::Scan;
  StatementForm form;
  Stage stage = Stage::Run;
  Words words = Words::Other;
  Advance advances = Advance::Nothing;
  OtherProgram program = OtherProgram::None;
  bool sets = false;    // writes a value that the next scan reads
  bool expects = false; // fails if something else has happened
  bool (LineParser::*parse)() = nullptr;
  std::string (Session::*run)(const Statement&) = nullptr; // for Stage::Run; returns "" or what is wrong

  static const StatementInfo& of(Kind kind);
  static const StatementInfo& of(const Statement& statement) { return of(statement.kind); }
  static std::span<const StatementInfo> all(); // in the order of the help

  bool atPrompt() const { return stage == Stage::Run || stage == Stage::Include; }
  // Whether it determines the program and its start; a misspelt statement may do so, too.
  bool shapesStart() const { return stage == Stage::Include || stage == Stage::Compile || stage == Stage::Start; }
  // Whether a failure is explained by the rungs that write Statement::name.
  bool expectsValue() const { return expects && words == Words::Value; }

private:
  static const StatementInfo kRows[];
};

// Null if there is no such statement.
const StatementInfo* findStatement(std::string_view word);

struct ParsedLine {
  std::optional<Statement> statement; // nothing for an empty line, or if there is a problem
  std::string problem;
  bool shapesStart = false; // it determines, or may be meant to, how the program is compiled and started
};

ParsedLine parseLine(std::string_view line);

// Whether a name in `expect NAME VALUE` may have been meant as a message; then kMessageNote is added to the problem.
bool isMessageWord(std::string_view name);
inline constexpr std::string_view kMessageNote = "; for a message write: expect_message NUMBER [on|off]";

} // namespace rung::scenario

// The table of statements, and one line of a scenario, between the words and the files.
#pragma once
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "tools/scenario/scenario.h"

namespace rung::scenario {

class LineParser;
class Session;

// How a statement is written, and what it does: for help and completion.
struct StatementForm {
  std::string_view word;
  std::string_view form;
  std::string_view meaning;
};

// When a statement does what it says.
enum class Stage : uint8_t {
  Run,      // while the program runs
  Include,  // before all others: the statements of a file take its place
  Compile,  // it decides what is compiled, or whether it has to compile
  Warnings, // when the program has been compiled
  Start,    // before the first scan
};

// What the words after the first one name; the first of them where there is one, else all.
enum class Words : uint8_t {
  Other,
  Value, // of the program or the NC, in Statement::name
  Values,
  Service,
  File,
  Files,
  PlcCommand,
  BlockCommand,
  Statement, // of help at the prompt
};

// What a statement runs.
enum class Advance : uint8_t {
  Nothing,
  Scans, // whole ones, Statement::count
  Parts, // of a scan, Statement::count
  Time,  // whole scans for Statement::microseconds
};

// What becomes of the program that a statement names.
enum class OtherProgram : uint8_t { None, TakesOver, Beside };

// What parser, runner, profiler, prompt, completion and recording know of a statement: a row of statements.def.
struct StatementInfo {
  Kind kind = Kind::Scan;
  StatementForm form;
  Stage stage = Stage::Run;
  Words words = Words::Other;
  Advance advances = Advance::Nothing;
  OtherProgram program = OtherProgram::None;
  bool sets = false;    // it writes a value that the next scan reads
  bool expects = false; // it fails where something else has happened
  bool (LineParser::*parse)() = nullptr;
  std::string (Session::*run)(const Statement&) = nullptr; // at Stage::Run; gives "" or what is wrong

  static const StatementInfo& of(Kind kind);
  static const StatementInfo& of(const Statement& statement) { return of(statement.kind); }
  static std::span<const StatementInfo> all(); // in the order of help

  bool atPrompt() const { return stage == Stage::Run || stage == Stage::Include; }
  // A misspelt one may be one without which nothing is known of the program and its start.
  bool shapesStart() const { return stage == Stage::Include || stage == Stage::Compile || stage == Stage::Start; }
  // A failure is explained by the rungs that write Statement::name.
  bool expectsValue() const { return expects && words == Words::Value; }

private:
  static const StatementInfo kRows[];
};

// Null: there is none.
const StatementInfo* findStatement(std::string_view word);

struct ParsedLine {
  std::optional<Statement> statement; // nothing in an empty line, or when there is a problem
  std::string problem;
  bool shapesStart = false; // it decides, or may be meant to decide, how the program is compiled and started
};

ParsedLine parseLine(std::string_view line);

// Whether a name in `expect NAME VALUE` may be meant for a message; then the note is added to what is wrong.
bool isMessageWord(std::string_view name);
inline constexpr std::string_view kMessageNote = "; for a message write: expect_message NUMBER [on|off]";

} // namespace rung::scenario

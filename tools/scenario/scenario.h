// Scenario files as data: one statement per line, as docs/scenario-format.md describes them. The parser knows the form
// of each statement; names and keys are resolved by the dialect when the scenario runs.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "ir/support/result.h"
#include "rtlib/change/state_transfer.h"
#include "rtlib/text/number.h"

namespace rung::scenario {

// Statements by their names in statements.def. Scenario::statements never contains Include, but the statements of the
// included file.
enum class Kind : uint8_t {
#define RUNG_STATEMENT(kind, ...) kind,
#include "tools/scenario/statements.def"
#undef RUNG_STATEMENT
};

enum class ValueKind : uint8_t { Int, Real, Text };

// A value as written, and its meaning.
struct Value {
  ValueKind kind = ValueKind::Int;
  bool isBit = false;         // written as on, off, true or false: the integer 1 or 0
  text::WrittenNumber number; // TooLong: kind is Int; OutOfRange or None: a text without quotes
  int64_t integer = 0;        // its 64 bits: above 2^63-1 modulo 2^64; undefined for TooLong
  double real = 0;            // also filled for integers
  std::string text;           // content of a quoted string, otherwise as written
};

struct KeyValue {
  std::string key;
  Value value;
};

struct Statement {
  Kind kind = Kind::Scan;
  std::string file;  // path of the scenario or of the included file
  uint32_t line = 0; // from 1
  std::string text;  // the line without surrounding blanks
  std::string name;  // Include: the file; Set, Expect…: the name; Config: the key; Event, ExpectCall, Prepare…: the
                     // service or event; ExpectSent: the port; Plc, Block: the command
  std::vector<std::string> words; // Program, Replace, Shadow: files; Connect: source and destination; Unforce: names;
                                  // Within: the operands of the action, which is the name
  Value value;                    // Set, Force, Expect, ExpectRange (low); Config; ExpectLog, ExpectFault: the text
  Value high;                     // ExpectRange
  bool near = false;              // expect NAME ~ VALUE TOLERANCE
  double tolerance = 0;
  uint64_t count = 1;            // Scan, Fast, Slot
  int64_t microseconds = 0;      // Run, Period
  uint32_t number = 0;           // ExpectMessage: the number; ExpectError, ExpectWarning: the line, 0 for any;
                                 // Within: the turn
  bool on = true;                // ExpectMessage
  std::vector<KeyValue> keys;    // Print: names as keys, texts as values without a key
  std::vector<KeyValue> results; // Prepare: the results after ->
  runtime::StateChange change;   // ExpectChange
};

struct Problem {
  std::string file; // path of the scenario or of the included file
  uint32_t line = 0;
  std::string message;
};

inline Problem problemAt(const Statement& statement, std::string message) {
  return {statement.file, statement.line, std::move(message)};
}
// FILE:LINE: MESSAGE
std::string textOf(const Problem& problem);

struct Scenario {
  std::string path;               // of the file, for messages
  std::vector<std::string> files; // this file and those that it includes, existing or not
  std::vector<Statement> statements;
  std::vector<Problem> problems; // a scenario with problems must not be run
  // A line that cannot be parsed may be one that determines the program and its start.
  bool startUnknown = false;
  std::string project;                   // name of the project that it belongs to (in_project.h); empty: none
  std::vector<std::string> includePaths; // of the project
};

Scenario parse(std::string path, std::string_view text);
// "" or, if the name is that of another kind of file, what to do instead.
std::string notAScenario(const std::string& path);
// Fails if the file cannot be read or is a program.
Result<Scenario> readScenario(const std::string& path);
// Reads a file of statements that need not begin with a program, for a session that already runs.
Result<Scenario> readStatements(const std::string& path);
// Parses one line without a file. The error begins in lower case and has no line number.
Result<Statement> parseStatement(std::string_view line);

// Whether the statement compares real numbers.
bool wantsReal(const Statement& statement);
// Whether it passes whatever the program does, unless the program stops with a fault.
bool expectsNothing(const Scenario& scenario);

// 250ms, 2s, 1.5 min, 500us in microseconds; the error says what to write.
Result<int64_t> parseDuration(std::string_view text);

} // namespace rung::scenario

// Scenario files as data: one statement a line, as docs/scenario-format.md describes them. The parser knows the shape
// of each statement; what a name or a key means is the dialect's business and is decided when the scenario runs.
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

// Statements by their names in statements.def. Include is never in Scenario::statements: the statements of the file
// are.
enum class Kind : uint8_t {
#define RUNG_STATEMENT(kind, ...) kind,
#include "tools/scenario/statements.def"
#undef RUNG_STATEMENT
};

enum class ValueKind : uint8_t { Int, Real, Text };

// A value as written.
struct Value {
  ValueKind kind = ValueKind::Int;
  bool isBit = false;         // written as on, off, true or false: the integer 1 or 0
  text::WrittenNumber number; // TooLong: an Int; OutOfRange or None: a text without quotes
  int64_t integer = 0;        // its 64 bits: above 2^63-1 modulo 2^64; of a TooLong one nothing
  double real = 0;            // also filled for integers
  std::string text;           // of a quoted string, else as written
};

struct KeyValue {
  std::string key;
  Value value;
};

struct Statement {
  Kind kind = Kind::Scan;
  std::string file;  // that has it: of the scenario, or included
  uint32_t line = 0; // from 1
  std::string text;  // as written, without blanks around it
  std::string name;  // Include: the file; Set, Expect…: the name; Config: the key; Event, ExpectCall, Prepare…: the
                     // service or event; ExpectSent: the port; Plc, Block: the command
  std::vector<std::string> words; // Program, Replace, Shadow: files; Connect: source and destination; Unforce: names
  Value value;                    // Set, Force, Expect, ExpectRange (low); Config; ExpectLog, ExpectFault: the text
  Value high;                     // ExpectRange
  bool near = false;              // expect NAME ~ VALUE TOLERANCE
  double tolerance = 0;
  uint64_t count = 1;            // Scan, Fast, Slot
  int64_t microseconds = 0;      // Run, Period
  uint32_t number = 0;           // ExpectMessage: the number; ExpectError, ExpectWarning: the line, 0 for any
  bool on = true;                // ExpectMessage
  std::vector<KeyValue> keys;    // Print: names as keys, texts as values without a key
  std::vector<KeyValue> results; // Prepare: after ->
  runtime::StateChange change;   // ExpectChange
};

struct Problem {
  std::string file; // of the scenario, or included
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
  std::vector<std::string> files; // this one and those that are included, there or not
  std::vector<Statement> statements;
  std::vector<Problem> problems; // a scenario with problems must not run
  // A line that cannot be read may be one without which nothing is known of the program and its start.
  bool startUnknown = false;
  std::string project;                   // that it belongs to, by its name (in_project.h); empty: none
  std::vector<std::string> includePaths; // of the project
};

Scenario parse(std::string path, std::string_view text);
// "" or, when this is the name of another kind of file, what to do instead.
std::string notAScenario(const std::string& path);
// Fails when the file cannot be read or is a program.
Result<Scenario> readScenario(const std::string& path);
// A file of statements that need not begin with a program: for a session that runs already.
Result<Scenario> readStatements(const std::string& path);
// One line without a file. The text of a failure begins in small letters and names no line.
Result<Statement> parseStatement(std::string_view line);

// The statement compares real numbers.
bool wantsReal(const Statement& statement);
// It expects nothing: it passes whatever the program does, unless that stops with a fault.
bool expectsNothing(const Scenario& scenario);

// 250ms, 2s, 1.5 min, 500us in microseconds; the text of a failure says what to write.
Result<int64_t> parseDuration(std::string_view text);

} // namespace rung::scenario

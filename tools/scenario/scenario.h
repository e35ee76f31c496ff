// Scenario files as data: one statement a line, as docs/scenario-format.md describes them. The parser knows the shape
// of each statement; what a name or a key means is the dialect's business and is decided when the scenario runs.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace rung::scenario {

enum class Kind : uint8_t {
  Program,
  Dialect,
  Config,
  Connect,
  Period,
  Set,
  Scan,
  Fast,
  Slot,
  Run,
  Expect,
  ExpectRange,
  ExpectMessage,
  ExpectLog,
  ExpectCall,
  ExpectNoCall,
  Reply,
  Prepare,
  BlockStart,
  BlockDone,
  Event,
  Plc,
  ColdStart,
  WarmStart,
  ExpectError,
  ExpectWarning,
  ExpectFault,
};

enum class ValueKind : uint8_t { Int, Real, Text };

// A value as written. An integer keeps 64 bits; one above 2^63-1 is kept modulo 2^64.
struct Value {
  ValueKind kind = ValueKind::Int;
  int64_t integer = 0;
  double real = 0;  // also filled for integers
  std::string text; // of a quoted string, else as written
};

struct KeyValue {
  std::string key;
  Value value;
};

struct Statement {
  Kind kind = Kind::Scan;
  uint32_t line = 0; // from 1
  std::string name;  // Set, Expect…: the name; Config: the key; Event, ExpectCall, Prepare…: the service or event; Plc:
                     // the command
  std::vector<std::string> words; // Program: files; Connect: source and destination
  Value value;                    // Set, Expect, ExpectRange (low); Config; ExpectLog, ExpectFault: the text
  Value high;                     // ExpectRange
  bool near = false;              // expect NAME ~ VALUE TOLERANCE
  double tolerance = 0;
  uint64_t count = 1;       // Scan, Fast, Slot
  int64_t microseconds = 0; // Run, Period
  uint32_t number = 0;      // ExpectMessage: the number; ExpectError, ExpectWarning: the line, 0 for any
  bool on = true;           // ExpectMessage
  std::vector<KeyValue> keys;
  std::vector<KeyValue> results; // Prepare: behind ->
};

struct Problem {
  uint32_t line = 0;
  std::string message;
};

struct Scenario {
  std::string path; // of the file, for messages and for the programs' folder
  std::vector<Statement> statements;
  std::vector<Problem> problems; // a scenario with problems must not run
};

Scenario parse(std::string path, std::string_view text);

// 250ms, 2s, 500us, 1.5s in microseconds; nothing for anything else.
std::optional<int64_t> parseDuration(std::string_view text);

} // namespace rung::scenario

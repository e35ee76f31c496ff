// What runs of a program have shown of it, rung by rung: plain data that is counted in, merged, written and read.
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ir/support/result.h"

namespace rung::report {

// A contact, or the result of a box or an instruction: what a coil is decided by.
struct Condition {
  std::string text; // as written
  uint32_t line = 0;
  uint32_t column = 0;
  bool contact = true;
  bool open = false;   // seen so
  bool closed = false; // seen so: it conducts
};

// A coil, or an input of a box or an instruction.
struct Output {
  std::string text;
  uint32_t line = 0;
  uint32_t column = 0;
  bool coil = true;
  bool off = false; // seen without power
  bool on = false;  // seen with power
};

// Situations in which a condition alone decided: had it been the other way, the outcome would have been, too.
enum Alone : uint8_t { kOpenOff = 1, kOpenOn = 2, kClosedOff = 4, kClosedOn = 8 };

struct Deciding {
  uint32_t condition = 0; // in Rung::conditions
  uint8_t alone = 0;      // of enum Alone
  // The outcome was seen both ways, by this condition alone (masking MC/DC).
  bool bothWays() const {
    return (alone & (kOpenOff | kClosedOn)) == (kOpenOff | kClosedOn) ||
           (alone & (kOpenOn | kClosedOff)) == (kOpenOn | kClosedOff);
  }
};

// What a value of the rung decides, and what decides it.
struct Decision {
  std::vector<uint32_t> outputs; // in Rung::outputs; they all get this power
  std::vector<Deciding> by;
};

struct Rung {
  uint32_t number = 0; // as drawn, from 1
  std::string routine;
  std::string title;
  std::string file;
  uint32_t line = 0;
  uint64_t runs = 0;
  std::vector<Condition> conditions;
  std::vector<Output> outputs;
  std::vector<Decision> decisions;
};

struct Program {
  std::vector<std::string> files; // in the order in which they are compiled
  std::vector<Rung> rungs;        // by number
};

struct CoverageReport {
  std::vector<Program> programs;
};

// So many of so many.
struct Share {
  uint64_t seen = 0;
  uint64_t all = 0;
  double percent() const { return all == 0 ? 100 : 100.0 * static_cast<double>(seen) / static_cast<double>(all); }
  Share& operator+=(const Share& other);
};

struct Totals {
  Share rungs;         // run
  Share contacts;      // open and closed
  Share coils;         // on and off
  Share decided;       // conditions of a decision that decided it alone both ways
  uint64_t oneWay = 0; // conditions that decided in one direction only
  Totals& operator+=(const Totals& other);
};

Totals totalsOf(std::span<const Rung> rungs);
Totals totalsOf(const CoverageReport& report);

// Adds what another report has seen. Rungs are the same when they have the same number, place, contacts and coils,
// programs when they have the same files and the same rungs.
void merge(CoverageReport& report, const CoverageReport& other);
// The same for a report of former runs: of a program that was changed since, only the rungs that stayed are added.
void mergeFormer(CoverageReport& report, const CoverageReport& former);

// The form is described in docs/coverage-format.md.
std::string toJson(const CoverageReport& report);
Result<CoverageReport> fromJson(std::string_view text);

struct CoverageTextOptions {
  uint32_t missing = 40; // lines of what is missing; 0: all
};
std::string toText(const CoverageReport& report, const CoverageTextOptions& options);

// "66.6 %", rounded down: 100 means all.
std::string percentText(const Share& share);

// Where a rung or a part of it has something missing, in words: "never open". Empty where nothing is.
std::string missingOf(const Condition& condition);
std::string missingOf(const Output& output);
std::string missingOf(const Deciding& deciding, std::string_view outcome); // "(PUMP)": what it was to decide

} // namespace rung::report

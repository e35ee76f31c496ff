// Coverage of a program by runs, rung by rung, as plain data to be merged, written and read.
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ir/support/result.h"

namespace rung::report {

// A contact, or the result of a box or an instruction: what decides about a coil.
struct Condition {
  std::string text; // as in the source
  uint32_t line = 0;
  uint32_t column = 0;
  bool contact = true;
  bool open = false;   // seen open
  bool closed = false; // seen closed: it conducts
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

// Situations in which a condition alone decided: with its other value the outcome would have been the other one, too.
enum Alone : uint8_t { kOpenOff = 1, kOpenOn = 2, kClosedOff = 4, kClosedOn = 8 };

struct Deciding {
  uint32_t condition = 0; // index in Rung::conditions
  uint8_t alone = 0;      // bits of enum Alone
  // Both outcomes were seen, decided by this condition alone (masking MC/DC).
  bool bothWays() const {
    return (alone & (kOpenOff | kClosedOn)) == (kOpenOff | kClosedOn) ||
           (alone & (kOpenOn | kClosedOff)) == (kOpenOn | kClosedOff);
  }
};

// A value of the rung with the outputs that it decides and the conditions that decide it.
struct Decision {
  std::vector<uint32_t> outputs; // indices in Rung::outputs; all of them get this power
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
  std::vector<std::string> files; // in the order of compilation
  std::vector<Rung> rungs;        // by number
};

struct CoverageReport {
  std::vector<Program> programs;
};

// A count and its total.
struct Share {
  uint64_t seen = 0;
  uint64_t all = 0;
  double percent() const { return all == 0 ? 100 : 100.0 * static_cast<double>(seen) / static_cast<double>(all); }
  Share& operator+=(const Share& other);
};

struct Totals {
  Share rungs;         // rungs that ran
  Share contacts;      // contacts seen open and closed
  Share coils;         // coils seen off and on
  Share decided;       // conditions of a decision that alone decided both outcomes
  uint64_t oneWay = 0; // conditions that alone decided one outcome only
  Totals& operator+=(const Totals& other);
};

Totals totalsOf(std::span<const Rung> rungs);
Totals totalsOf(const CoverageReport& report);

// Adds the coverage of another report. Rungs are the same if they have the same number, place, contacts and coils,
// programs if they have the same files and the same rungs.
void merge(CoverageReport& report, const CoverageReport& other);
// The same for a report of former runs: if the program has changed since, only unchanged rungs are added.
void mergeFormer(CoverageReport& report, const CoverageReport& former);

// The format is described in docs/coverage-format.md.
std::string toJson(const CoverageReport& report);
Result<CoverageReport> fromJson(std::string_view text);

struct CoverageTextOptions {
  uint32_t missing = 40; // most lines about missing coverage; 0: all
};
std::string toText(const CoverageReport& report, const CoverageTextOptions& options);

// "66.6 %", rounded down: 100 means all.
std::string percentText(const Share& share);

// What is missing of a rung or a part of it, in words: "never open"; "" if nothing is.
std::string missingOf(const Condition& condition);
std::string missingOf(const Output& output);
std::string missingOf(const Deciding& deciding, std::string_view outcome); // `outcome`: "(PUMP)"

} // namespace rung::report

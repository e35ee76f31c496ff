// Names of a scenario in a running program: what they hold, and what was meant by one that does not exist.
#pragma once
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ir/support/result.h"
#include "tools/scenario/values.h"

namespace rung::scenario {

// A variable, a cell or a quantity of the NC. `wantReal`: two words or eight bytes are read as one double.
Result<Reading> readName(const runtime::Instance& instance, const sim::SimulatedNc& nc, std::string_view name,
                         bool wantReal);

// A name that is read after every scan: it is looked up once in each program.
class NamedValue {
public:
  // The name can be read (readName); a quantity of the NC that does not exist yet reads 0 until it does.
  NamedValue(std::string name, const runtime::Instance& instance, const sim::SimulatedNc& nc);

  const std::string& name() const { return name_; }
  const std::optional<runtime::Ref>& place() const { return place_; } // else a cell or quantity of the NC
  // Another program has taken over.
  void locate(const runtime::Instance& instance, const sim::SimulatedNc& nc);
  // Nothing: the program that runs now does not have the name.
  std::optional<Reading> read(const runtime::Instance& instance, const sim::SimulatedNc& nc) const;

private:
  std::string name_;
  std::optional<runtime::Ref> place_;
};

// What a user may write for a value: the symbols of the program, then the signals of its control.
std::vector<std::string> namesOf(const rung_program& program, const sim::SimulatedNc& nc);
// The message about a name that does not exist, with the one that may be meant.
std::string unknownName(const rung_program& program, const sim::SimulatedNc& nc, std::string_view name);

// Names that do not exist, of all statements that read or write a value, but for quantities of the NC. The program has
// been started; `next` are those that take over from it, one for each replace statement.
std::vector<Problem> unknownNames(const Scenario& scenario, const rung_program& program,
                                  std::span<const rung_program* const> next, const sim::SimulatedNc& nc);
// Values that a name of the program cannot hold, of set statements before another program takes over.
std::vector<Problem> unfitValues(const Scenario& scenario, const runtime::Instance& instance,
                                 const sim::SimulatedNc& nc);

// "30.000 ms, scan 3: VALVE = 1, a text": a print statement.
Result<std::string> printedLine(const Statement& print, const runtime::Instance& instance, const sim::SimulatedNc& nc,
                                uint64_t scans);

} // namespace rung::scenario

// Names of a scenario in a running program: their values, and suggestions for a name that does not exist.
#pragma once
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ir/support/result.h"
#include "tools/scenario/values.h"

namespace rung::scenario {

// Reads a variable, a cell or a quantity of the NC. `wantReal`: two words or eight bytes are read as one double.
Result<Reading> readName(const runtime::Instance& instance, const sim::SimulatedNc& nc, std::string_view name,
                         bool wantReal);

// A name that is read after every scan; it is looked up once per program.
class NamedValue {
public:
  // The name must be readable (readName); a quantity of the NC that does not exist yet reads 0 until it does.
  NamedValue(std::string name, const runtime::Instance& instance, const sim::SimulatedNc& nc);

  const std::string& name() const { return name_; }
  const std::optional<runtime::Ref>& place() const { return place_; } // nothing: a cell or quantity of the NC
  // Looks the name up again after another program has taken over.
  void locate(const runtime::Instance& instance, const sim::SimulatedNc& nc);
  // Nothing if the running program does not have the name.
  std::optional<Reading> read(const runtime::Instance& instance, const sim::SimulatedNc& nc) const;

private:
  std::string name_;
  std::optional<runtime::Ref> place_;
};

// Names that a user may write for a value: the symbols of the program, then the signals of its control.
std::vector<std::string> namesOf(const rung_program& program, const sim::SimulatedNc& nc);
// The message about a name that does not exist, with the most similar one.
std::string unknownName(const rung_program& program, const sim::SimulatedNc& nc, std::string_view name);

// Names that do not exist, in all statements that read or write a value, except quantities of the NC. The program has
// been started; `next` are its replacements, one for each replace statement.
std::vector<Problem> unknownNames(const Scenario& scenario, const rung_program& program,
                                  std::span<const rung_program* const> next, const sim::SimulatedNc& nc);
// Values of set statements that the program's name cannot hold, up to the first replacement of the program.
std::vector<Problem> unfitValues(const Scenario& scenario, const runtime::Instance& instance,
                                 const sim::SimulatedNc& nc);

// The output of a print statement: "30.000 ms, scan 3: VALVE = 1, a text".
Result<std::string> printedLine(const Statement& print, const runtime::Instance& instance, const sim::SimulatedNc& nc,
                                uint64_t scans);

} // namespace rung::scenario

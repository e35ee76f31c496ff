// Cells that a scenario or a user forces to values, in all engines of a session (rung_forces).
#pragma once
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "tools/scenario/engine_run.h"
#include "tools/scenario/values.h"

namespace rung::scenario {

class Forces {
public:
  using EngineRuns = std::vector<std::unique_ptr<EngineRun>>;
  using Values = std::map<std::string, Value>; // by name

  // Adds a force or changes its value. "" or what is wrong; then nothing has changed.
  std::string set(const EngineRuns& runs, const std::string& name, const Value& value);
  // Releases the cells of these names, by whatever names they were forced; without names, all.
  std::string clear(const EngineRuns& runs, const std::vector<std::string>& names);
  // Has these forces and no others, as `values` returned them. The program must run.
  std::string restore(const EngineRuns& runs, const Values& values);
  // The active forces.
  const Values& values(const EngineRuns& runs);

private:
  // The force of the cell that has this name; `end()` if there is none.
  static Values::const_iterator find(const EngineRuns& runs, const Values& values, const std::string& name);
  std::string put(const EngineRuns& runs, Values values);

  Values values_;
  std::vector<rung::Forces> inRuns_; // active forces, by run
};

} // namespace rung::scenario

// Cells that a scenario or a person holds at values, in all engines of a session (rung_forces).
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

  // One more, or another value. "" or what is wrong, and nothing has happened.
  std::string set(const EngineRuns& runs, const std::string& name, const Value& value);
  // These no longer; no names: none at all.
  std::string clear(const EngineRuns& runs, const std::vector<std::string>& names);
  // Those in effect.
  const Values& values(const EngineRuns& runs);

private:
  std::string put(const EngineRuns& runs, Values values);

  Values values_;
  std::vector<rung::Forces> inRuns_; // in effect, by run
};

} // namespace rung::scenario

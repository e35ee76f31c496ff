// Cells that a scenario or a person holds at values, in all engines of a session (rung_forces).
#pragma once
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "tools/scenario/lane.h"
#include "tools/scenario/values.h"

namespace rung::scenario {

class Forces {
public:
  using Lanes = std::vector<std::unique_ptr<Lane>>;
  using Values = std::map<std::string, Value>; // by name

  // One more, or another value. "" or what is wrong, and nothing has happened.
  std::string set(const Lanes& lanes, const std::string& name, const Value& value);
  // These no longer; no names: none at all.
  std::string clear(const Lanes& lanes, const std::vector<std::string>& names);
  // Those in effect.
  const Values& values(const Lanes& lanes);

private:
  std::string put(const Lanes& lanes, Values values);

  Values values_;
  std::vector<rung::Forces> inLanes_; // in effect, by lane
};

} // namespace rung::scenario

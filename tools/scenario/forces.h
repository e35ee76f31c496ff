// Cells that a scenario or a person holds at values, in all engines of a session (host::Forcing).
#pragma once
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "tools/compiler/recompiler.h"
#include "tools/scenario/lane.h"
#include "tools/scenario/values.h"

namespace rung::scenario {

// What the running program was compiled from; a failure says why that is not known.
using GetCompiled = std::function<Result<const compiler::Compiled*>()>;

class Forces {
public:
  using Lanes = std::vector<std::unique_ptr<Lane>>;
  using Values = std::map<std::string, Value>; // by name

  // One more, or another value. "" or what is wrong, and nothing has happened.
  std::string set(const Lanes& lanes, const GetCompiled& compiled, const std::string& name, const Value& value);
  // These no longer; no names: none at all.
  std::string clear(const Lanes& lanes, const GetCompiled& compiled, const std::vector<std::string>& names);
  // Those in effect.
  const Values& values(const Lanes& lanes);

private:
  // Of one lane; in effect.
  struct InLane {
    std::unique_ptr<host::Forcing> forcing;
    std::unique_ptr<compiler::ForcedCode> code; // null: the program's own
  };
  static Result<InLane> prepare(Lane& lane, const GetCompiled& compiled, const Values& values);
  std::string put(const Lanes& lanes, const GetCompiled& compiled, Values values);

  Values values_;
  std::vector<InLane> inLanes_; // by lane
};

} // namespace rung::scenario

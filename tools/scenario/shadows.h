// A program that runs beside that of a session, in all its engines, on what that one reads and is answered
// (rung_shadow): what it would do otherwise.
#pragma once
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "tools/scenario/engine_run.h"

namespace rung::scenario {

class Shadows {
public:
  using EngineRuns = std::vector<std::unique_ptr<EngineRun>>;

  // From now on, in the place of one that runs. `engines`: by run; they outlive it. "" or why it cannot.
  std::string begin(const EngineRuns& runs, const std::vector<runtime::Engine*>& engines);
  void end() { inRuns_.clear(); }

  // After every scan: the shadow does what that has recorded.
  void work();

  // Takes a difference of this name that was seen and not taken before. "" or what is wrong.
  std::string expectDifference(const EngineRuns& runs, const std::string& name);
  // "" or the differences that were not taken, and what has ended the shadow before its time.
  std::string expectNone(const EngineRuns& runs);
  // What the first engine's shadow has shown since the last call: differences seen for the first time, its end.
  std::vector<std::string> news();

private:
  struct InRun {
    rung::Image image;
    rung::Shadow shadow;
  };
  // Of all runs the same; the first that is not: `problem`.
  template <class Look>
  std::string inAll(const EngineRuns& runs, Look look);

  std::vector<InRun> inRuns_;
  std::set<std::string> taken_;
  std::set<std::string> shown_; // by `news`
};

} // namespace rung::scenario

// A shadow: a program that runs beside that of a session, in all its engines, with the same inputs and answers
// (rung_shadow), and how its outputs differ.
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

  // Starts a shadow, in place of an earlier one. `engines`: by run; they must outlive it. "" or why it cannot start.
  std::string begin(const EngineRuns& runs, const std::vector<runtime::Engine*>& engines);
  void end() { inRuns_.clear(); }

  // Called after every scan: lets the shadow repeat the recorded scan.
  void work();

  // Takes a difference of this name that was not taken before. "" or what is wrong.
  std::string expectDifference(const EngineRuns& runs, const std::string& name);
  // "" or the differences that were not taken, and what ended the shadow early.
  std::string expectNone(const EngineRuns& runs);
  // News of the first engine's shadow since the last call: differences seen for the first time, its end.
  std::vector<std::string> news();

private:
  struct InRun {
    rung::Image image;
    rung::Shadow shadow;
  };
  // Calls `look` for every shadow, with its untaken differences; returns the first problem.
  template <class Look>
  std::string inAll(const EngineRuns& runs, Look look);

  std::vector<InRun> inRuns_;
  std::set<std::string> taken_;
  std::set<std::string> shown_; // differences that `news` has reported
};

} // namespace rung::scenario

// A program that runs beside that of a session, in all its engines, on what that one reads and is answered
// (rung_shadow): what it would do otherwise.
#pragma once
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "tools/scenario/lane.h"

namespace rung::scenario {

class Shadows {
public:
  using Lanes = std::vector<std::unique_ptr<Lane>>;

  // From now on, in the place of one that runs. `engines`: by lane; they outlive it. "" or why it cannot.
  std::string begin(const Lanes& lanes, const std::vector<runtime::Engine*>& engines);
  void end() { inLanes_.clear(); }

  // After every scan: the shadow does what that has recorded.
  void work();

  // Takes a difference of this name that was seen and not taken before. "" or what is wrong.
  std::string expectDifference(const Lanes& lanes, const std::string& name);
  // "" or the differences that were not taken, and what has ended the shadow before its time.
  std::string expectNone(const Lanes& lanes);
  // What the first engine's shadow has shown since the last call: differences seen for the first time, its end.
  std::vector<std::string> news();

private:
  struct InLane {
    rung::Image image;
    rung::Shadow shadow;
  };
  // Of all lanes the same; the first that is not: `problem`.
  template <class Look>
  std::string inAll(const Lanes& lanes, Look look);

  std::vector<InLane> inLanes_;
  std::set<std::string> taken_;
  std::set<std::string> shown_; // by `news`
};

} // namespace rung::scenario

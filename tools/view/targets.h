// Where jumps and calls lead: the rungs that begin a subprogram or carry a label, and those that ask for it.
#pragma once
#include <map>
#include <string_view>
#include <utility>
#include <vector>

#include "frontend/sema/analysis.h"

namespace rung::view {

class Targets {
public:
  struct Target {
    uint32_t rung = 0; // its number; 0: no rung is known
    std::vector<uint32_t> callers;
  };

  uint32_t idOf(const frontend::TargetUse& use);
  void define(uint32_t id, uint32_t rung) { targets_[id].rung = rung; }
  void ask(uint32_t id, uint32_t rung);
  const Target& at(uint32_t id) const { return targets_[id]; }

private:
  std::map<std::pair<std::string_view, uint32_t>, uint32_t> ids_; // by scope and number
  std::vector<Target> targets_;
};

} // namespace rung::view

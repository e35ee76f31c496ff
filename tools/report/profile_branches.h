// Counts how often the branches of rungs are taken while the interpreter runs them, and keeps the counts in a file, by
// which a compiler lays out code (`rungc build --profile-use`).
#pragma once
#include <string>

#include "ir/analysis/branch_weights.h"
#include "ir/interp/interp.h"
#include "ir/support/result.h"

namespace rung::report {

// Of one program that one thread runs. Of a loop the last pass counts.
class BranchCounter final : public ir::RungObserver {
public:
  // A module that no pass has changed, which may go; what is counted is added to `counts`, which outlive it.
  BranchCounter(const ir::Module& module, ir::BranchCounts& counts);

  void rungRan(uint32_t number, std::span<const uint64_t> values) override;

private:
  struct If {
    uint32_t condition = 0; // value of the rung
    uint32_t outer = 0;     // the if around it, by its position in the rung's; itself: none
    bool inElse = false;    // of the outer one
  };
  struct Plan {
    std::vector<If> ifs;
    std::vector<ir::Branch>* counts = nullptr;
  };
  static std::vector<If> ifsOf(const ir::Rung& rung);

  std::vector<Plan> plans_; // by number over all routines
  std::vector<uint8_t> reached_;
};

std::string branchesJson(const ir::BranchCounts& counts);
// Of a file. Fails with its name and what is wrong.
Result<ir::BranchCounts> branchesIn(const std::string& path);

} // namespace rung::report

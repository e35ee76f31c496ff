// Counts how often the branches of rungs are taken while the interpreter runs them, and stores the counts in a file
// from which a compiler lays out code (`rungc build --profile-use`).
#pragma once
#include <string>

#include "ir/analysis/branch_weights.h"
#include "ir/interp/interp.h"
#include "ir/support/result.h"

namespace rung::report {

// Observes one program that one thread runs. In a loop, the last iteration counts.
class BranchCounter final : public ir::RungObserver {
public:
  // `module`: not changed by any pass, not kept. The counts are added to `counts`, which must outlive the counter.
  BranchCounter(const ir::Module& module, ir::BranchCounts& counts);

  void rungRan(uint32_t number, std::span<const uint64_t> values) override;

private:
  struct If {
    uint32_t condition = 0; // a value of the rung
    uint32_t outer = 0;     // index among the rung's ifs of the enclosing one; its own index: none
    bool inElse = false;    // whether it is in the else branch of the outer one
  };
  struct Plan {
    std::vector<If> ifs;
    std::vector<ir::Branch>* counts = nullptr;
  };
  static std::vector<If> ifsOf(const ir::Rung& rung);

  std::vector<Plan> plans_; // by rung number over all routines
  std::vector<uint8_t> reached_;
};

std::string branchesJson(const ir::BranchCounts& counts);
// The counts in a file. The error has the file's name and what is wrong.
Result<ir::BranchCounts> branchesIn(const std::string& path);

} // namespace rung::report

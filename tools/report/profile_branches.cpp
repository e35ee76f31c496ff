// Counts of branches, and their file (see profile_branches.h).
#include "tools/report/profile_branches.h"

#include <fmt/format.h>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "ir/core/ops.h"
#include "rtlib/text/number.h"
#include "rtlib/text/regular_file.h"

namespace rung::report {
namespace {

constexpr std::string_view kFormat = "rung branches";
constexpr int kVersion = 1;

} // namespace

// ---- counting ----------------------------------------------------------------------------------------------------

std::vector<BranchCounter::If> BranchCounter::ifsOf(const ir::Rung& rung) {
  struct Region {
    uint32_t number = 0; // number of its if
    bool inElse = false;
  };
  std::vector<If> ifs;
  std::vector<Region> open;
  for (const ir::Op& op : rung.ops) {
    if (op.code == ir::OpCode::If) {
      const auto number = static_cast<uint32_t>(ifs.size());
      const Region around = open.empty() ? Region{number, false} : open.back();
      ifs.push_back({ir::arg(rung, op, 0).index, around.number, around.inElse});
      open.push_back({number, false});
    } else if (op.code == ir::OpCode::Else) {
      open.back().inElse = true;
    } else if (op.code == ir::OpCode::EndIf) {
      open.pop_back();
    }
  }
  return ifs;
}

// Rungs with the same key have the same text in several places, and are counted together.
BranchCounter::BranchCounter(const ir::Module& module, ir::BranchCounts& counts) {
  for (const ir::Routine& routine : module.routines)
    for (const ir::Rung& rung : routine.rungs) {
      Plan& plan = plans_.emplace_back(Plan{ifsOf(rung)});
      if (plan.ifs.empty() || rung.key == 0) continue;
      std::vector<ir::Branch>& known = counts[rung.key];
      if (known.empty()) known.resize(plan.ifs.size());
      if (known.size() == plan.ifs.size()) plan.counts = &known;
    }
}

void BranchCounter::rungRan(uint32_t number, std::span<const uint64_t> values) {
  const Plan& plan = plans_[number];
  if (plan.counts == nullptr || values.empty()) return;
  reached_.assign(plan.ifs.size(), 1);
  for (size_t i = 0; i < plan.ifs.size(); ++i) {
    const If& own = plan.ifs[i];
    if (own.outer != i) {
      const bool isTaken = values[plan.ifs[own.outer].condition] != 0;
      reached_[i] = reached_[own.outer] != 0 && isTaken != own.inElse ? 1 : 0;
    }
    if (reached_[i] == 0) continue;
    ir::Branch& branch = (*plan.counts)[i];
    ++branch.reached;
    if (values[own.condition] != 0) ++branch.taken;
  }
}

// ---- file --------------------------------------------------------------------------------------------------------

std::string branchesJson(const ir::BranchCounts& counts) {
  nlohmann::json rungs = nlohmann::json::array();
  for (const auto& [key, branches] : counts) {
    nlohmann::json ifs = nlohmann::json::array();
    for (const ir::Branch& branch : branches) ifs.push_back({branch.reached, branch.taken});
    rungs.push_back({{"key", fmt::format("{:016x}", key)}, {"ifs", std::move(ifs)}});
  }
  return nlohmann::json{{"format", kFormat}, {"version", kVersion}, {"rungs", std::move(rungs)}}.dump(1) + "\n";
}

namespace {

ir::Branch branchOf(const nlohmann::json& pair) {
  const ir::Branch branch{pair.at(0).get<uint64_t>(), pair.at(1).get<uint64_t>()};
  if (branch.taken > branch.reached) throw std::runtime_error("a branch was taken more often than it was reached");
  return branch;
}

ir::BranchCounts countsOf(const nlohmann::json& file) {
  if (file.value("format", "") != kFormat) throw std::runtime_error("it was not written by rungc profile -o");
  if (file.value("version", 0) != kVersion)
    throw std::runtime_error("it was written by another version of rungc; write it again with rungc profile -o");
  ir::BranchCounts counts;
  for (const nlohmann::json& rung : file.at("rungs")) {
    const auto key = text::numberIn<uint64_t>(rung.at("key").get<std::string>(), 16);
    if (!key) throw std::runtime_error("the key of a rung is not a hexadecimal number");
    for (const nlohmann::json& pair : rung.at("ifs")) counts[*key].push_back(branchOf(pair));
  }
  return counts;
}

} // namespace

Result<ir::BranchCounts> branchesIn(const std::string& path) {
  std::string contents;
  const std::string problem = text::readRegular(path, text::kMostSource, contents);
  if (!problem.empty()) return failure(fmt::format("cannot read '{}': {}", path, problem));
  try {
    return countsOf(nlohmann::json::parse(contents));
  } catch (const std::exception& error) {
    return failure(fmt::format("{}: {}", path, error.what()));
  }
}

} // namespace rung::report

// What has become of the state when a program took the place of another, in words.
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "rtlib/change/state_transfer.h"
#include "rung/runtime.hpp"

namespace rung::scenario {

// Before the key of what the compiler made, where a name would mean a cell.
inline constexpr std::string_view kStateWord = "state";

std::optional<runtime::ChangeKind> changeKindFromName(std::string_view name);
// "moved COUNT", "renamed LAMP BEACON", "new state MAIN/TMR": as expect_change names it.
std::string textOf(const runtime::StateChange& change);

struct ReplaceReport {
  ReplaceReport() = default;
  explicit ReplaceReport(const rung::Replacement& replacement);

  uint32_t keptCells = 0;
  uint32_t keptStates = 0;
  std::string bound;                         // rung_replacement_info::bound
  std::vector<runtime::StateChange> changes; // those that nobody has taken out

  // Takes it out; "" or what is there instead.
  std::string take(const runtime::StateChange& change);
  // "" or what there is.
  std::string expectNone() const;
  // What was kept, a line for each change, and how long a slice of it may last.
  std::vector<std::string> lines() const;
};

} // namespace rung::scenario

// The table of a language: its rows in one list, and rules for all of them.
#pragma once
#include <algorithm>

#include "frontend/network/lower/lowered_row.h"
#include "frontend/table/rows.h"

namespace rung::frontend::network::rows {

constexpr auto kNumberOf = [](const LoweredRow& row) { return row.info.number; };

// In the order of their numbers, after the basic instructions, which have none.
template <size_t... kCounts>
constexpr auto tableOf(const LoweredRow (&... groups)[kCounts]) {
  const auto joined = frontend::joinRows(groups...);
  auto rows = joined;
  std::ranges::transform(frontend::orderOf(joined, kNumberOf), rows.begin(), [&](uint16_t i) { return joined[i]; });
  for (LoweredRow& row : rows) row.built = row.lower != nullptr;
  return rows;
}

template <const auto& kRows>
consteval bool tableIsComplete() {
  constexpr auto kIsFunction = [](const LoweredRow& row) { return row.info.number >= 0; };
  static_assert(frontend::rowsAreComplete<kRows>());
  static_assert(frontend::everyRow(kRows,
                                   [=](const LoweredRow& row) {
                                     return !kIsFunction(row) || row.lower == nullptr || !row.info.example.empty();
                                   }),
                "every function that is built has an example");
  static_assert(frontend::everyRow(kRows,
                                   [=](const LoweredRow& row) {
                                     return !kIsFunction(row) ||
                                            std::ranges::count(kRows, row.info.number, kNumberOf) == 1;
                                   }),
                "no two functions have one number");
  static_assert(frontend::everyRow(kRows,
                                   [](const LoweredRow& row) {
                                     return row.info.pins.size() > 0 ||
                                            row.info.placement != frontend::Placement::AfterContact;
                                   }),
                "every row without a pin says that it needs no contact before it");
  return true;
}

} // namespace rung::frontend::network::rows

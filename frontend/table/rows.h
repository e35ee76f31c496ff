// Tables of rows, joined, sorted and checked at compile time. Each rule is a static_assert with a descriptive text; if
// a row violates it, Clang's note "in call to 'keeps(...)'" names the row.
#pragma once
#include <algorithm>
#include <array>
#include <utility>

#include "frontend/table/instruction.h"

namespace rung::frontend {

// The rows of all chapters.
template <class Row, size_t... kCounts>
constexpr std::array<Row, (kCounts + ...)> joinRows(const Row (&... chapters)[kCounts]) {
  std::array<Row, (kCounts + ...)> rows{};
  auto end = rows.begin();
  ((end = std::ranges::copy(chapters, end).out), ...);
  return rows;
}

// The indices of the rows, sorted by `keyOf` of a row; rows with the same key keep their order.
template <class Row, size_t kCount, class KeyOf>
constexpr std::array<uint16_t, kCount> orderOf(const std::array<Row, kCount>& rows, KeyOf keyOf) {
  std::array<uint16_t, kCount> order{};
  for (size_t i = 0; i < kCount; ++i) order[i] = static_cast<uint16_t>(i);
  std::ranges::sort(order, {}, [&](uint16_t i) { return std::pair(keyOf(rows[i]), i); });
  return order;
}

constexpr auto kMnemonicOf = [](const auto& row) { return row.info.mnemonic; };

// For each row, the result of `pointTo`.
template <class T, class Row, size_t kCount, class PointTo>
constexpr std::array<const T*, kCount> pointers(const std::array<Row, kCount>& rows, PointTo pointTo) {
  std::array<const T*, kCount> result{};
  std::ranges::transform(rows, result.begin(), pointTo);
  return result;
}
template <class Row, size_t kCount>
constexpr std::array<const InstructionInfo*, kCount> infosOf(const std::array<Row, kCount>& rows) {
  return pointers<InstructionInfo>(rows, [](const Row& row) { return &row.info; });
}

void aRowBreaksTheRule(); // a call is not a constant expression

consteval bool keeps([[maybe_unused]] std::string_view mnemonic, bool rule) {
  if (!rule) aRowBreaksTheRule();
  return rule;
}

template <class Rows, class Rule>
consteval bool everyRow(const Rows& rows, Rule rule) {
  for (const auto& row : rows)
    if (!keeps(row.info.mnemonic, rule(row))) return false;
  return true;
}

template <class Rows>
consteval bool everyRowHas(const Rows& rows, std::string_view InstructionInfo::* text) {
  return everyRow(rows, [text](const auto& row) { return !(row.info.*text).empty(); });
}

// `order` is that of the mnemonics.
template <class Rows, class Order>
consteval bool mnemonicsDiffer(const Rows& rows, const Order& order) {
  for (size_t i = 1; i < order.size(); ++i)
    if (!keeps(kMnemonicOf(rows[order[i]]), kMnemonicOf(rows[order[i - 1]]) != kMnemonicOf(rows[order[i]])))
      return false;
  return true;
}

// Rules for the rows of every dialect.
template <const auto& kRows>
consteval bool rowsAreComplete() {
  static_assert(everyRowHas(kRows, &InstructionInfo::mnemonic), "every row has a mnemonic");
  static_assert(everyRowHas(kRows, &InstructionInfo::title), "every row has a title");
  static_assert(everyRowHas(kRows, &InstructionInfo::group), "every row has a group");
  static_assert(everyRowHas(kRows, &InstructionInfo::ref), "every row says where the manual describes it");
  static_assert(everyRowHas(kRows, &InstructionInfo::doc), "every row says what it does");
  static_assert(mnemonicsDiffer(kRows, orderOf(kRows, kMnemonicOf)), "no two rows have one mnemonic");
  return true;
}

} // namespace rung::frontend

// The table (see instructions.h): the rows of all groups in one list, and ways to find one.
#include "frontend/dialects/fanuc/rows/instructions.h"

#include <algorithm>

#include "frontend/dialects/fanuc/language.h"
#include "frontend/dialects/fanuc/rows/rows_arithmetic.h"
#include "frontend/dialects/fanuc/rows/rows_basic.h"
#include "frontend/dialects/fanuc/rows/rows_bcd.h"
#include "frontend/dialects/fanuc/rows/rows_control.h"
#include "frontend/dialects/fanuc/rows/rows_data.h"
#include "frontend/dialects/fanuc/rows/rows_nc.h"
#include "frontend/dialects/fanuc/rows/rows_timing.h"
#include "frontend/dialects/fanuc/rows/rows_unbuilt.h"
#include "frontend/table/rows.h"

namespace rung::frontend::fanuc {
namespace {

using frontend::InstructionInfo;

constexpr auto numberOf = [](const Row& row) { return row.info.number; };

// In the order of their numbers, after the basic instructions, which have none.
constexpr auto kRows = [] {
  const auto groups = frontend::joinRows(kBasicRows, kTimingRows, kDataRows, kArithmeticRows, kBcdRows, kControlRows,
                                         kNcRows, kUnbuiltRows);
  auto rows = groups;
  std::ranges::transform(frontend::orderOf(groups, numberOf), rows.begin(), [&](uint16_t i) { return groups[i]; });
  for (Row& row : rows) row.built = row.lower != nullptr;
  return rows;
}();
constexpr auto kNetworkRows = frontend::pointers<network::Row>(kRows, [](const Row& row) { return &row; });
constexpr auto kInfos = frontend::infosOf(kRows);

constexpr bool isFunction(const Row& row) { return row.info.number >= 0; }

static_assert(frontend::rowsAreComplete<kRows>());
static_assert(frontend::everyRow(kRows,
                                 [](const Row& row) {
                                   return !isFunction(row) || row.lower == nullptr || !row.info.example.empty();
                                 }),
              "every function that is built has an example");
static_assert(frontend::everyRow(kRows,
                                 [](const Row& row) {
                                   return !isFunction(row) || std::ranges::count(kRows, row.info.number, numberOf) == 1;
                                 }),
              "no two functions have one number");

} // namespace

std::span<const Row> allRows() { return kRows; }

const InstructionInfo* findBox(std::string_view mnemonic) {
  const network::Row* row = languageOf(Pmc::MemB).findFunction(mnemonic);
  return row == nullptr ? nullptr : &row->info;
}

std::span<const network::Row* const> networkRows() { return kNetworkRows; }
std::span<const InstructionInfo* const> instructionInfos() { return kInfos; }

} // namespace rung::frontend::fanuc

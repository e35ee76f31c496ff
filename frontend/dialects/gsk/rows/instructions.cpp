// The instruction table (see instructions.h): the rows of all chapters in one list, and look-up functions.
#include "frontend/dialects/gsk/rows/instructions.h"

#include <algorithm>

#include "frontend/dialects/gsk/language.h"
#include "frontend/dialects/gsk/rows/rows_arithmetic.h"
#include "frontend/dialects/gsk/rows/rows_basic.h"
#include "frontend/dialects/gsk/rows/rows_control.h"
#include "frontend/dialects/gsk/rows/rows_data.h"
#include "frontend/dialects/gsk/rows/rows_nc.h"
#include "frontend/dialects/gsk/rows/rows_timing.h"
#include "frontend/table/rows.h"

namespace rung::frontend::gsk {
namespace {

using frontend::InstructionInfo;

constexpr auto numberOf = [](const Row& row) { return row.info.number; };

// Rows sorted by number; the basic instructions, which have no numbers, come first.
constexpr auto kRows = [] {
  const auto chapters = frontend::joinRows(kBasicRows, kTimingRows, kDataRows, kArithmeticRows, kControlRows, kNcRows);
  auto rows = chapters;
  std::ranges::transform(frontend::orderOf(chapters, numberOf), rows.begin(), [&](uint16_t i) { return chapters[i]; });
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
static_assert(frontend::everyRow(kRows,
                                 [](const Row& row) {
                                   return row.info.pins.size() > 0 || row.info.placement != Placement::AfterContact;
                                 }),
              "every row without a pin says that it needs no contact before it");

} // namespace

std::span<const Row> allRows() { return kRows; }

const InstructionInfo* findBox(std::string_view mnemonic) {
  const network::Row* row = kLanguage.findFunction(mnemonic);
  return row == nullptr ? nullptr : &row->info;
}

std::span<const network::Row* const> networkRows() { return kNetworkRows; }
std::span<const InstructionInfo* const> instructionInfos() { return kInfos; }

} // namespace rung::frontend::gsk

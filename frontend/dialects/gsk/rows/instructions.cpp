// The table (see instructions.h): the rows of all chapters in one list, and ways to find one.
#include "frontend/dialects/gsk/rows/instructions.h"

#include <array>

#include "frontend/dialects/gsk/language.h"
#include "frontend/dialects/gsk/rows/rows_arithmetic.h"
#include "frontend/dialects/gsk/rows/rows_basic.h"
#include "frontend/dialects/gsk/rows/rows_control.h"
#include "frontend/dialects/gsk/rows/rows_data.h"
#include "frontend/dialects/gsk/rows/rows_nc.h"
#include "frontend/dialects/gsk/rows/rows_timing.h"

namespace rung::gsk {
namespace {

using frontend::InstructionInfo;

constexpr size_t kRowCount = std::size(kBasicRows) + std::size(kTimingRows) + std::size(kDataRows) +
                             std::size(kArithmeticRows) + std::size(kControlRows) + std::size(kNcRows);

// In the order of their numbers, which holds over all chapters.
constexpr std::array<Row, kRowCount> joinRows() {
  std::array<Row, kRowCount> rows{};
  size_t n = 0;
  for (const std::span<const Row> chapter :
       {std::span<const Row>(kBasicRows), std::span<const Row>(kTimingRows), std::span<const Row>(kDataRows),
        std::span<const Row>(kArithmeticRows), std::span<const Row>(kControlRows), std::span<const Row>(kNcRows)})
    for (const Row& row : chapter) {
      rows[n] = row;
      rows[n++].built = row.lower != nullptr;
    }
  return rows;
}
constexpr std::array<Row, kRowCount> kRows = joinRows();

constexpr bool rowsAreComplete() {
  for (const Row& row : kRows) {
    if (row.info.mnemonic.empty() || row.info.title.empty() || row.info.doc.empty() || row.info.ref.empty())
      return false;
    if (row.info.number >= 0 && row.lower != nullptr && row.info.example.empty()) return false;
  }
  return true;
}
static_assert(rowsAreComplete(),
              "every row has mnemonic, title, doc and ref, a function that is built an example, too");

constexpr bool rowsAreInOrder() {
  int last = -1;
  for (const Row& row : kRows) {
    if (row.info.number < 0) continue; // a basic instruction
    if (row.info.number <= last) return false;
    last = row.info.number;
  }
  return true;
}
static_assert(rowsAreInOrder(), "functions are in the order of their numbers, from rows_timing.h to rows_nc.h");

// Of each row what `pointTo` gives.
template <class T, class PointTo>
constexpr std::array<const T*, kRowCount> pointers(PointTo pointTo) {
  std::array<const T*, kRowCount> result{};
  for (size_t i = 0; i < kRowCount; ++i) result[i] = pointTo(kRows[i]);
  return result;
}
constexpr auto kNetworkRows = pointers<network::Row>([](const Row& row) { return &row; });
constexpr auto kInfos = pointers<InstructionInfo>([](const Row& row) { return &row.info; });

} // namespace

std::span<const Row> allRows() { return kRows; }

const InstructionInfo* findBox(std::string_view mnemonic) {
  const network::Row* row = kLanguage.findFunction(mnemonic);
  return row == nullptr ? nullptr : &row->info;
}

std::span<const network::Row* const> networkRows() { return kNetworkRows; }
std::span<const InstructionInfo* const> instructionInfos() { return kInfos; }

} // namespace rung::gsk

// The table (see instructions.h): the rows of all chapters in one list, and ways to find one.
#include "frontend/dialects/gsk/rows/instructions.h"

#include <array>

#include "frontend/dialects/gsk/read/address.h"
#include "frontend/dialects/gsk/rows/rows_arithmetic.h"
#include "frontend/dialects/gsk/rows/rows_basic.h"
#include "frontend/dialects/gsk/rows/rows_control.h"
#include "frontend/dialects/gsk/rows/rows_data.h"
#include "frontend/dialects/gsk/rows/rows_nc.h"
#include "frontend/dialects/gsk/rows/rows_timing.h"
#include "rtlib/text/letters.h"

namespace rung::gsk {
namespace {

using frontend::InstructionInfo;

constexpr size_t kRowCount = std::size(kBasicRows) + std::size(kTimingRows) + std::size(kDataRows) +
                             std::size(kArithmeticRows) + std::size(kControlRows) + std::size(kNcRows);

// In the order of their numbers.
constexpr std::array<Row, kRowCount> joinRows() {
  std::array<Row, kRowCount> rows{};
  size_t n = 0;
  for (const Row& row : kBasicRows) rows[n++] = row;
  for (const Row& row : kTimingRows) rows[n++] = row;
  for (const Row& row : kDataRows) rows[n++] = row;
  for (const Row& row : kArithmeticRows) rows[n++] = row;
  for (const Row& row : kControlRows) rows[n++] = row;
  for (const Row& row : kNcRows) rows[n++] = row;
  return rows;
}
constexpr std::array<Row, kRowCount> kRows = joinRows();

constexpr bool rowsAreSound() {
  int last = -1;
  for (const Row& row : kRows) {
    if (row.info.mnemonic.empty() || row.info.title.empty() || row.info.doc.empty() || row.info.ref.empty())
      return false;
    if (row.info.number >= 0 && row.info.number <= last) return false; // functions in the order of their numbers
    if (row.info.number >= 0) last = row.info.number;
    if (row.info.number >= 0 && row.lower != nullptr && row.info.example.empty()) return false;
  }
  return true;
}
static_assert(rowsAreSound(), "a row lacks a text or is out of order");

constexpr std::array<const InstructionInfo*, kRowCount> infoPointers() {
  std::array<const InstructionInfo*, kRowCount> result{};
  for (size_t i = 0; i < kRowCount; ++i) result[i] = &kRows[i].info;
  return result;
}
constexpr std::array<const InstructionInfo*, kRowCount> kInfos = infoPointers();

constexpr size_t kFunctionNumbers = static_cast<size_t>(std::end(kNcRows)[-1].info.number) + 1; // the highest is last
constexpr std::array<const Row*, kFunctionNumbers> rowsByNumber() {
  std::array<const Row*, kFunctionNumbers> result{};
  for (const Row& row : kRows)
    if (row.info.number >= 0) result[static_cast<size_t>(row.info.number)] = &row;
  return result;
}
constexpr std::array<const Row*, kFunctionNumbers> kByNumber = rowsByNumber();

} // namespace

std::span<const Row> allRows() { return kRows; }

const Row* findFunction(uint64_t number) { return number < kFunctionNumbers ? kByNumber[number] : nullptr; }

const Row* findFunction(std::string_view mnemonic) {
  for (const Row& row : kRows)
    if (row.info.number >= 0 && text::equalsIgnoringCase(row.info.mnemonic, mnemonic)) return &row;
  return nullptr;
}

const InstructionInfo* findBox(std::string_view mnemonic) {
  const Row* row = findFunction(mnemonic);
  return row == nullptr ? nullptr : &row->info;
}

std::span<const InstructionInfo* const> instructionInfos() { return kInfos; }

} // namespace rung::gsk

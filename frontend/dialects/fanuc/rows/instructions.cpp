// The table (see instructions.h): the rows of all groups in one list, and ways to find one.
#include "frontend/dialects/fanuc/rows/instructions.h"

#include "frontend/dialects/fanuc/language.h"
#include "frontend/dialects/fanuc/rows/rows_arithmetic.h"
#include "frontend/dialects/fanuc/rows/rows_basic.h"
#include "frontend/dialects/fanuc/rows/rows_bcd.h"
#include "frontend/dialects/fanuc/rows/rows_control.h"
#include "frontend/dialects/fanuc/rows/rows_data.h"
#include "frontend/dialects/fanuc/rows/rows_nc.h"
#include "frontend/dialects/fanuc/rows/rows_timing.h"
#include "frontend/dialects/fanuc/rows/rows_unbuilt.h"
#include "frontend/network/rows/table.h"

namespace rung::frontend::fanuc {
namespace {

using frontend::InstructionInfo;

constexpr auto kRows = network::rows::tableOf(kBasicRows, kTimingRows, kDataRows, kArithmeticRows, kBcdRows,
                                              kControlRows, kNcRows, kUnbuiltRows);
constexpr auto kNetworkRows = frontend::pointers<network::Row>(kRows, [](const Row& row) { return &row; });
constexpr auto kInfos = frontend::infosOf(kRows);

static_assert(network::rows::tableIsComplete<kRows>());

} // namespace

std::span<const Row> allRows() { return kRows; }

const InstructionInfo* findBox(std::string_view mnemonic) {
  const network::Row* row = languageOf(Pmc::MemB).findFunction(mnemonic);
  return row == nullptr ? nullptr : &row->info;
}

std::span<const network::Row* const> networkRows() { return kNetworkRows; }
std::span<const InstructionInfo* const> instructionInfos() { return kInfos; }

} // namespace rung::frontend::fanuc

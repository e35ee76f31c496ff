// The instruction table (see instructions.h): the rows of all chapters in one list, and look-up functions.
#include "frontend/dialects/gsk/rows/instructions.h"

#include "frontend/dialects/gsk/language.h"
#include "frontend/dialects/gsk/rows/rows_arithmetic.h"
#include "frontend/dialects/gsk/rows/rows_basic.h"
#include "frontend/dialects/gsk/rows/rows_control.h"
#include "frontend/dialects/gsk/rows/rows_data.h"
#include "frontend/dialects/gsk/rows/rows_nc.h"
#include "frontend/dialects/gsk/rows/rows_timing.h"
#include "frontend/network/rows/table.h"

namespace rung::frontend::gsk {
namespace {

using frontend::InstructionInfo;

constexpr auto kRows =
    network::rows::tableOf(kBasicRows, kTimingRows, kDataRows, kArithmeticRows, kControlRows, kNcRows);
constexpr auto kNetworkRows = frontend::pointers<network::Row>(kRows, [](const Row& row) { return &row; });
constexpr auto kInfos = frontend::infosOf(kRows);

static_assert(network::rows::tableIsComplete<kRows>());

} // namespace

std::span<const Row> allRows() { return kRows; }

const InstructionInfo* findBox(std::string_view mnemonic) {
  const network::Row* row = kLanguage.findFunction(mnemonic);
  return row == nullptr ? nullptr : &row->info;
}

std::span<const network::Row* const> networkRows() { return kNetworkRows; }
std::span<const InstructionInfo* const> instructionInfos() { return kInfos; }

} // namespace rung::frontend::gsk

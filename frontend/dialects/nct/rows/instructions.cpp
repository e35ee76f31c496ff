// The instruction table (see instructions.h): the rows of all families in one list, and look-up functions.
#include "frontend/dialects/nct/rows/instructions.h"

#include <algorithm>

#include "frontend/dialects/nct/rows/foreign_words.h"
#include "frontend/dialects/nct/rows/rows_control.h"
#include "frontend/dialects/nct/rows/rows_message.h"
#include "frontend/dialects/nct/rows/rows_nc.h"
#include "frontend/table/rows.h"

namespace rung::frontend::nct {
namespace {

using frontend::InstructionInfo;

constexpr auto kRows = frontend::joinRows(kBitRows, kWordRows, kFloatRows, kMessageRows, kControlRows, kNcRows);
constexpr auto kInfos = frontend::infosOf(kRows);
constexpr auto kByMnemonic = frontend::orderOf(kRows, frontend::kMnemonicOf);

static_assert(frontend::rowsAreComplete<kRows>());
static_assert(frontend::everyRowHas(kRows, &InstructionInfo::example), "every row has an example");
static_assert(frontend::everyRow(kRows, [](const Row& row) { return row.info.pins.size() > 0; }),
              "every row has a place in a ladder");

constexpr size_t indexOf(std::string_view mnemonic) {
  return static_cast<size_t>(std::ranges::find(kRows, mnemonic, frontend::kMnemonicOf) - kRows.begin());
}

} // namespace

std::span<const Row> allRows() { return kRows; }
std::span<const InstructionInfo* const> instructionInfos() { return kInfos; }

const Row* findBox(std::string_view mnemonic) {
  const auto found =
      std::ranges::lower_bound(kByMnemonic, mnemonic, {}, [](uint16_t i) { return kRows[i].info.mnemonic; });
  if (found != kByMnemonic.end() && kRows[*found].info.mnemonic == mnemonic)
    return kRows[*found].shape == Shape::Box ? &kRows[*found] : nullptr;
  const auto alias =
      std::ranges::find_if(kRows, [&](const Row& row) { return isAlias(row.info, mnemonic, std::equal_to<>()); });
  return alias == std::end(kRows) ? nullptr : &*alias;
}

const InstructionInfo* findBoxInfo(std::string_view mnemonic) {
  const Row* row = findBox(mnemonic);
  return row == nullptr ? nullptr : &row->info;
}

const Row& contactRow(bool onBit, bool closed) {
  constexpr size_t kOpenBit = indexOf("open-contact-bit"), kClosedBit = indexOf("closed-contact-bit");
  constexpr size_t kOpenWord = indexOf("open-contact-dword"), kClosedWord = indexOf("closed-contact-dword");
  if (onBit) return kRows[closed ? kClosedBit : kOpenBit];
  return kRows[closed ? kClosedWord : kOpenWord];
}

std::string_view doublesOf(std::string_view mnemonic) {
  struct Pair {
    std::string_view integers;
    std::string_view doubles;
  };
  constexpr Pair kPairs[] = {{"ADD", "+F"},   {"ALR", "ALRF"}, {"CEQ", "FLEQ"}, {"CGE", "FLGE"}, {"CGT", "FLGT"},
                             {"CLE", "FLLE"}, {"CLT", "FLLT"}, {"CMP", "FCMP"}, {"CNE", "FLNE"}, {"DIV", "/F"},
                             {"MOV", "MOVF"}, {"MSG", "MSGF"}, {"MUL", "*F"},   {"REM", "REMF"}, {"SUB", "-F"}};
  const auto* const found = std::ranges::find(kPairs, mnemonic, &Pair::integers);
  return found == std::end(kPairs) ? std::string_view() : found->doubles;
}

std::span<const frontend::ForeignWord> foreignWords() { return kForeignWords; }

const Row& coilRow(int coilKind) {
  constexpr size_t kByKind[] = {indexOf("coil"), indexOf("negated-coil"), indexOf("SET"), indexOf("RST")};
  return kRows[kByKind[coilKind]];
}

} // namespace rung::frontend::nct

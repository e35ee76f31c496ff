// The table (see instructions.h): the rows of all families in one list, and ways to find one.
#include "frontend/dialects/nct/rows/instructions.h"

#include <algorithm>
#include <array>

#include "frontend/dialects/nct/rows/foreign_words.h"
#include "frontend/dialects/nct/rows/rows_control.h"
#include "frontend/dialects/nct/rows/rows_message.h"
#include "frontend/dialects/nct/rows/rows_nc.h"
#include "ir/support/check.h"

namespace rung::nct {
namespace {

using frontend::InstructionInfo;

constexpr size_t kRowCount = std::size(kBitRows) + std::size(kWordRows) + std::size(kFloatRows) +
                             std::size(kMessageRows) + std::size(kControlRows) + std::size(kNcRows);

constexpr std::array<Row, kRowCount> joinRows() {
  std::array<Row, kRowCount> rows{};
  size_t n = 0;
  for (const Row& row : kBitRows) rows[n++] = row;
  for (const Row& row : kWordRows) rows[n++] = row;
  for (const Row& row : kFloatRows) rows[n++] = row;
  for (const Row& row : kMessageRows) rows[n++] = row;
  for (const Row& row : kControlRows) rows[n++] = row;
  for (const Row& row : kNcRows) rows[n++] = row;
  return rows;
}
constexpr std::array<Row, kRowCount> kRows = joinRows();

constexpr std::array<const InstructionInfo*, kRowCount> infoPointers() {
  std::array<const InstructionInfo*, kRowCount> infos{};
  for (size_t i = 0; i < kRowCount; ++i) infos[i] = &kRows[i].info;
  return infos;
}
constexpr std::array<const InstructionInfo*, kRowCount> kInfos = infoPointers();

constexpr std::array<uint8_t, kRowCount> sortByMnemonic() {
  std::array<uint8_t, kRowCount> order{};
  for (size_t i = 0; i < kRowCount; ++i) order[i] = static_cast<uint8_t>(i);
  std::sort(order.begin(), order.end(),
            [](uint8_t a, uint8_t b) { return kRows[a].info.mnemonic < kRows[b].info.mnemonic; });
  return order;
}
constexpr std::array<uint8_t, kRowCount> kByMnemonic = sortByMnemonic();

constexpr bool complete() {
  for (const Row& row : kRows) {
    const InstructionInfo& info = row.info;
    if (info.mnemonic.empty() || info.title.empty() || info.group.empty() || info.ref.empty() || info.doc.empty() ||
        info.example.empty())
      return false;
    if (info.pins.size() == 0) return false;
  }
  for (size_t i = 1; i < kRowCount; ++i)
    if (kRows[kByMnemonic[i - 1]].info.mnemonic == kRows[kByMnemonic[i]].info.mnemonic) return false;
  return true;
}
static_assert(complete(), "every row says what it is, where the manual describes it, and has a name of its own");

constexpr size_t indexOf(std::string_view mnemonic) {
  for (size_t i = 0; i < kRowCount; ++i)
    if (kRows[i].info.mnemonic == mnemonic) return i;
  return kRowCount;
}

} // namespace

std::span<const Row> allRows() { return kRows; }
std::span<const InstructionInfo* const> instructionInfos() { return kInfos; }

const Row* findBox(std::string_view mnemonic) {
  const auto found =
      std::ranges::lower_bound(kByMnemonic, mnemonic, {}, [](uint8_t i) { return kRows[i].info.mnemonic; });
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

} // namespace rung::nct

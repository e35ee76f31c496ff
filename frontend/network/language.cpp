// Look-up of rows, and names for messages.
#include "frontend/network/language.h"

#include <fmt/format.h>

#include <algorithm>

#include "frontend/network/operand_kind.h"
#include "ir/support/check.h"
#include "rtlib/text/letters.h"

namespace rung::frontend::network {
namespace {

bool isFunction(const Row& row) { return row.info.number >= 0; }

template <class IsIt>
const Row* findRow(std::span<const Row* const> rows, IsIt isIt) {
  const auto at = std::ranges::find_if(rows, [&](const Row* row) { return isFunction(*row) && isIt(*row); });
  return at == rows.end() ? nullptr : *at;
}

} // namespace

bool Language::isList(std::string_view fileName) const {
  const std::string lower = text::lower(fileName);
  return std::ranges::any_of(listExtensions, [&](std::string_view one) { return lower.ends_with(one); });
}

const Row* Language::findFunction(std::string_view mnemonic) const {
  return findRow(rows, [&](const Row& row) { return text::equalsIgnoringCase(row.info.mnemonic, mnemonic); });
}

const Row* Language::findFunction(uint64_t number) const {
  return findRow(rows, [&](const Row& row) { return static_cast<uint64_t>(row.info.number) == number; });
}

bool Language::isBuilt(const frontend::InstructionInfo& info) const {
  const Row* row = info.number < 0 ? nullptr : findFunction(static_cast<uint64_t>(info.number));
  return row == nullptr || row->built;
}

const Row* Language::findRowOf(Control control) const {
  return findRow(rows, [&](const Row& one) { return one.control == control; });
}

const Row& Language::rowOf(Control control) const {
  const Row* row = findRowOf(control);
  RUNG_CHECK(row != nullptr, "a language is asked for what it has");
  return *row;
}

std::optional<uint32_t> Language::findLevel(std::string_view levelName) const {
  const auto at =
      std::ranges::find_if(levels, [&](const Level& one) { return text::equalsIgnoringCase(one.name, levelName); });
  return at == levels.end() ? std::nullopt : std::optional(static_cast<uint32_t>(at - levels.begin()));
}

uint32_t Language::mainLevel() const {
  const auto at = std::ranges::find(levels, Turn::Parts, &Level::turn);
  RUNG_CHECK(at != levels.end(), "a level of a language runs in parts");
  return static_cast<uint32_t>(at - levels.begin());
}

const Row& Language::endOf(uint32_t level) const {
  const Row* row = findFunction(levels[level].end);
  RUNG_CHECK(row != nullptr && row->control == Control::LevelEnd, "a function ends each level");
  return *row;
}

uint32_t Language::levelOf(const Row& end) const {
  const auto at = std::ranges::find(levels, end.info.mnemonic, &Level::end);
  RUNG_CHECK(at != levels.end(), "the end of a level ends one");
  return static_cast<uint32_t>(at - levels.begin());
}

std::string Language::fullNameOf(const Row& row) const {
  return fmt::format("{} ({} {})", row.info.mnemonic, nameOf(Command::Function), row.info.number);
}

std::string Language::callOf(const Row& row) const {
  const std::string_view function = nameOf(Command::Function);
  return calledByNumber ? fmt::format("{} {}", function, row.info.number)
                        : fmt::format("{} {}", function, row.info.mnemonic);
}

std::string Language::numbered(Control control, int64_t number) const {
  return fmt::format(fmt::runtime(kindOf(rowOf(control).info.operands[0]).written), number);
}

char Language::letterOf(Control control) const { return kindOf(rowOf(control).info.operands[0]).written[0]; }

std::string Language::mnemonicsOf(bool (*isSo)(const Row& row)) const {
  std::string text;
  for (const Row* row : rows)
    if (isSo(*row)) text += fmt::format("{}{}", text.empty() ? "" : " or ", row->info.mnemonic);
  return text;
}

} // namespace rung::frontend::network

// Instruction rows by their mnemonics (see rows.h).
#include "tools/view/rows.h"

#include "frontend/dialects/gsk/gsk.h"
#include "rtlib/text/letters.h"

namespace rung::view {

Rows::Rows(const frontend::Dialect& dialect) : ignoreCase_(&dialect == &gsk::kGsk) {
  for (const frontend::InstructionInfo* info : dialect.instructions) {
    if (ignoreCase_ && info->number < 0) continue; // a command of GSK's lists, no box
    Entry entry{info, {}};
    for (size_t i = 1; i < info->pins.size(); ++i) entry.furtherPins.push_back(info->pins[i].name);
    for (const std::string_view alias : info->aliases.all()) rows_.emplace(alias, entry);
    rows_.emplace(info->mnemonic, std::move(entry));
  }
  furtherPins_ = [this](std::string_view mnemonic) -> std::optional<std::span<const std::string_view>> {
    const Entry* found = entry(mnemonic);
    if (found == nullptr) return std::nullopt;
    return std::span(found->furtherPins);
  };
}

const Rows::Entry* Rows::entry(std::string_view mnemonic) const {
  const auto at = rows_.find(ignoreCase_ ? text::upper(mnemonic) : std::string(mnemonic));
  return at == rows_.end() ? nullptr : &at->second;
}

const frontend::InstructionInfo* Rows::find(std::string_view mnemonic) const {
  const Entry* found = entry(mnemonic);
  return found == nullptr ? nullptr : found->info;
}

} // namespace rung::view

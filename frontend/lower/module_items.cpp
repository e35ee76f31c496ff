// Items of modules (see module_items.h).
#include "frontend/lower/module_items.h"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

#include "ir/support/allowance.h"
#include "ir/support/hash.h"

namespace rung::frontend {
namespace {

template <class Id, class Item>
Id append(std::vector<Item>& items, Item item) {
  items.push_back(std::move(item));
  return {static_cast<uint32_t>(items.size()) - 1};
}

template <class Id>
Id once(std::vector<std::string>& texts, std::string_view text) {
  const auto found = std::ranges::find(texts, text);
  if (found == texts.end()) return append<Id>(texts, std::string(text));
  return {static_cast<uint32_t>(found - texts.begin())};
}

} // namespace

ir::SpaceId addSpace(ir::Module& module, ir::Space space) {
  return append<ir::SpaceId>(module.spaces, std::move(space));
}

ir::SlotId addSlot(ir::Module& module, ir::Slot slot) { return append<ir::SlotId>(module.slots, std::move(slot)); }

ir::RoutineId addRoutine(ir::Module& module, std::string name) {
  return append<ir::RoutineId>(module.routines, ir::Routine{.name = std::move(name), .rungs = {}});
}

std::unordered_map<uint32_t, ir::FileIndex> addFiles(ir::Module& module, const SourceManager& sources,
                                                     std::span<const FileId> files) {
  std::unordered_map<uint32_t, ir::FileIndex> added;
  for (const FileId file : files)
    added.emplace(file.index, append<ir::FileIndex>(module.files, std::string(sources.name(file))));
  return added;
}

void nameCells(ir::Module& module, std::string name, ir::Place place, ir::Type type, uint32_t count) {
  module.symbols.push_back({.name = std::move(name),
                            .space = place.space,
                            .byte = place.byte,
                            .type = ir::abiType(type),
                            .count = count,
                            .flags = RUNG_SYMBOL_HIDDEN});
}

void settleSymbols(ir::Module& module) {
  std::ranges::sort(module.symbols, {}, &ir::Symbol::name);
  for (ir::Symbol& symbol : module.symbols) symbol.comment = withoutAllowances(symbol.comment);
}

ir::ServiceId service(ir::Module& module, const nc::ServiceRow& row) {
  return once<ir::ServiceId>(module.services, row.text);
}

ir::FaultId fault(ir::Module& module, std::string_view text) { return once<ir::FaultId>(module.faults, text); }

std::string Numbering::numbered(std::string key) {
  if (const uint32_t number = alike_[key]++; number != 0) key += "~" + std::to_string(number);
  return key;
}

ir::SpaceId ConstantBytes::spaceOf(std::string_view bytes) {
  const auto [at, isNew] = spaces_.try_emplace(std::string(bytes));
  if (!isNew) return at->second;
  at->second = addSpace(module_, {.name = names_.numbered(fmt::format("@T{:016x}.{}", hashBytes(bytes), bytes.size())),
                                  .units = static_cast<uint32_t>(bytes.size()),
                                  .flags = RUNG_SPACE_HIDDEN});
  module_.inits.push_back({.space = at->second, .byte = 0, .data = {bytes.begin(), bytes.end()}});
  return at->second;
}

} // namespace rung::frontend

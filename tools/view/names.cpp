// Names, addresses and their comments (see names.h).
#include "tools/view/names.h"

#include <fmt/format.h>

#include "ir/support/allowance.h"
#include "rtlib/nc/names/names.h"
#include "rtlib/text/letters.h"
#include "tools/report/place_names.h"

namespace rung::view {
namespace {

// Whether an address is written as a number, as those of NCT are.
bool isNumber(std::string_view address) {
  const std::string_view cell = nc::headOf(address);
  return !cell.empty() && text::isDigit(cell.front());
}

} // namespace

Names::Names(const frontend::Dialect& dialect, const frontend::Analysis& analysis,
             const report::CrossReference& reference)
    : analysis_(analysis), reference_(reference) {
  addDefinitions();
  addSignals(dialect);
}

void Names::addDefinitions() {
  const auto add = [&](const frontend::Definition& definition) {
    if (const auto place = placeOf(definition.place))
      byAddress_.try_emplace(textOf(*place), Known{definition.name, definition.comment});
  };
  const std::span<const frontend::Definition> definitions = analysis_.definitions();
  for (uint32_t i = 0; i < definitions.size(); ++i) {
    if (!definitions[i].range.valid()) continue;
    declared_.emplace(definitions[i].range.begin, i);
    add(definitions[i]);
  }
  for (const frontend::Definition& definition : definitions) add(definition); // the control's own
}

void Names::addSignals(const frontend::Dialect& dialect) {
  for (const nc::Signal& signal : dialect.signals()) {
    const bool isBit = signal.type == nc::SignalType::Bit;
    const frontend::NamedPlace named{signal.area, signal.byteOffset * 8 + (isBit ? signal.bit : 0), isBit ? 1u : 8u};
    if (const auto place = placeOf(named)) byAddress_.try_emplace(textOf(*place), Known{signal.symbol, signal.meaning});
  }
}

std::optional<ir::BitRange> Names::placeOf(const frontend::NamedPlace& place) const {
  return report::rangeOf(reference_.program(), place);
}

std::string Names::textOf(const ir::BitRange& place) const {
  return nc::address(reference_.program(), report::refAt(place));
}

const Named& Names::at(const ir::BitRange& place) {
  const std::string address = textOf(place);
  const auto [found, isNew] = places_.try_emplace(fmt::format("{} {}", address, place.count));
  if (!isNew) return found->second;
  const report::Entry entry = reference_.of(report::refAt(place));
  found->second = {.address = {},
                   .comment = {},
                   .key = address,
                   .place = place,
                   .input = entry.controlWrites,
                   .output = entry.controlReads};
  return found->second;
}

Named Names::of(const frontend::Definition& definition) {
  Named named;
  if (const auto place = placeOf(definition.place)) {
    named = at(*place);
    named.address = named.key;
  }
  if (definition.isConstant()) {
    named.address = definition.value;
    named.key = definition.name;
  }
  named.comment = withoutAllowances(definition.comment);
  return named;
}

std::string_view Names::valueOf(const frontend::Word& operand) const {
  const frontend::Definition* name = analysis_.nameAt(operand.range);
  return name != nullptr && name->isConstant() ? name->value : operand.text;
}

Named Names::find(const frontend::Word& operand) {
  Named named = lookUp(operand);
  if (named.address == operand.text) named.address.clear(); // an address says nothing of itself
  return named;
}

Named Names::lookUp(const frontend::Word& operand) {
  if (const auto declared = declared_.find(operand.range.begin); declared != declared_.end())
    return of(analysis_.definitions()[declared->second]);
  const frontend::OperandUse* use = analysis_.operandAt(operand.range);
  const auto place = use == nullptr ? std::nullopt : placeOf(use->place);
  if (!place) {
    const frontend::Definition* name = analysis_.nameAt(operand.range);
    return name == nullptr ? Named{} : of(*name);
  }
  Named named = at(*place);
  if (use->base != frontend::kNoDefinition) {
    named.address = named.key + std::string(use->computed);
    named.comment = withoutAllowances(analysis_.definitions()[use->base].comment);
  } else if (const auto known = byAddress_.find(named.key); known != byAddress_.end()) {
    named.address = known->second.name;
    named.comment = withoutAllowances(known->second.comment);
  } else if (isNumber(operand.text) && !isNumber(named.key)) {
    named.address = named.key; // 0030.12 of NCT is INP000.12
  }
  if (use->computed.empty()) return named;
  named.key += use->computed;
  named.place.reset();
  return named;
}

} // namespace rung::view

// Looks up names, addresses and their comments.
#include "tools/view/names.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "ir/support/allowance.h"
#include "rtlib/nc/names/names.h"
#include "rtlib/text/letters.h"
#include "tools/report/cross_reference.h"
#include "tools/report/place_names.h"

namespace rung::view {

namespace {

// Whether addresses are numbers, as those of NCT are.
bool isNumber(std::string_view address) {
  const std::string_view cell = nc::headOf(address);
  return !cell.empty() && text::isDigit(cell.front());
}

} // namespace

std::string shownComment(std::string_view comment) {
  std::string text = withoutAllowances(comment);
  return text.ends_with(':') ? std::string() : text;
}

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
  for (const frontend::Definition& definition : definitions) add(definition); // declared by the control
}

void Names::addSignals(const frontend::Dialect& dialect) {
  for (const nc::Signal& signal : dialect.signals()) {
    const bool isBit = signal.type == nc::SignalType::Bit;
    const frontend::NamedPlace named{signal.area, signal.byteOffset * 8 + (isBit ? signal.bit : 0), isBit ? 1u : 8u};
    meanings_.try_emplace(signal.symbol, signal.meaning);
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
  named.comment = shownComment(definition.comment);
  return named;
}

std::string_view Names::valueOf(const frontend::Word& operand) const {
  const frontend::Definition* name = analysis_.nameAt(operand.range);
  return name != nullptr && name->isConstant() ? name->value : operand.text;
}

Named Names::find(const frontend::Word& operand) {
  Named named = lookUp(operand);
  if (named.address == operand.text) named.address.clear(); // the address is the operand itself
  return named;
}

Named Names::find(const frontend::chart::Operand& operand) {
  const frontend::OperandUse* use = operand.use.place.bits == 0 ? nullptr : &operand.use;
  const bool isName = operand.name != frontend::kNoDefinition;
  Named named = lookUp(use, isName ? &analysis_.definitions()[operand.name] : nullptr, operand.text);
  if (named.address == operand.text) named.address.clear();
  return named;
}

Named Names::lookUp(const frontend::Word& operand) {
  if (const auto declared = declared_.find(operand.range.begin); declared != declared_.end())
    return of(analysis_.definitions()[declared->second]);
  return lookUp(analysis_.operandAt(operand.range), analysis_.nameAt(operand.range), operand.text);
}

Named Names::lookUp(const frontend::OperandUse* use, const frontend::Definition* name, std::string_view operand) {
  const auto place = use == nullptr ? std::nullopt : placeOf(use->place);
  if (!place) return name == nullptr ? Named{} : of(*name);
  Named named = at(*place);
  if (use->base != frontend::kNoDefinition) {
    named.address = named.key + std::string(use->computed);
    const frontend::Definition& base = analysis_.definitions()[use->base];
    named.comment = shownComment(base.comment);
    const auto meaning = base.range.valid() ? meanings_.end() : meanings_.find(base.name);
    if (named.comment.empty() && meaning != meanings_.end()) named.comment = meaning->second;
  } else if (const auto known = byAddress_.find(named.key); known != byAddress_.end()) {
    named.address = known->second.name;
    named.comment = shownComment(known->second.comment);
  } else if (isNumber(operand) && !isNumber(named.key)) {
    named.address = named.key; // 0030.12 of NCT is INP000.12
  }
  if (use->computed.empty()) return named;
  named.key += use->computed;
  named.place.reset();
  return named;
}

uint32_t Targets::idOf(const frontend::TargetUse& use) {
  const auto [found, fresh] = ids_.emplace(std::pair(use.scope, use.number), static_cast<uint32_t>(targets_.size()));
  if (fresh) targets_.emplace_back();
  return found->second;
}

void Targets::ask(uint32_t id, uint32_t rung) {
  std::vector<uint32_t>& callers = targets_[id].callers;
  if (callers.empty() || callers.back() != rung) callers.push_back(rung);
}

namespace {

// Characters of a path that need no escape in a link.
bool isPlain(char c) {
  return text::isDigit(c) || text::isLetter(c) || std::string_view("/._-~").find(c) != std::string_view::npos;
}

std::string encoded(std::string_view path) {
  std::string out;
  for (char c : path) isPlain(c) ? void(out += c) : void(out += fmt::format("%{:02X}", static_cast<unsigned char>(c)));
  return out;
}

void replace(std::string& text, std::string_view what, std::string_view with) {
  for (size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + with.size()))
    text.replace(at, what.size(), with);
}

} // namespace

LinkTo sourceLinks(std::string_view page, std::string_view link) {
  std::error_code unreadable; // a path that cannot be made absolute is left as it is
  const std::filesystem::path folder = std::filesystem::absolute(page, unreadable).parent_path().lexically_normal();
  return [folder, link = std::string(link), known = std::map<std::string, std::string>()](const SourceFile& file,
                                                                                          uint32_t line) mutable {
    std::string& whole = known[file.path]; // the link up to the line number
    if (whole.empty()) {
      std::error_code bad;
      const auto path = std::filesystem::absolute(file.path, bad).lexically_normal();
      whole = link;
      replace(whole, "{file}", encoded(path.lexically_relative(folder).generic_string()));
      replace(whole, "{path}", encoded(path.generic_string()));
    }
    std::string result = whole;
    replace(result, "{line}", std::to_string(line));
    return result;
  };
}

// Uses as drawn, and those that only the program shows.

void UseIndex::settle() {
  if (longest_ != 0) return;
  longest_ = 1;
  for (const Drawn& drawn : drawn_) longest_ = std::max(longest_, drawn.place.count);
  std::ranges::stable_sort(drawn_, {}, [](const Drawn& drawn) { return report::startOf(drawn.place); });
}

std::vector<Use> UseIndex::drawnAt(const ir::BitRange& place) const {
  std::vector<Use> uses;
  report::forEachAt(
      place, drawn_, longest_, [](const Drawn& drawn) { return drawn.place; },
      [&](const Drawn& drawn) { uses.push_back(drawn.use); });
  return uses;
}

// The use by an operand takes precedence over what the program does with the place.
std::vector<Use> UseIndex::of(const ir::BitRange& place) {
  settle();
  std::vector<Use> uses = drawnAt(place);
  std::ranges::sort(uses);
  const size_t drawn = uses.size();
  for (const report::RungAccess& access : reference_.accessesOf(place)) {
    const uint32_t rung = reference_.program().rungs[access.rung].number;
    const auto first =
        std::ranges::lower_bound(uses.begin(), uses.begin() + static_cast<ptrdiff_t>(drawn), rung, {}, &Use::rung);
    const bool isDrawn = first != uses.begin() + static_cast<ptrdiff_t>(drawn) && first->rung == rung;
    if (rung == 0 || isDrawn || access.indexed) continue;
    if (access.reads) uses.push_back({rung, false});
    if (access.writes) uses.push_back({rung, true});
  }
  std::ranges::sort(uses);
  const auto again = std::ranges::unique(uses);
  uses.erase(again.begin(), again.end());
  return uses;
}

} // namespace rung::view

// See subject.h.
#include "tools/lsp/subject.h"

#include <algorithm>

namespace rung::lsp {
namespace {

using frontend::Analysis;
using frontend::Definition;
using frontend::NamedPlace;

bool same(const NamedPlace& a, const NamedPlace& b) {
  return a.space == b.space && a.firstBit == b.firstBit && a.bits == b.bits;
}

std::optional<NamedPlace> placeOf(const Definition& definition) {
  return definition.isConstant() || definition.place.bits == 0 ? std::nullopt : std::optional(definition.place);
}

std::optional<Subject> subjectIn(const Analysis& analysis, SourcePos at) {
  if (const frontend::NameUse* use = analysis.nameUseAt(at)) {
    const Definition& definition = analysis.definitions()[use->definition];
    return Subject{.range = use->range, .definition = &definition, .place = placeOf(definition)};
  }
  if (const Definition* declared = analysis.declaredAt(at))
    return Subject{.range = declared->range, .definition = declared, .place = placeOf(*declared)};
  if (const frontend::TargetUse* target = analysis.targetAt(at))
    return Subject{.range = target->range, .target = target};
  if (const frontend::OperandUse* operand = analysis.operandAt(at))
    return Subject{.range = operand->range, .place = operand->place};
  return std::nullopt;
}

// Of the operands: that of a name has the range of the name, without an index.
void addOperands(const Analysis& analysis, const NamedPlace& place, std::vector<Occurrence>& found) {
  for (const frontend::OperandUse& operand : analysis.operands()) {
    if (!same(operand.place, place) || !operand.computed.empty()) continue;
    found.push_back({.range = operand.range, .writes = isWritten(operand.access)});
  }
}

void addTargets(const Analysis& analysis, const frontend::TargetUse& target, std::vector<Occurrence>& found) {
  for (const frontend::TargetUse& use : analysis.targets())
    if (use.scope == target.scope && use.number == target.number)
      found.push_back({.range = use.range, .declares = use.defines});
}

void addName(const Analysis& analysis, const Definition& definition, std::vector<Occurrence>& found) {
  const auto index = static_cast<uint32_t>(&definition - analysis.definitions().data());
  if (definition.range.valid()) found.push_back({.range = definition.range, .declares = true});
  for (const frontend::NameUse& use : analysis.names())
    if (use.definition == index) found.push_back({.range = use.range, .writes = isWrittenAt(analysis, use.range)});
}

// Of those that begin at one place, the first: the name of an operand with an index.
std::vector<Occurrence> ordered(std::vector<Occurrence> found) {
  std::ranges::stable_sort(found, {}, [](const Occurrence& one) { return one.range.begin; });
  const auto again = std::ranges::unique(found, {}, [](const Occurrence& one) { return one.range.begin; });
  found.erase(again.begin(), again.end());
  return found;
}

} // namespace

bool isWrittenAt(const Analysis& analysis, SourceRange name) {
  const frontend::OperandUse* operand = analysis.operandAt(name.begin);
  return operand != nullptr && operand->range.begin == name.begin && isWritten(operand->access);
}

std::optional<Subject> subjectAt(const Analysis& analysis, SourcePos at) {
  std::optional<Subject> found = subjectIn(analysis, at);
  if (!found && at.value > 1) found = subjectIn(analysis, {at.value - 1});
  return found;
}

std::vector<Occurrence> occurrencesOf(const Analysis& analysis, const Subject& subject) {
  std::vector<Occurrence> found;
  if (subject.target != nullptr) addTargets(analysis, *subject.target, found);
  if (subject.definition != nullptr) addName(analysis, *subject.definition, found);
  if (subject.place) {
    for (const Definition& other : analysis.definitions())
      if (&other != subject.definition && placeOf(other) && same(other.place, *subject.place))
        addName(analysis, other, found);
    addOperands(analysis, *subject.place, found);
  }
  return ordered(std::move(found));
}

std::vector<Occurrence> occurrencesOf(const Analysis& analysis, const Definition& definition) {
  std::vector<Occurrence> found;
  addName(analysis, definition, found);
  return ordered(std::move(found));
}

} // namespace rung::lsp

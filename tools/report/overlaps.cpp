// Names that overlap others (see overlaps.h).
#include "tools/report/overlaps.h"

#include <algorithm>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "ir/support/diag/structure.h"
#include "tools/report/cross_reference.h"
#include "tools/report/place_names.h"
#include "tools/report/xref_allowed.h"

namespace rung::report {
namespace {

using frontend::Access;
using frontend::Analysis;
using frontend::Definition;
using frontend::OperandUse;

// A declared name of a place.
struct Name {
  uint32_t definition = 0;
  ir::BitRange place;
  SourceRange widened; // the operand that makes it wider than its declaration; invalid: none
};

class Checker {
public:
  Checker(const SourceManager& sources, const Analysis& analysis, const CrossReference& reference,
          Diagnostics& diagnostics);
  void run() {
    for (const Name& name : names_) check(name);
  }

private:
  using Operands = std::span<const OperandUse* const>;

  const Definition& definitionOf(const Name& name) const { return analysis_.definitions()[name.definition]; }
  Operands operandsOf(const Name& name) const;
  void widen(Name& name) const;
  void check(const Name& name);
  bool overlaps(const Name& wide, const Name& other) const;
  bool isWrittenBy(const Name& name, const ir::BitRange& bits) const;
  bool isNumber(const ir::BitRange& place) const;
  std::vector<uint32_t> pathsTo(const Definition& name) const;
  bool isReachedBy(const Definition& name, const Name& other) const;
  bool isWidenedOver(const Name& name, const Name& other) const;
  bool meets(const Name& name, const Name& other, Diag code) const;
  void reportTerminal(const Name& name, const Name& other);
  void reportOverlap(const Name& wide, const Name& other, size_t count);

  const SourceManager& sources_;
  const Analysis& analysis_;
  const CrossReference& reference_;
  Diagnostics& diagnostics_;
  std::vector<const OperandUse*> operands_; // operands that begin with a name, by its definition
  std::vector<Name> names_;                 // by place
  uint32_t longest_ = 1;                    // most bits of a name's place
};

Checker::Checker(const SourceManager& sources, const Analysis& analysis, const CrossReference& reference,
                 Diagnostics& diagnostics)
    : sources_(sources), analysis_(analysis), reference_(reference), diagnostics_(diagnostics) {
  for (const OperandUse& operand : analysis.operands())
    if (operand.base != frontend::kNoDefinition && operand.computed.empty()) operands_.push_back(&operand);
  std::ranges::stable_sort(operands_, {}, &OperandUse::base);
  for (uint32_t i = 0; i < analysis.definitions().size(); ++i) {
    const Definition& definition = analysis.definitions()[i];
    const auto place = rangeOf(reference.program(), definition.place);
    if (!place || !definition.range.valid()) continue;
    Name& name = names_.emplace_back(Name{i, *place, {}});
    widen(name);
    longest_ = std::max(longest_, name.place.count);
  }
  std::ranges::stable_sort(names_, {}, [](const Name& name) { return startOf(name.place); });
}

Checker::Operands Checker::operandsOf(const Name& name) const {
  const auto found = std::ranges::equal_range(operands_, name.definition, {}, &OperandUse::base);
  return {found.begin(), found.end()};
}

void Checker::widen(Name& name) const {
  for (const OperandUse* operand : operandsOf(name)) {
    const auto place = rangeOf(reference_.program(), operand->place);
    const bool begins = operand->isVariable && place && startOf(*place) == startOf(name.place);
    if (!begins || place->count <= name.place.count) continue;
    name.place = *place;
    name.widened = operand->range;
  }
}

bool Checker::isWrittenBy(const Name& name, const ir::BitRange& bits) const {
  return std::ranges::any_of(operandsOf(name), [&](const OperandUse* operand) {
    const auto place = rangeOf(reference_.program(), operand->place);
    return operand->access != Access::Read && place && ir::overlap(*place, bits);
  });
}

// A number is read and written as a whole by one rung, as in rungs with timers, counters and sums. A word of flags is
// tested in one rung and cleared in another one.
bool Checker::isNumber(const ir::BitRange& place) const {
  return std::ranges::any_of(reference_.accessesOf(place), [&](const RungAccess& access) {
    return access.reads && access.writes && access.as == place;
  });
}

// The names, by their definitions, that are used on the line that declares this one.
std::vector<uint32_t> Checker::pathsTo(const Definition& name) const {
  std::vector<uint32_t> paths;
  const auto beginOf = [](const frontend::NameUse& use) { return use.range.begin; };
  const LineCol place = sources_.lineCol(name.range.begin);
  const auto isOnLine = [&](SourcePos position) {
    const LineCol at = sources_.lineCol(position);
    return at.file == place.file && at.line == place.line;
  };
  for (auto at = std::ranges::lower_bound(analysis_.names(), name.range.begin, {}, beginOf);
       at != analysis_.names().end() && isOnLine(at->range.begin); ++at)
    paths.push_back(at->definition);
  return paths;
}

bool Checker::isReachedBy(const Definition& name, const Name& other) const {
  return std::ranges::count(pathsTo(name), other.definition) != 0;
}

// Whether the name overlaps the other one only through an operand that is wider than its declaration.
bool Checker::isWidenedOver(const Name& name, const Name& other) const {
  const auto declared = rangeOf(reference_.program(), definitionOf(name).place);
  return name.widened.valid() && declared && !ir::overlap(*declared, other.place);
}

// Whether a report of the two is wanted. Overlaps that declarations create without an address, such as bits of their
// byte, are intended. A file that several others include declares its names once per inclusion.
bool Checker::meets(const Name& name, const Name& other, Diag code) const {
  const Definition& one = definitionOf(name);
  const Definition& two = definitionOf(other);
  return (one.isPlaced || two.isPlaced || isWidenedOver(name, other)) && one.range != two.range &&
         !isAllowed(one, code) && !isAllowed(two, code) && !isReachedBy(one, other) && !isReachedBy(two, name);
}

bool Checker::overlaps(const Name& wide, const Name& other) const {
  const bool written[] = {isWrittenBy(wide, other.place), isWrittenBy(other, wide.place)};
  const bool isBit = other.place.count == 1;
  const bool both = isBit ? written[0] && written[1] && isNumber(wide.place) : written[0] || written[1];
  return both && meets(wide, other, diag::Overlap);
}

void Checker::check(const Name& name) {
  const Name* first = nullptr;
  const Name* before = nullptr; // for the same place
  bool isMeant = false;         // declared in terms of one of them
  const std::vector<uint32_t> paths = pathsTo(definitionOf(name));
  size_t count = 0;
  forEachAt(
      name.place, names_, longest_, [](const Name& one) { return one.place; },
      [&](const Name& other) {
        if (other.place == name.place) {
          const bool isEarlier = other.definition < name.definition;
          isMeant |= std::ranges::count(paths, other.definition) != 0;
          if (isEarlier && before == nullptr && meets(name, other, diag::SharedTerminal)) before = &other;
          return;
        }
        const bool isWider =
            std::pair(name.place.count, name.definition) > std::pair(other.place.count, other.definition);
        if (!isWider || !overlaps(name, other)) return;
        if (first == nullptr || other.definition < first->definition) first = &other;
        ++count;
      });
  if (before != nullptr && !isMeant) reportTerminal(name, *before);
  if (first != nullptr) reportOverlap(name, *first, count);
}

void Checker::reportTerminal(const Name& name, const Name& other) {
  const Entry entry = reference_.of(refAt(name.place));
  if (!entry.controlWrites && !entry.controlReads) return;
  diagnostics_.report(diag::SharedTerminal, definitionOf(name).range)
          .note(definitionOf(other).range, fmt::format("'{}' is declared here", definitionOf(other).name))
      << definitionOf(name).name << definitionOf(other).name;
}

void Checker::reportOverlap(const Name& wide, const Name& other, size_t count) {
  DiagBuilder report = diagnostics_.report(diag::Overlap, definitionOf(wide).range);
  report << definitionOf(wide).name << definitionOf(other).name
         << (count == 1   ? std::string()
             : count == 2 ? std::string(" and another name")
                          : fmt::format(" and {} other names", count - 1));
  report.note(definitionOf(other).range, fmt::format("'{}' is declared here", definitionOf(other).name));
  if (wide.widened.valid())
    report.note(wide.widened, fmt::format("'{}' has {} bits here", definitionOf(wide).name, wide.place.count));
}

} // namespace

void reportOverlaps(const SourceManager& sources, const Analysis& analysis, const CrossReference& reference,
                    Diagnostics& diagnostics) {
  Checker(sources, analysis, reference, diagnostics).run();
}

} // namespace rung::report

// Names that look like mistakes (see odd_names.h).
#include "tools/report/odd_names.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <tuple>

#include "ir/image/program_image.h"
#include "ir/support/diag/structure.h"
#include "ir/support/meant.h"
#include "tools/report/cross_reference.h"
#include "tools/report/overlaps.h"
#include "tools/report/place_names.h"
#include "tools/report/xref_allowed.h"

namespace rung::report {
namespace {

using frontend::Access;
using frontend::Analysis;
using frontend::Definition;
using frontend::OperandUse;

constexpr std::string_view kUnused = "used by no rung";
constexpr std::string_view kReadOnly = "read, but written by no rung";
constexpr std::string_view kWrittenOnly = "written, but read by no rung";
constexpr std::string_view kNeverReset = "set, but reset by no rung";

using Key = std::tuple<uint32_t, uint32_t, uint32_t>; // space, first bit, bits
Key keyOf(const ir::BitRange& place) { return {place.space.index, place.first, place.count}; }

// A likely mistake about a place, and the operand that shows it.
struct Oddity {
  Diag code{};
  SourceRange operand;
};

// How a place is used.
struct Sides {
  bool read = false;
  bool written = false;
  bool isDue = false;                // written by a coil that the instruction requires
  bool isChanged = false;            // written other than by setting it
  SourceRange set;                   // the coil that sets it
  std::vector<SourceRange> operands; // those that access it

  void add(bool reads, bool writes) {
    read |= reads;
    written |= writes;
  }
};

class Checker {
public:
  Checker(const SourceManager& sources, const Analysis& analysis, const CrossReference& reference)
      : sources_(sources), analysis_(analysis), reference_(reference), used_(analysis.definitions().size()),
        reach_(analysis.definitions().size()) {
    for (const frontend::NameUse& name : analysis.names()) use(name.definition);
    for (const OperandUse& operand : analysis.operands())
      if (const auto place = rangeOf(reference.program(), operand.place)) add({*place, &operand});
    std::ranges::stable_sort(operands_, {}, [](const Placed& one) { return startOf(one.place); });
    for (const Placed& one : operands_) longest_ = std::max(longest_, one.place.count);
  }

  // The oddities of a place that the program names. `used`: also other than as an operand. `reach`: the bits of the
  // widest operand of that name, such as a double, each part of which may be read or written separately.
  std::vector<Oddity> odditiesOf(const ir::BitRange& place, bool used, uint32_t reach) const;
  std::vector<OddName> names() {
    for (uint32_t i = 0; i < used_.size(); ++i) {
      const Definition& definition = analysis_.definitions()[i];
      if (definition.range.valid()) check(definition, used_[i], reach_[i]);
    }
    return std::move(found_);
  }

private:
  struct Placed {
    ir::BitRange place;
    const OperandUse* operand;
  };

  // A file that several others include declares its names once per inclusion.
  using Place = std::tuple<std::string_view, uint32_t, uint32_t>; // file, line, column
  Place placeOf(const Definition& definition) const {
    const LineCol at = sources_.lineCol(definition.range.begin);
    return {at.file, at.line, at.column};
  }
  void use(uint32_t index) {
    if (used_[index]) return;
    used_[index] = true;
    const Definition& definition = analysis_.definitions()[index];
    if (definition.range.valid()) settled_.insert(placeOf(definition));
  }
  void add(const Placed& one) {
    operands_.push_back(one);
    const uint32_t base = one.operand->base;
    if (base == frontend::kNoDefinition) return;
    const bool begins = one.operand->place.firstBit == analysis_.definitions()[base].place.firstBit;
    if (begins) reach_[base] = std::max(reach_[base], one.place.count);
  }
  void check(const Definition& definition, bool used, uint32_t reach);
  Sides operandsAt(const ir::BitRange& place) const;
  using Line = std::pair<std::string_view, uint32_t>;
  std::vector<Line> linesOf(const std::vector<SourceRange>& operands) const;
  bool isIn(const std::vector<Line>& lines, uint32_t rung) const; // some of the lines
  void addImplicit(const ir::BitRange& place, Sides& sides) const;
  bool mayChange(const ir::BitRange& place, const Sides& sides) const;
  void reportUnused(const Definition& definition);
  void report(const Oddity& oddity, const Definition& definition);

  const SourceManager& sources_;
  const Analysis& analysis_;
  const CrossReference& reference_;
  std::vector<OddName> found_;
  std::vector<bool> used_;      // by definition
  std::vector<uint32_t> reach_; // by definition, see odditiesOf
  std::set<Place> settled_;     // of definitions that are used, or have been reported as unused
  std::vector<Placed> operands_;
  uint32_t longest_ = 1; // most bits of an operand's place
};

Sides Checker::operandsAt(const ir::BitRange& place) const {
  Sides sides;
  const auto add = [&](const Placed& one) {
    const Access access = one.operand->access;
    sides.add(access == Access::Read || access == Access::ReadWrite, access != Access::Read);
    sides.isDue |= one.operand->isDue;
    sides.isChanged |= access != Access::Read && !one.operand->isSet;
    if (one.operand->isSet) sides.set = one.operand->range;
    sides.operands.push_back(one.operand->range);
  };
  forEachAt(place, operands_, longest_, [](const Placed& one) { return one.place; }, add);
  return sides;
}

// File and line of each operand, sorted.
std::vector<Checker::Line> Checker::linesOf(const std::vector<SourceRange>& operands) const {
  std::vector<Line> lines;
  for (const SourceRange operand : operands) {
    const LineCol at = sources_.lineCol(operand.begin);
    lines.emplace_back(at.file, at.line);
  }
  std::ranges::sort(lines);
  return lines;
}

bool Checker::isIn(const std::vector<Line>& lines, uint32_t rung) const {
  const rung_program& program = reference_.program();
  const rung_info& info = program.rungs[rung];
  if (info.file == RUNG_NONE) return false;
  const std::string_view file = program.files[info.file];
  const auto at = std::ranges::lower_bound(lines, Line(file, info.first_line));
  return at != lines.end() && at->first == file && at->second <= info.last_line;
}

// Adds uses without an operand. A rung with an operand for the place does only what the operand says.
void Checker::addImplicit(const ir::BitRange& place, Sides& sides) const {
  const std::vector<Line> lines = linesOf(sides.operands);
  for (const RungAccess& access : reference_.accessesOf(place))
    if (!isIn(lines, access.rung)) sides.add(access.reads, access.writes);
  if (sides.read && sides.written) return;
  for (const RungAccess& access : reference_.perhaps(refAt(place))) sides.add(access.reads, access.writes);
}

// Whether anything but its setting coils writes a place, including the operator, the control and an index.
bool Checker::mayChange(const ir::BitRange& place, const Sides& sides) const {
  if (sides.isChanged || reference_.uses().isRetained(place) || reference_.of(refAt(place)).controlWrites) return true;
  const std::vector<Line> lines = linesOf(sides.operands);
  const auto writesElsewhere = [&](const RungAccess& access) { return access.writes && !isIn(lines, access.rung); };
  return std::ranges::any_of(reference_.accessesOf(place), writesElsewhere) ||
         std::ranges::any_of(reference_.perhaps(refAt(place)), &RungAccess::writes);
}

void Checker::reportUnused(const Definition& definition) {
  if (!definition.isListed && settled_.insert(placeOf(definition)).second) report({diag::UnusedName, {}}, definition);
}

void Checker::report(const Oddity& oddity, const Definition& definition) {
  if (isAllowed(definition, oddity.code)) return;
  found_.push_back({&definition, oddity.code, oddity.operand});
}

std::vector<Oddity> Checker::odditiesOf(const ir::BitRange& place, bool used, uint32_t reach) const {
  std::vector<Oddity> found;
  Sides sides = operandsAt(place);
  if (reach > place.count) {
    const Sides whole = operandsAt({place.space, place.first, reach});
    sides.add(whole.read, whole.written);
  }
  const bool unused = !used && sides.operands.empty();
  if (place.count == 1 && sides.written && !mayChange(place, sides)) found.push_back({diag::NeverReset, sides.set});
  if (!unused && sides.read == sides.written) return found;
  addImplicit(place, sides);
  if (unused && !sides.read && !sides.written) return {{diag::UnusedName, {}}};
  if (sides.read == sides.written || reference_.uses().isRetained(place)) return found;
  const Entry entry = reference_.of(refAt(place));
  const SourceRange operand = sides.operands.empty() ? SourceRange{} : sides.operands.front();
  if (!sides.written && !entry.controlWrites) found.push_back({diag::NeverWritten, operand});
  if (!sides.read && !sides.isDue && !entry.controlReads) found.push_back({diag::NeverRead, operand});
  return found;
}

void Checker::check(const Definition& definition, bool used, uint32_t reach) {
  const std::optional<ir::BitRange> place = rangeOf(reference_.program(), definition.place);
  if (!place) {
    const bool isTarget = analysis_.targetAt(definition.range) != nullptr; // a label or a procedure
    if (!used && !definition.usedByControl && (definition.isConstant() || isTarget)) reportUnused(definition);
    return;
  }
  for (const Oddity& oddity : odditiesOf(*place, used, reach)) {
    if (oddity.code == diag::UnusedName)
      reportUnused(definition);
    else if (!definition.usedByControl) // otherwise the other side is not in the program
      report(oddity, definition);
  }
}

std::string_view textOf(Diag code) {
  if (code == diag::NeverWritten) return kReadOnly;
  if (code == diag::NeverReset) return kNeverReset;
  return code == diag::NeverRead ? kWrittenOnly : kUnused;
}

// Of several oddities of a place, that it is only read or only written takes precedence.
void add(std::string_view& shown, Diag code) {
  if (shown.empty() || shown == kNeverReset) shown = textOf(code);
}

} // namespace

std::vector<OddName> oddNames(const SourceManager& sources, const Analysis& analysis, const CrossReference& reference) {
  return Checker(sources, analysis, reference).names();
}

namespace {

// For `allow(…)` with a word that is not the code of a warning, but resembles one; other words may be a remark in
// brackets.
void reportUnknownCodes(const Definition& definition, Diagnostics& diagnostics) {
  for (const std::string_view code : allowedCodes(definition.comment)) {
    if (findDiag(code) != nullptr) continue;
    const std::string_view similar = text::mostSimilar(code, allDiags(), &DiagInfo::code);
    if (similar.empty() && code.find('-') == std::string_view::npos) continue;
    diagnostics.report(diag::UnknownAllowance, definition.range).meant({}, similar) << code;
  }
}

} // namespace

void reportOddNames(const SourceManager& sources, const Analysis& analysis, const CrossReference& reference,
                    Diagnostics& diagnostics) {
  for (const OddName& name : oddNames(sources, analysis, reference)) {
    DiagBuilder report = diagnostics.report(name.code, name.definition->range);
    report << name.definition->name;
    if (name.operand.valid()) report.note(name.operand, "here");
  }
  for (const Definition& definition : analysis.definitions())
    if (definition.range.valid()) reportUnknownCodes(definition, diagnostics);
  reportOverlaps(sources, analysis, reference, diagnostics);
}

void reportOddNames(const SourceManager& sources, const Analysis& analysis, const ir::Layout& layout,
                    const ir::Uses& uses, std::span<const std::string_view> shown, Diagnostics& diagnostics) {
  const ir::ProgramImage image(layout, 0);
  reportOddNames(sources, analysis, CrossReference(image.program(), uses, shown), diagnostics);
}

void markOdd(const SourceManager& sources, const Analysis& analysis, const CrossReference& reference,
             std::vector<Entry>& entries) {
  const auto placeOf = [&](const frontend::NamedPlace& place) { return rangeOf(reference.program(), place); };
  Checker checker(sources, analysis, reference);
  std::map<Key, std::string_view> declared; // to its oddity; for two names at one place, the first oddity
  std::vector<ir::BitRange> controls, operands;
  for (const Definition& definition : analysis.definitions()) {
    const auto place = placeOf(definition.place);
    if (place && definition.range.valid()) declared.try_emplace(keyOf(*place));
    if (place && !definition.range.valid()) controls.push_back(*place);
  }
  for (const OddName& name : checker.names())
    if (const auto place = placeOf(name.definition->place)) add(declared[keyOf(*place)], name.code);
  for (const OperandUse& operand : analysis.operands())
    if (const auto place = placeOf(operand.place)) operands.push_back(*place);
  const PlaceSet ofControl(std::move(controls)); // part of the control's interface, used or not
  const PlaceSet named(std::move(operands));     // the rest belongs to instructions, such as their flags
  for (Entry& entry : entries) {
    const ir::BitRange bits = bitsOf(entry.place);
    const auto name = declared.find(keyOf(bits));
    entry.declared = name != declared.end();
    if (entry.declared) {
      entry.odd = name->second;
      continue;
    }
    if (!named.meets(bits) || ofControl.meets(bits)) continue;
    for (const Oddity& oddity : checker.odditiesOf(bits, true, bits.count)) add(entry.odd, oddity.code);
  }
}

} // namespace rung::report

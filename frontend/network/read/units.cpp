// Assembles the units of a program (§1.2): the levels, each with its end, then subprograms.
#include "frontend/network/read/units.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include <fmt/format.h>

#include "ir/support/diag/pmc.h"
#include "ir/support/diag/structure.h"

namespace rung::frontend::network {

void UnitAssembler::add(Network&& network) {
  sawList_ = true;
  if (network.incomplete) incomplete_ = true;
  switch (controlOf(network)) {
  case Control::LevelEnd: return endLevel(std::move(network));
  case Control::Sp: return beginSubprogram(network);
  case Control::Spe: return endSubprogram(std::move(network));
  case Control::ProgramEnd: return endProgram(std::move(network));
  case Control::Plain:
  case Control::Jmp:
  case Control::Jmpe:
  case Control::Jmpb:
  case Control::Jmpc:
  case Control::Lbl:
  case Control::Call:
  case Control::CallU:
  case Control::Com:
  case Control::Come: return body(std::move(network));
  }
}

void UnitAssembler::body(Network&& network) {
  if (!open_.empty()) open_.back().closedInner = false;
  if (current_ != kNone) return program_.units[current_].networks.push_back(std::move(network));
  if (!strayReported_ && !network.incomplete) stray_.push_back(network.range);
  strayReported_ = true;
  program_.units[levelCount() - 1].networks.push_back(std::move(network)); // its labels, calls and regions still count
}

const Row& UnitAssembler::lastEnd() const {
  uint32_t level = levelCount() - 1;
  while (level > 0 && language_.levels[level].optional && !ends_[level].valid()) --level;
  return language_.endOf(level);
}

// An optional level begins with the first network after the level before it. If its end does not follow, the program
// does not have the level, and these networks are outside of all units; its comments go to what comes next.
void UnitAssembler::leaveOptional(Gap& next) {
  if (!open_.empty() || !isInOptional()) return;
  Unit& unit = program_.units[current_];
  if (!unit.networks.empty() && !unit.networks.front().incomplete) stray_.push_back(unit.networks.front().range);
  if (!unit.comment.empty()) unit.lead.push_back(commentItem(std::exchange(unit.comment, {})));
  next.insert(next.begin(), std::make_move_iterator(unit.lead.begin()), std::make_move_iterator(unit.lead.end()));
  unit.lead.clear();
  current_ = kNone;
}

void UnitAssembler::endProgram(Network&& network) {
  leaveOptional(network.gap);
  closeAll();
  if (programEnd_.valid())
    context_.diagnostics.report(diag::DuplicateProgramEnd, network.function.range)
        << network.function.row->info.mnemonic;
  programEnd_ = network.function.range;
  giveBackSource(network);
  strayReported_ = false;
}

uint32_t UnitAssembler::nextEnded(uint32_t level) const {
  while (++level < levelCount() && !ends_[level].valid()) {
  }
  return level;
}

void UnitAssembler::endLevel(Network&& network) {
  const uint32_t level = language_.levelOf(*network.function.row);
  const SourceRange range = network.function.range;
  if (ends_[level].valid()) {
    context_.diagnostics.report(language_.levels[level].endTwice, range)
        << language_.fullNameOf(language_.endOf(level));
    return;
  }
  ends_[level] = range;
  if (const std::string before = isAfter(level); !before.empty()) return endOrder(level, before, range);
  closeAll();
  current_ = level + 1 == levelCount() ? kNone : level + 1;
  if (current_ != kNone)
    takeSource(program_.units[current_], network);
  else
    giveBackSource(network);
  program_.units[level].networks.push_back(std::move(network));
}

// Moves the source text of the commands that begin a unit. A unit has one comment; further comments are put before it.
void UnitAssembler::takeSource(Unit& unit, Network& network) {
  unit.lead = std::move(network.gap);
  const auto toLead = [&unit](const std::string& text) { unit.lead.push_back(commentItem(text)); };
  for (Written& written : network.written) {
    std::ranges::for_each(std::exchange(written.before, {}), toLead);
    std::string comment = std::exchange(written.comment, {});
    if (!isLogic(written.command) && unit.comment.empty())
      unit.comment = std::move(comment);
    else if (!comment.empty())
      toLead(comment);
    if (isLogic(written.command)) unit.condition.push_back(std::move(written));
  }
}

// The end of a unit does not exist in ladder text: its comments go to the next item.
void UnitAssembler::giveBackSource(Network& network) {
  if (network.written.empty()) return;
  if (!network.written[0].comment.empty()) network.gap.push_back(commentItem(network.written[0].comment));
  context_.gaps.giveBack(std::exchange(network.gap, {}));
}

std::string UnitAssembler::isAfter(uint32_t level) const {
  if (const uint32_t later = nextEnded(level); later != levelCount())
    return language_.fullNameOf(language_.endOf(later));
  if (programEnd_.valid()) return language_.fullNameOf(*language_.findRowOf(Control::ProgramEnd));
  const bool hasSubprograms = program_.units.size() > levelCount();
  return language_.levels[level].optional && hasSubprograms ? "a subprogram" : "";
}

void UnitAssembler::endOrder(uint32_t level, std::string_view before, SourceRange range) {
  stray_.clear(); // networks between the two are misplaced only because of their order
  strayReported_ = false;
  if (isInOptional()) current_ = kNone;
  context_.diagnostics.report(diag::EndOrder, range) << language_.fullNameOf(language_.endOf(level)) << before;
}

uint32_t UnitAssembler::openSubprogram(uint32_t number, SourceRange range, SourceRange name) {
  const auto index = static_cast<uint32_t>(program_.units.size());
  const auto [at, isNew] = subprograms_.emplace(number, index);
  if (!isNew)
    context_.diagnostics.report(diag::DuplicateSubprogram, name)
            .note(program_.units[at->second].nameRange, "the first one is here")
        << language_.numbered(Control::Sp, number);
  program_.units.push_back(Unit{.kind = UnitKind::Subprogram, .number = number, .range = range, .nameRange = name});
  return index;
}

// A second subprogram begins without an SPE in between: it is nested, or the SPE of the first was forgotten. Which of
// the two is known only when the second one is closed.
void UnitAssembler::nest(SourceRange inner) {
  if (open_.back().closedInner) {
    open_.back().closedInner = false; // the SPE was forgotten: this subprogram is beside the second
  } else {
    context_.diagnostics.report(diag::NestedSubprogram, inner)
        .note(program_.units[open_.back().unit].range, "the outer one begins here");
    nestedReported_ = true;
  }
}

void UnitAssembler::beginSubprogram(Network& network) {
  leaveOptional(network.gap);
  strayReported_ = false;
  const SourceRange range = network.function.range;
  if (!open_.empty())
    nest(range);
  else if (current_ != kNone)
    misplaced_.push_back(range);
  else if (programEnd_.valid())
    stray_.push_back(range);
  const uint32_t outside = current_;
  if (network.function.params.empty() || network.function.params[0].bad) { // already reported; its number is unknown
    program_.units.push_back(Unit{.kind = UnitKind::Subprogram, .number = kNone, .range = range, .nameRange = range});
    current_ = static_cast<uint32_t>(program_.units.size()) - 1;
    incomplete_ = true;
  } else {
    const Param& number = network.function.params[0];
    current_ = openSubprogram(static_cast<uint32_t>(number.value), range, number.range);
  }
  takeSource(program_.units[current_], network);
  open_.push_back({current_, outside});
}

void UnitAssembler::endSubprogram(Network&& network) {
  if (open_.empty()) {
    if (!incomplete_)
      context_.diagnostics.report(diag::StraySpe, network.function.range)
          << language_.mnemonicOf(Control::Spe) << language_.mnemonicOf(Control::Sp);
    return;
  }
  giveBackSource(network);
  program_.units[current_].networks.push_back(std::move(network));
  current_ = open_.back().outside;
  open_.pop_back();
  if (!open_.empty()) open_.back().closedInner = true;
}

// Reports the subprogram that is still open at an end.
void UnitAssembler::closeAll() {
  if (open_.empty()) return;
  if (!nestedReported_ && !incomplete_)
    context_.diagnostics.report(diag::MissingSpe, program_.units[current_].range)
        << nameOf(language_, program_.units[current_]) << language_.mnemonicOf(Control::Spe);
  current_ = open_.front().outside;
  open_.clear();
}

bool UnitAssembler::isEmpty() const {
  return stray_.empty() && std::ranges::all_of(program_.units, [](const Unit& unit) { return unit.networks.empty(); });
}

void UnitAssembler::endOfList(SourceRange lastLine) {
  Gap rest;
  leaveOptional(rest);
  context_.gaps.giveBack(std::move(rest));
  const std::string_view last =
      (programEnd_.valid() ? *language_.findRowOf(Control::ProgramEnd) : lastEnd()).info.mnemonic;
  for (SourceRange range : stray_) context_.diagnostics.report(diag::CodeAfterEnd2, range) << last;
  if (!ends_[language_.mainLevel()].valid() && misplaced_.size() > 1)
    misplaced_.resize(1); // only the missing end is reported
  for (SourceRange range : misplaced_) context_.diagnostics.report(diag::SubprogramMisplaced, range) << last;
  closeAll();
  if (incomplete_) return;
  for (uint32_t level = 0; level < levelCount(); ++level) {
    if (ends_[level].valid() || language_.levels[level].optional) continue;
    const uint32_t later = nextEnded(level);
    const Row& end = language_.endOf(level);
    DiagBuilder report = context_.diagnostics.report(language_.levels[level].endMissing,
                                                     later == levelCount() ? lastLine : ends_[later]);
    report << language_.fullNameOf(end);
    if (level == 0 && isEmpty() && !language_.emptyNote.empty()) report.note(language_.emptyNote);
    if (level + 1 == levelCount()) continue;
    const Level& next = language_.levels[level + 1];
    report.note(next.optional
                    ? fmt::format("write `{}` after the last network of {}", language_.callOf(end),
                                  language_.levels[level].name)
                    : fmt::format("write `{}` before the first network of {}", language_.callOf(end), next.name));
  }
  const Row* end = language_.findRowOf(Control::ProgramEnd);
  if (end != nullptr && language_.needsProgramEnd && !programEnd_.valid() && ends_[language_.mainLevel()].valid())
    context_.diagnostics.report(diag::MissingEnd, lastLine) << language_.fullNameOf(*end);
}

uint32_t UnitAssembler::openLevel(uint32_t level, SourceRange module) {
  Unit& unit = program_.units[level];
  if (sawList_ || moduleOpened_[level])
    context_.diagnostics.report(diag::DuplicateModule, module) << nameOf(language_, unit);
  moduleOpened_[level] = true;
  unit.range = module;
  return level;
}

// Adds the ends. Ladder modules draw neither ends nor SP, but these count as steps when converted to commands (P1).
void UnitAssembler::finish(SourceRange anywhere) {
  for (Unit& unit : program_.units) {
    if (!unit.networks.empty() && isEnd(controlOf(unit.networks.back()))) continue;
    Network end;
    const bool placed = unit.range.valid();
    end.range = placed ? unit.range : anywhere;
    end.file = context_.sources.fileOf(end.range.begin);
    end.firstLine = end.lastLine = context_.sources.lineCol(end.range.begin).line;
    end.function.row = unit.kind == UnitKind::Level ? &language_.endOf(unit.number) : &language_.rowOf(Control::Spe);
    end.function.range = end.range;
    end.function.line = end.firstLine;
    const int steps = unit.kind == UnitKind::Subprogram ? 3 : 1; // SP and its PRM, SPE
    for (int i = 0; i < steps; ++i) countStep(context_, end.range);
    unit.networks.push_back(std::move(end));
  }
}

} // namespace rung::frontend::network

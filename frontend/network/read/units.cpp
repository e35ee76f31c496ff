// Units of a program (§1.2): Level 1, END1, Level 2, END2, subprograms.
#include <utility>

#include "frontend/network/read/units.h"

#include "ir/support/diag/gsk.h"
#include "ir/support/diag/structure.h"

namespace rung::network {

std::string nameOf(const Language& language, const Unit& unit) {
  if (unit.kind == UnitKind::Subprogram) return language.numbered(Control::Sp, unit.number);
  return std::string(language.levels[static_cast<size_t>(unit.kind)]);
}

void UnitAssembler::add(Network&& network) {
  sawList_ = true;
  if (network.incomplete) incomplete_ = true;
  switch (controlOf(network)) {
  case Control::End1: return end1(std::move(network));
  case Control::End2: return end2(std::move(network));
  case Control::Sp: return beginSubprogram(network);
  case Control::Spe: return endSubprogram(std::move(network));
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
  program_.units[kLevel2].networks.push_back(
      std::move(network)); // labels, calls and regions in it are there all the same
}

void UnitAssembler::end1(Network&& network) {
  const SourceRange range = network.function.range;
  if (sawEnd1_) {
    context_.diagnostics.report(diag::DuplicateEnd1, range) << language_.fullNameOf(Control::End1);
    return;
  }
  sawEnd1_ = true;
  if (sawEnd2_) { // what is between them is misplaced for that reason alone
    stray_.clear();
    strayReported_ = false;
    return static_cast<void>(context_.diagnostics.report(diag::EndOrder, range)
                             << language_.fullNameOf(Control::End1) << language_.fullNameOf(Control::End2));
  }
  closeAll();
  program_.units[kLevel1].networks.push_back(std::move(network));
  current_ = kLevel2;
}

void UnitAssembler::end2(Network&& network) {
  const SourceRange range = network.function.range;
  if (sawEnd2_) {
    context_.diagnostics.report(diag::DuplicateEnd2, range) << language_.fullNameOf(Control::End2);
    return;
  }
  sawEnd2_ = true;
  end2Range_ = range;
  closeAll();
  program_.units[kLevel2].networks.push_back(std::move(network));
  current_ = kNone;
}

uint32_t UnitAssembler::subprogram(uint32_t number, SourceRange range, SourceRange name) {
  const auto index = static_cast<uint32_t>(program_.units.size());
  const auto [at, isNew] = subprograms_.emplace(number, index);
  if (!isNew)
    context_.diagnostics.report(diag::DuplicateSubprogram, name)
            .note(program_.units[at->second].nameRange, "the first one is here")
        << language_.numbered(Control::Sp, number);
  program_.units.push_back(Unit{.kind = UnitKind::Subprogram, .number = number, .range = range, .nameRange = name});
  return index;
}

// Two subprograms begin without an SPE between them: one inside the other, or the SPE of the first was forgotten, which
// only shows when the second one is closed.
void UnitAssembler::nest(SourceRange inner) {
  if (open_.back().closedInner) {
    open_.back().closedInner = false; // forgotten: this one is beside the second
  } else {
    context_.diagnostics.report(diag::NestedSubprogram, inner)
        .note(program_.units[open_.back().unit].range, "the outer one begins here");
    nestedReported_ = true;
  }
}

void UnitAssembler::beginSubprogram(const Network& network) {
  strayReported_ = false;
  const SourceRange range = network.function.range;
  if (!open_.empty())
    nest(range);
  else if (current_ != kNone)
    misplaced_.push_back(range);
  const uint32_t outside = current_;
  if (network.function.params.empty() || network.function.params[0].bad) { // reported; its number is not known
    program_.units.push_back(Unit{.kind = UnitKind::Subprogram, .number = kNone, .range = range, .nameRange = range});
    current_ = static_cast<uint32_t>(program_.units.size()) - 1;
    incomplete_ = true;
  } else {
    const Param& number = network.function.params[0];
    current_ = subprogram(static_cast<uint32_t>(number.value), range, number.range);
  }
  open_.push_back({current_, outside});
}

void UnitAssembler::endSubprogram(Network&& network) {
  if (open_.empty()) {
    if (!incomplete_)
      context_.diagnostics.report(diag::StraySpe, network.function.range)
          << language_.mnemonicOf(Control::Spe) << language_.mnemonicOf(Control::Sp);
    return;
  }
  program_.units[current_].networks.push_back(std::move(network));
  current_ = open_.back().outside;
  open_.pop_back();
  if (!open_.empty()) open_.back().closedInner = true;
}

// At an end: the subprogram that is still open.
void UnitAssembler::closeAll() {
  if (!open_.empty() && !nestedReported_ && !incomplete_)
    context_.diagnostics.report(diag::MissingSpe, program_.units[current_].range)
        << nameOf(language_, program_.units[current_]) << language_.mnemonicOf(Control::Spe);
  open_.clear();
}

void UnitAssembler::endOfList(SourceRange lastLine) {
  const std::string_view end2 = language_.mnemonicOf(Control::End2);
  for (SourceRange range : stray_) context_.diagnostics.report(diag::CodeAfterEnd2, range) << end2;
  if (!sawEnd2_ && misplaced_.size() > 1) misplaced_.resize(1); // the missing END2 is the mistake
  for (SourceRange range : misplaced_) context_.diagnostics.report(diag::SubprogramMisplaced, range) << end2;
  closeAll();
  if (incomplete_) return;
  if (!sawEnd1_)
    context_.diagnostics.report(diag::MissingEnd1, sawEnd2_ ? end2Range_ : lastLine)
        << language_.fullNameOf(Control::End1);
  if (!sawEnd2_) context_.diagnostics.report(diag::MissingEnd2, lastLine) << language_.fullNameOf(Control::End2);
}

uint32_t UnitAssembler::openModule(UnitKind kind, uint32_t number, SourceRange module, SourceRange name) {
  if (kind == UnitKind::Subprogram) return subprogram(number, module, name);
  const uint32_t unit = kind == UnitKind::Level1 ? kLevel1 : kLevel2;
  if (sawList_ || moduleOpened_[unit])
    context_.diagnostics.report(diag::DuplicateModule, module) << nameOf(language_, program_.units[unit]);
  moduleOpened_[unit] = true;
  program_.units[unit].range = module;
  return unit;
}

// Ladder modules draw neither ends nor SP; converted into commands they are steps all the same (P1).
void UnitAssembler::finish(SourceRange anywhere) {
  for (Unit& unit : program_.units) {
    if (!unit.networks.empty() && isEnd(controlOf(unit.networks.back()))) continue;
    Network end;
    const bool placed = unit.range.valid();
    end.range = placed ? unit.range : anywhere;
    end.file = context_.sources.fileOf(end.range.begin);
    end.firstLine = end.lastLine = context_.sources.lineCol(end.range.begin).line;
    end.function.row = &language_.rowOf(unit.kind == UnitKind::Level1   ? Control::End1
                                        : unit.kind == UnitKind::Level2 ? Control::End2
                                                                        : Control::Spe);
    end.function.range = end.range;
    end.function.line = end.firstLine;
    const int steps = unit.kind == UnitKind::Subprogram ? 3 : 1; // SP and its PRM, SPE
    for (int i = 0; i < steps; ++i) countStep(context_, end.range);
    unit.networks.push_back(std::move(end));
  }
}

} // namespace rung::network

// Models the stack register at compile time (P11) and determines where networks begin and end.
#include "frontend/network/read/network_builder.h"

#include <iterator>

#include <fmt/format.h>

#include "ir/support/diag/operand.h"
#include "ir/support/diag/pmc.h"
#include "ir/support/diag/structure.h"

namespace rung::frontend::network {
namespace {

constexpr std::string_view kNumbers[] = {"no", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine"};

// A number of blocks as a word; never more than the stack holds.
std::string numberWord(size_t number) {
  return number < std::size(kNumbers) ? std::string(kNumbers[number]) : fmt::format("{}", number);
}

} // namespace

void NetworkBuilder::step(Place at) {
  countStep(context_, at.range);
  ++network_.steps;
}

void NetworkBuilder::write(Command command, std::string_view operand, Place at) {
  if (!context_.gaps.areKept()) return;
  Written written{command, operand, at.range, at.line};
  if (!network_.written.empty()) written.before = context_.gaps.takeComments(network_.gap);
  network_.written.push_back(std::move(written));
}

void NetworkBuilder::comment(std::string_view text) {
  if (!network_.written.empty()) network_.written.back().comment = clean(text);
}

void NetworkBuilder::begin(Place at) {
  finish();
  network_ = Network{};
  network_.file = file_;
  network_.firstLine = at.line;
  network_.range = at.range;
  network_.title = pendingTitle_;
  network_.gap = context_.gaps.take();
  pendingTitle_ = {};
  state_ = State::Logic;
  open_.clear();
  silent_ = false;
  strayReported_ = false;
  unknown_ = false;
  parameters_.clear();
  table_.clear();
}

void NetworkBuilder::extend(Place at) {
  if (network_.firstLine != at.line) pendingTitle_ = {};
  network_.lastLine = at.line;
  step(at);
}

void NetworkBuilder::stackError(Place at, std::string_view what) {
  network_.bad = true;
  if (!silent_) context_.diagnostics.report(diag::UnbalancedStack, at.range) << what;
  silent_ = true;
}

// Reports open blocks at an output: the command that joins them is missing, or the output of the first.
void NetworkBuilder::openBlocks(Place at) {
  network_.bad = true;
  if (!silent_) {
    const Language& language = context_.language;
    DiagBuilder report = context_.diagnostics.report(diag::UnbalancedStack, at.range);
    report << fmt::format("{} blocks are open here: {} or {} is missing", numberWord(depth()),
                          language.nameOf(Command::OrBlock), language.nameOf(Command::AndBlock));
    report.note(open_.back(), "the last one begins here");
  }
  silent_ = true;
}

std::string NetworkBuilder::beginsWith() const {
  return fmt::format("a network begins with {} or {}", context_.language.nameOf(Command::Load),
                     context_.language.nameOf(Command::LoadNot));
}

// A function that is not built may have an output, whatever its row says.
bool NetworkBuilder::mayHaveCoils() const {
  const Row* row = network_.function.row;
  return row == nullptr || !row->built || row->info.output != frontend::Output::None;
}

// Reports a contact or block command outside the logic of a network.
void NetworkBuilder::contactOutOfPlace(Place at) {
  if (state_ == State::Outputs || (state_ == State::Function && mayHaveCoils())) {
    network_.bad = true;
    if (!silent_) context_.diagnostics.report(diag::MultiLevelOutput, at.range);
    silent_ = true;
    state_ = State::Outputs; // no further error for the missing output
  } else {
    begin(at);
    stackError(at, fmt::format("{}; there is no value to combine with", beginsWith()));
  }
}

void NetworkBuilder::contact(Logic kind, Contact type, const Word& operand, Place at) {
  if (kind == Logic::Load) {
    if (state_ != State::Logic) begin(at);
    open_.push_back(at.range);
    if (depth() > context_.language.stackDepth) {
      network_.bad = true;
      if (!silent_) context_.diagnostics.report(diag::StackOverflow, at.range) << context_.language.stackDepth;
      silent_ = true;
    }
  } else if (state_ != State::Logic) {
    contactOutOfPlace(at);
  }
  extend(at);
  write(commandOf(kind, type), operand.text, at);
  const auto bit = readBit(context_, operand, frontend::Access::Read);
  if (bit)
    network_.logic.push_back({kind, type, *bit, at.line, at.range});
  else
    network_.bad = true;
}

void NetworkBuilder::first(Contact type, const Word& operand, Place at) {
  if (state_ == State::Logic) {
    if (!silent_)
      context_.diagnostics.report(diag::UnbalancedStack, at.range)
              .note(network_.range, "the network that begins here has no output")
          << fmt::format("{}, but values lie on the stack", beginsWith());
    silent_ = network_.bad = true;
    finish();
  }
  contact(Logic::Load, type, operand, at);
}

void NetworkBuilder::further(Contact type, const Word& operand, Place at) {
  if (state_ != State::Logic) {
    begin(at);
    stackError(at, fmt::format("{}; the stack is empty", beginsWith()));
  }
  contact(Logic::Load, type, operand, at);
}

void NetworkBuilder::block(Logic kind, Place at) {
  if (state_ != State::Logic)
    contactOutOfPlace(at);
  else if (depth() < 2)
    stackError(
        at, fmt::format("{} joins two blocks, but only one is open here", context_.language.nameOf(commandOf(kind))));
  else
    open_.pop_back();
  extend(at);
  write(commandOf(kind), {}, at);
  network_.logic.push_back({.kind = kind, .line = at.line});
}

void NetworkBuilder::coil(Coil kind, const Word& operand, Place at) {
  if (state_ == State::Idle) {
    begin(at);
    stackError(at, fmt::format("there is no value for this output; {}", beginsWith()));
  } else if (state_ == State::Logic && depth() > 1) {
    openBlocks(at);
  } else if (state_ == State::Function && !mayHaveCoils()) {
    stackError(at, fmt::format("there is no value for this output: {} has no output, and {}",
                               network_.function.row->info.mnemonic, beginsWith()));
  }
  extend(at);
  write(commandOf(kind), operand.text, at);
  const CoilTraits traits{.isSet = kind == Coil::Set, .isDue = kind == Coil::Out && state_ == State::Function};
  if (state_ != State::Function || mayHaveCoils()) state_ = State::Outputs;
  const auto bit = readBit(context_, operand, frontend::Access::Write, traits);
  if (bit)
    network_.coils.push_back({kind, *bit, at.line, at.range});
  else
    network_.bad = true;
}

// Checks that there are as many values as the function has conditions; some functions ignore a condition (P13).
void NetworkBuilder::checkConditions(const Row& row, Place at) {
  if (silent_) return;
  const auto wanted = static_cast<uint32_t>(row.info.pins.size());
  if (depth() == wanted) return;
  if (row.ignoresCondition && depth() == 1) {
    context_.diagnostics.report(diag::ConditionIgnored, network_.range) << row.info.mnemonic;
    network_.logic.clear();
    return;
  }
  std::string names;
  for (const frontend::PinInfo& pin : row.info.pins.all()) names += fmt::format(" {}", pin.name);
  DiagBuilder report = context_.diagnostics.report(diag::WrongConditionCount, at.range);
  report << row.info.mnemonic << wanted << depth();
  if (!names.empty()) report.note(fmt::format("its conditions in order:{}", names));
  if (wanted == 0 && !open_.empty())
    report.note(open_.front(), fmt::format("the network that begins here has no output, such as {}",
                                           context_.language.nameOf(Command::Out)));
  network_.bad = true;
}

void NetworkBuilder::function(const Row* row, Place at) {
  if (state_ != State::Logic) begin(at);
  extend(at);
  state_ = State::Function;
  network_.function.row = row;
  network_.function.range = at.range;
  network_.function.line = at.line;
  if (row == nullptr) {
    unknown_ = network_.bad = network_.incomplete = true;
    return;
  }
  write(Command::Function, row->info.mnemonic, at);
  if (row->built) return checkConditions(*row, at);
  context_.diagnostics.report(diag::NotBuiltYet, at.range) << row->info.mnemonic;
  network_.bad = true;
}

void NetworkBuilder::parameter(const Word& operand, Place at) {
  if (state_ == State::Function && table_.empty()) {
    extend(at);
    write(Command::Parameter, operand.text, at);
    parameters_.push_back(operand);
  } else {
    step(at);
    if (!network_.incomplete && !strayReported_)
      context_.diagnostics.report(diag::StrayParameter, at.range) << context_.language.nameOf(Command::Parameter);
    strayReported_ = true;
    functionIsLost();
  }
}

// Suppresses further errors in a network whose function line is missing.
void NetworkBuilder::functionIsLost() {
  if (state_ == State::Logic) network_.bad = network_.incomplete = silent_ = true;
}

void NetworkBuilder::tableRow(const Word& operand, Place at) {
  if (state_ == State::Function && (unknown_ || network_.function.row->hasTable)) {
    extend(at);
    write(Command::Table, operand.text, at);
    table_.push_back(operand);
  } else {
    step(at);
    if (!network_.incomplete)
      context_.diagnostics.report(diag::StrayTable, at.range)
          << context_.language.nameOf(Command::Table)
          << context_.language.mnemonicsOf([](const Row& row) { return row.hasTable; });
  }
}

void NetworkBuilder::garbage(Place at) {
  if (state_ != State::Logic) begin(at);
  extend(at);
  network_.bad = network_.incomplete = silent_ = true;
}

void NetworkBuilder::completeFunction() {
  const Row* row = network_.function.row;
  if (row == nullptr || !row->built) return; // nothing is known of its operands either
  if (row->info.output == frontend::Output::Always && state_ == State::Function && !network_.incomplete) {
    context_.diagnostics.report(diag::MissingOutput, network_.function.range) << row->info.mnemonic;
    network_.bad = true;
  }
  if (!checkFunction(context_, parameters_, table_, network_)) network_.bad = true;
}

void NetworkBuilder::finish() {
  if (state_ == State::Idle) return;
  if (state_ == State::Logic) stackError({network_.range, network_.firstLine}, "the network has no output");
  completeFunction();
  state_ = State::Idle;
  sink_(std::move(network_));
  network_ = Network{};
}

} // namespace rung::frontend::network

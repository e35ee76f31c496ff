// A program as a command list.
#include <fmt/format.h>

#include "frontend/network/convert/gap_writer.h"
#include "frontend/network/convert/writers.h"
#include "frontend/network/read/gaps.h"

namespace rung::frontend::network {
namespace {

class ListWriter {
public:
  ListWriter(const Language& language, const SourceProgram& source) : language_(language), source_(source) {}
  std::string run();

private:
  void command(const Written& command);
  void function(const Row& row, std::string_view comment = {}) {
    page_.line(commandText(language_, Command::Function, row.info.mnemonic), comment);
  }
  void begin(const Unit& unit);
  void end(const Unit& unit);
  void network(const Network& network);
  Gap afterPending(const Gap& gap) {
    pending_.insert(pending_.end(), gap.begin(), gap.end());
    return std::exchange(pending_, {});
  }
  // Something with comments before it is set apart.
  void lead(const Gap& gap) {
    if (!gap.empty()) page_.blank();
    page_.gap(gap);
  }

  const Language& language_;
  const SourceProgram& source_;
  GapPage page_{language_, Form::List};
  Gap pending_; // what the first level begins with: it has no command of its own
};

void ListWriter::command(const Written& command) {
  for (const std::string& text : command.before) page_.comment(text);
  page_.line(commandText(language_, command.command, command.operand), command.comment);
}

void ListWriter::network(const Network& network) {
  lead(tidy(protect(afterPending(network.gap), clean(network.title))));
  for (const Written& command : network.written) this->command(command);
}

void ListWriter::begin(const Unit& unit) {
  Gap gap = afterPending(unit.lead);
  if (unit.kind == UnitKind::Level && unit.number == 0) {
    pending_ = std::move(gap);
    if (!unit.comment.empty()) pending_.push_back({Item::Kind::Comment, unit.comment});
    return;
  }
  page_.blank();
  page_.gap(tidy(gap));
  if (unit.kind == UnitKind::Level) {
    function(language_.endOf(unit.number - 1), unit.comment);
  } else {
    for (const Written& command : unit.condition) this->command(command);
    function(language_.rowOf(Control::Sp), unit.comment);
    page_.line(commandText(language_, Command::Parameter, source_.sources.text(unit.nameRange)));
  }
  page_.blank();
}

void ListWriter::end(const Unit& unit) {
  const bool isLevel = unit.kind == UnitKind::Level;
  if (isLevel && unit.number + 1 != language_.levels.size()) return; // the next one begins with it
  page_.blank();
  function(isLevel ? language_.endOf(unit.number) : language_.rowOf(Control::Spe));
}

std::string ListWriter::run() {
  page_.gap(tidy(source_.preamble));
  page_.blank();
  for (const Unit& unit : source_.program.units) {
    begin(unit);
    for (const Network& network : withoutEnd(unit)) this->network(network);
    end(unit);
  }
  lead(tidy(source_.tail));
  return page_.take();
}

} // namespace

std::string writeList(const Language& language, const SourceProgram& source) {
  return ListWriter(language, source).run();
}

} // namespace rung::frontend::network

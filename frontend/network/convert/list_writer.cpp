// The source model as a command list.
#include <fmt/format.h>

#include "frontend/network/convert/gap_writer.h"
#include "frontend/network/convert/writers.h"

namespace rung::network::convert {
namespace {

class ListWriter {
public:
  explicit ListWriter(const Language& language) : language_(language) {}
  std::string run(const SourceProgram& program);

private:
  void command(const SourceCommand& command);
  void function(const Row& row, std::string_view comment = {}) {
    page_.line(commandText(language_, Command::Function, row.info.mnemonic), comment);
  }
  void begin(const SourceUnit& unit);
  void end(const SourceUnit& unit);
  void network(const SourceNetwork& network);
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
  Page page_{language_, Form::List};
  Gap pending_; // what the first level begins with: it has no command of its own
};

void ListWriter::command(const SourceCommand& command) {
  for (const std::string& text : command.before) page_.comment(text);
  page_.line(commandText(language_, command.command, command.operand), command.comment);
}

void ListWriter::network(const SourceNetwork& network) {
  lead(tidy(protect(afterPending(network.gap), network.title)));
  for (const SourceCommand& command : network.commands) this->command(command);
}

void ListWriter::begin(const SourceUnit& unit) {
  Gap gap = afterPending(unit.lead);
  if (unit.kind == UnitKind::Level && unit.level == 0) {
    pending_ = std::move(gap);
    if (!unit.comment.empty()) pending_.push_back({Item::Kind::Comment, unit.comment});
    return;
  }
  page_.blank();
  page_.gap(tidy(gap));
  if (unit.kind == UnitKind::Level) {
    function(language_.endOf(unit.level - 1), unit.comment);
  } else {
    for (const SourceCommand& command : unit.condition) this->command(command);
    function(language_.rowOf(Control::Sp), unit.comment);
    page_.line(commandText(language_, Command::Parameter, unit.number));
  }
  page_.blank();
}

void ListWriter::end(const SourceUnit& unit) {
  const bool isLevel = unit.kind == UnitKind::Level;
  if (isLevel && unit.level + 1 != language_.levels.size()) return; // the next one begins with it
  page_.blank();
  function(isLevel ? language_.endOf(unit.level) : language_.rowOf(Control::Spe));
}

std::string ListWriter::run(const SourceProgram& program) {
  page_.gap(tidy(program.preamble));
  page_.blank();
  for (const SourceUnit& unit : program.units) {
    begin(unit);
    for (const SourceNetwork& network : unit.networks) this->network(network);
    end(unit);
  }
  lead(tidy(program.tail));
  return page_.take();
}

} // namespace

std::string writeList(const Language& language, const SourceProgram& program) {
  return ListWriter(language).run(program);
}

} // namespace rung::network::convert

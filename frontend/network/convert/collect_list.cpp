// Command lists to the source model: every line that is a command is the next one of the networks that were read.
#include "frontend/network/convert/collector.h"
#include "frontend/network/read/list_reader.h"
#include "ir/support/check.h"

namespace rung::network::convert {
namespace {

class ListCollector {
public:
  ListCollector(Collector& collector, FileId file) : out_(collector), file_(file) {}

  void run() {
    LineReader lines(out_.context.sources, file_);
    for (SourceLine line; lines.next(line);) {
      splitWords(line, kListRules, words_);
      const auto statement = statementOf(words_);
      if (statement.empty())
        comment();
      else
        read(statement);
    }
    RUNG_CHECK(commands_.empty(), "the networks of a list end in it");
  }

private:
  void comment();
  void read(std::span<const Word> words);
  void command();
  void finish(const Network& network);
  void finishSubprogram();
  // The level that begins where this network ends the one before; kNone where it does not, or that was the last one.
  uint32_t levelAfter(const Network& network) const;
  // Comments of commands that have no place of their own.
  void spill(const SourceCommand& command, bool after);
  SourceUnit& unit() { return out_.program.units.back(); }

  Collector& out_;
  FileId file_;
  LineWords words_;
  std::vector<SourceCommand> commands_; // of the network under way
  std::vector<std::string> before_;
};

void ListCollector::comment() {
  if (!words_.hasComment) {
    if (commands_.empty()) out_.blank();
  } else if (!commands_.empty()) {
    before_.push_back(clean(words_.comment));
  } else {
    out_.comment(words_.comment);
  }
}

// Statements inside a network go before everything that is there: after a title they would take it away.
void ListCollector::read(std::span<const Word> words) {
  const std::optional<Command> command = findCommand(out_.context.language, words[0].text);
  const bool inside = !commands_.empty();
  if (command == Command::Dialect) return out_.statement(Item::Kind::Dialect, {}, words_.comment, inside);
  if (command == Command::Symbol) return out_.statement(Item::Kind::Symbol, words, words_.comment, inside);
  if (command == Command::Const) return out_.statement(Item::Kind::Const, words, words_.comment, inside);
  this->command();
}

void ListCollector::command() {
  RUNG_CHECK(!out_.networks.empty(), "every command belongs to a network");
  const Written& written = out_.networks.front().written[commands_.size()];
  commands_.push_back({written, std::exchange(before_, {}), clean(words_.comment)});
  if (commands_.size() == out_.networks.front().written.size()) finish(out_.takeNetwork());
}

void ListCollector::spill(const SourceCommand& command, bool after) {
  for (const std::string& text : command.before) out_.comment(text);
  if (after && !command.comment.empty()) out_.comment(command.comment);
}

uint32_t ListCollector::levelAfter(const Network& network) const {
  if (controlOf(network) != Control::LevelEnd) return kNone;
  const Language& language = out_.context.language;
  const uint32_t next = language.levelOf(*network.function.row) + 1;
  return next == language.levels.size() ? kNone : next;
}

void ListCollector::finish(const Network& network) {
  const Row* row = network.function.row;
  const Control control = controlOf(network);
  if (const uint32_t next = levelAfter(network); next != kNone) {
    spill(commands_[0], false);
    out_.program.units.push_back(
        {.kind = UnitKind::Level, .level = next, .lead = out_.takeGap(), .comment = commands_[0].comment});
  } else if (control == Control::Sp) {
    finishSubprogram();
  } else if (isEnd(control)) {
    spill(commands_[0], true);
  } else {
    unit().networks.push_back({out_.takeGap(), clean(network.title), row, network.range, std::move(commands_)});
  }
  commands_.clear();
}

void ListCollector::finishSubprogram() {
  SourceUnit next{.kind = UnitKind::Subprogram};
  for (SourceCommand& command : commands_) {
    const bool takesComment = !isLogic(command.command) && next.comment.empty();
    spill(command, !takesComment);
    if (takesComment) next.comment = command.comment;
    if (command.command == Command::Parameter) next.number = command.operand;
    if (isLogic(command.command)) next.condition.push_back({Written(command)}); // its comments are in the gap
  }
  next.lead = out_.takeGap();
  out_.program.units.push_back(std::move(next));
}

} // namespace

void collectList(Collector& collector, FileId file) {
  if (collector.program.units.empty()) collector.program.units.push_back({.kind = UnitKind::Level});
  ListCollector(collector, file).run();
}

} // namespace rung::network::convert

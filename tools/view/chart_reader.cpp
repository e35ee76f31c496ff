// Reads programs of charts (see program.h).
#include <utility>

#include "tools/view/program_builder.h"

namespace rung::view {

namespace {

using frontend::chart::Item;
using frontend::chart::ItemKind;

class ChartReader : private ProgramBuilder {
public:
  ChartReader(const SourceManager& sources, const Input& input, frontend::chart::Program charts)
      : ProgramBuilder(sources, *input.dialect, *input.analysis, *input.reference, input.authors), input_(input),
        charts_(std::move(charts)) {}

  Program run();

private:
  void read(const Item& item);
  void readRung(const frontend::chart::Rung& rung);
  void readDeclaration(const Item& item);
  Place placeOf(const Item& item) const { return {indexOf(item.file), item.line, 1}; }

  const Input& input_;
  frontend::chart::Program charts_;
  std::unordered_map<uint32_t, uint32_t> chartOf_; // by number of the rung that begins it
};

void ChartReader::readRung(const frontend::chart::Rung& rung) {
  const auto index = static_cast<uint32_t>(program_.figures.size());
  Figure figure;
  figure.number = rung.number;
  figure.title = rung.title;
  figure.comments = rung.comments;
  figure.labels = rung.labels;
  figure.place = {indexOf(rung.file), rung.line, 1};
  if (const auto chart = chartOf_.find(rung.number); chart != chartOf_.end()) figure.chart = chart->second;
  program_.figures.push_back(std::move(figure));
  Sheet sheet = buildSheet(rung, indexOf(rung.file), names_, *this);
  program_.figures[index].sheet = std::move(sheet);
  for (const frontend::TargetUse& target : rung.targets) defineTarget(target, 0, "from");
  program_.blocks.push_back({.kind = Block::Kind::Rung, .figure = index});
  endRung();
}

void ChartReader::readDeclaration(const Item& item) {
  if (item.index == frontend::chart::kNone) return declareComment(item.text);
  const frontend::Definition& definition = input_.analysis->definitions()[item.index];
  Named named = names_.of(definition);
  if (named.address == definition.name) named.address.clear();
  declare(named, definition.name, definition.isConstant(), shownComment(definition.comment));
}

void ChartReader::read(const Item& item) {
  switch (item.kind) {
  case ItemKind::File:
    if (program_.files.size() > 1)
      add(Block::Kind::File, program_.files[indexOf(item.file)].name, {}, {indexOf(item.file), 0, 0});
    return;
  case ItemKind::Module: return add(Block::Kind::Module, item.text, item.comment, placeOf(item));
  case ItemKind::Section:
    if (!item.target.scope.empty()) beginSubprogram(item.target);
    return add(Block::Kind::Section, item.text, item.comment, placeOf(item));
  case ItemKind::Comment: return add(Block::Kind::Comment, item.text, {}, placeOf(item));
  case ItemKind::Declaration: return readDeclaration(item);
  case ItemKind::Rung: return readRung(charts_.rungs[item.index]);
  case ItemKind::Sequence: program_.blocks.push_back({.kind = Block::Kind::Chart, .figure = item.index}); return;
  }
}

Program ChartReader::run() {
  for (uint32_t i = 0; i < charts_.sequences.size(); ++i) chartOf_.emplace(charts_.sequences[i].rung, i);
  for (const Item& item : charts_.items) read(item);
  for (frontend::chart::Sequence& sequence : charts_.sequences) {
    const size_t parts = sequence.parts.size();
    program_.charts.push_back({std::move(sequence), std::vector<bool>(parts, false)});
  }
  addNameTables();
  return finish();
}

} // namespace

Program readCharts(const SourceManager& sources, const Input& input, frontend::chart::Program charts) {
  return ChartReader(sources, input, std::move(charts)).run();
}

} // namespace rung::view

// Collects uses and settles links (see program_builder.h).
#include "tools/view/program_builder.h"

#include <algorithm>

namespace rung::view {

namespace {

constexpr size_t kUsesShown = 8;    // for a coil, at the right rail
constexpr size_t kWritersShown = 1; // for a contact

} // namespace

ProgramBuilder::ProgramBuilder(const SourceManager& sources, const frontend::Dialect& dialect,
                               const frontend::Analysis& analysis, const report::CrossReference& reference,
                               std::span<const FileId> files)
    : sources_(sources), names_(dialect, analysis, reference), uses_(reference), authors_(files) {
  std::vector<std::string> paths;
  for (const FileId file : files) paths.emplace_back(sources.name(file));
  program_.files = shownFiles(paths);
  program_.title = titleOf(program_.files);
  program_.control = dialect.title;
}

uint32_t ProgramBuilder::indexOf(FileId file) const {
  return static_cast<uint32_t>(std::ranges::find(authors_, file) - authors_.begin());
}

Place ProgramBuilder::placeOf(SourcePos pos) const {
  const LineCol at = sources_.lineCol(pos);
  return {indexOf(sources_.fileOf(pos)), at.line, at.column};
}

void ProgramBuilder::declare(const Named& named, std::string_view name, bool constant, std::string comment) {
  places_.emplace(declared_.size(), named.place);
  declared_.push_back({.key = named.key,
                       .constant = constant,
                       .input = named.input,
                       .output = named.output,
                       .name = std::string(name),
                       .address = named.address,
                       .comment = std::move(comment)});
}

void ProgramBuilder::beginSubprogram(const frontend::TargetUse& target) {
  subprograms_.emplace_back(program_.blocks.size(), targets_.idOf(target));
}

void ProgramBuilder::endRung() {
  if (!subprograms_.empty() && targets_.at(subprograms_.back().second).rung == 0)
    targets_.define(subprograms_.back().second, program_.figures.back().number);
}

// Until all rungs have been read, a link contains the index of its entry or target (see settleLinks).
Link ProgramBuilder::onUse(const OperandUse& use) {
  const Figure& figure = program_.figures.back();
  const uint32_t entry = uses_.add(use.named, use.operand, {figure.number, use.writes});
  if (entry == kNone) return {};
  if (use.coil) coils_.push_back({static_cast<uint32_t>(program_.figures.size() - 1), use.row, entry});
  return {Link::To::Name, entry};
}

Link ProgramBuilder::onTarget(const frontend::TargetUse& use, uint32_t row) {
  if (use.defines) {
    defineTarget(use, row, "called in");
    return {};
  }
  const uint32_t target = targets_.idOf(use);
  targets_.ask(target, program_.figures.back().number);
  return {Link::To::Rung, target};
}

void ProgramBuilder::defineTarget(const frontend::TargetUse& target, uint32_t row, std::string_view lead) {
  const uint32_t id = targets_.idOf(target);
  targets_.define(id, program_.figures.back().number);
  marks_.push_back({static_cast<uint32_t>(program_.figures.size() - 1), row, id, lead});
}

// `rungs`, which ascend, except one of them, and shortened to a maximum number.
static CrossReference shortened(std::string_view lead, const std::vector<uint32_t>& rungs, uint32_t without,
                                size_t most) {
  CrossReference found{lead, {}, 0, {}};
  for (size_t i = 0; i < rungs.size() && found.rungs.size() < most; ++i)
    if (rungs[i] != without) found.rungs.push_back(rungs[i]);
  const bool has = std::binary_search(rungs.begin(), rungs.end(), without);
  found.further = static_cast<uint32_t>(rungs.size() - found.rungs.size() - (has ? 1 : 0));
  return found;
}

void ProgramBuilder::splitUses() {
  for (const UseList::Entry& entry : uses_.entries()) {
    Sides& sides = sides_.emplace_back();
    for (const Use& use : entry.uses) (use.writes ? sides.writers : sides.readers).push_back(use.rung);
  }
}

CrossReference ProgramBuilder::readersOf(uint32_t entry) const {
  CrossReference found = shortened("read in", sides_[entry].readers, 0, kUsesShown);
  found.all = {Link::To::Name, rowIds_[entry]};
  return found;
}

CrossReference ProgramBuilder::writersOf(uint32_t entry, std::string_view lead, uint32_t without, size_t most) const {
  CrossReference found = shortened(lead, sides_[entry].writers, without, most);
  found.all = {Link::To::Name, rowIds_[entry]};
  return found;
}

CrossReference ProgramBuilder::callersOf(uint32_t target, std::string_view lead) const {
  const std::vector<uint32_t>& callers = targets_.at(target).callers;
  return {lead, callers, 0, {}};
}

// Fills rows at the right rail: for a coil, where its bit is read and where else it is written; for a target, the rungs
// that lead to it. At a contact: the rungs that write it.
void ProgramBuilder::fillRows() {
  const auto put = [this](const WaitingRow& row, CrossReference reference) {
    if (!reference.rungs.empty()) program_.figures[row.figure].sheet.rows[row.row].uses.push_back(std::move(reference));
  };
  for (const WaitingRow& coil : coils_) {
    put(coil, readersOf(coil.id));
    put(coil, writersOf(coil.id, "also written in", program_.figures[coil.figure].number, kUsesShown));
  }
  for (const WaitingRow& mark : marks_) put(mark, callersOf(mark.id, mark.lead));
  for (const auto& [block, target] : subprograms_) program_.blocks[block].callers = callersOf(target, "called in");
  for (Figure& figure : program_.figures)
    for (Cell& cell : figure.sheet.cells)
      if (cell.kind == Cell::Kind::Contact && cell.operand.link.to == Link::To::Name)
        cell.writers = writersOf(cell.operand.link.id, "\u2190", figure.number, kWritersShown);
}

// Numbers the rows with names; every entry of the uses gets its row.
void ProgramBuilder::numberRows() {
  std::unordered_map<std::string_view, uint32_t> byKey;
  uint32_t next = 0;
  for (NameTable& table : program_.tables) {
    for (NameRow& row : table.rows) {
      if (row.name.empty()) continue;
      row.id = next++;
      byKey.emplace(row.key, row.id);
    }
  }
  for (const UseList::Entry& entry : uses_.entries()) {
    const auto at = byKey.find(entry.named.key);
    rowIds_.push_back(at == byKey.end() ? kNone : at->second);
  }
}

void ProgramBuilder::settle(Link& link) const {
  if (link.to == Link::To::Nothing) return;
  link.id = link.to == Link::To::Name ? rowIds_[link.id] : targets_.at(link.id).rung;
  if (link.id == (link.to == Link::To::Name ? kNone : 0)) link = {};
}

void ProgramBuilder::settleLinks() {
  for (Figure& figure : program_.figures) {
    for (Cell& cell : figure.sheet.cells) {
      settle(cell.link);
      settle(cell.operand.link);
      for (Operand& operand : cell.operands) settle(operand.link);
    }
  }
}

void ProgramBuilder::addNameTables() {
  uses_.settle();
  std::unordered_map<std::string, bool> taken;
  for (size_t i = 0; i < declared_.size(); ++i) {
    NameRow& row = declared_[i];
    if (row.name.empty()) continue;
    taken[row.key] = true;
    if (const auto& place = places_.at(i))
      row.uses = uses_.of(*place);
    else if (const auto* entry = uses_.find(row.key))
      row.uses = entry->uses;
  }
  const bool any = std::any_of(declared_.begin(), declared_.end(), [](const NameRow& r) { return !r.name.empty(); });
  if (any) program_.tables.push_back({"Declared names", false, std::move(declared_)});
  NameTable others{"Other names and addresses", false, {}};
  for (const UseList::Entry& entry : uses_.entries()) {
    if (taken.contains(entry.named.key) || entry.named.key.starts_with("message ")) continue;
    others.rows.push_back({.key = entry.named.key,
                           .input = entry.named.input,
                           .output = entry.named.output,
                           .name = entry.name,
                           .address = entry.named.address,
                           .comment = entry.named.comment,
                           .uses = entry.uses});
  }
  std::sort(others.rows.begin(), others.rows.end(), [](const NameRow& a, const NameRow& b) { return a.name < b.name; });
  if (!others.rows.empty()) program_.tables.push_back(std::move(others));
}

Program ProgramBuilder::finish() {
  numberRows();
  splitUses();
  fillRows();
  settleLinks();
  return std::move(program_);
}

} // namespace rung::view

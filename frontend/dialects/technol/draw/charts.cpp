// Goes through the lines of the files (see charts.h).
#include "frontend/dialects/technol/draw/charts.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "frontend/dialects/technol/check/analysis.h"
#include "frontend/dialects/technol/draw/networks.h"
#include "frontend/dialects/technol/draw/steps.h"
#include "frontend/dialects/technol/lower/routine_builder.h"
#include "rtlib/text/blanks.h"

namespace rung::frontend::technol {

using chart::Item;
using chart::ItemKind;

namespace {

using LineOfFile = std::pair<uint32_t, uint32_t>;

constexpr std::string_view kRuling = "-=*#~_+";
constexpr size_t kTitle = 120; // most characters of a comment that may be a title

// A comment that is a heading: `; ---- coolant ----`.
bool isHeading(std::string_view comment) {
  const size_t end = comment.find_first_not_of(kRuling);
  return end != std::string_view::npos && end > 2;
}

std::string_view withoutRuling(std::string_view comment) {
  const std::string_view text = text::trimmed(comment);
  const size_t first = text.find_first_not_of(kRuling);
  if (first == std::string_view::npos) return {};
  if (first < 3) return text;
  return text::trimmed(text.substr(first, text.find_last_not_of(kRuling) + 1 - first));
}

class Charts {
public:
  Charts(const TypedProgram& program, const Analysis& analysis, const Trace& trace, const ir::Module& module)
      : program_(program), source_(program.source), analysis_(analysis), trace_(trace), built_(module) {}

  chart::Program run();

private:
  void numberStatements();
  void numberStatementsWithoutCode();
  void makeRungs();
  void makeSequences();
  void fill(chart::Rung& rung, std::span<const uint32_t> statements);
  bool isDrawnElsewhere(const chart::Rung& rung) const;
  void findSymbols();
  void file(uint32_t file);
  void line(uint32_t number);
  void comment(std::string_view text);
  void closeComments();
  void declarations(uint32_t line);
  void begin(const Statement& statement);
  void end(const Statement& statement);
  void heading(ItemKind kind, std::string text, const Statement& statement, TargetUse target = {});
  void rung(uint32_t line);
  void includedNames();
  void add(ItemKind kind, std::string text, std::string_view comment, uint32_t line, uint32_t index = 0) {
    made_.items.push_back({.kind = kind,
                           .text = std::move(text),
                           .comment = std::string(comment),
                           .file = source_.files[file_].id,
                           .line = line,
                           .index = index});
  }

  const TypedProgram& program_;
  const SourceProgram& source_;
  const Analysis& analysis_;
  const Trace& trace_;
  const ir::Module& built_;
  chart::Program made_;
  std::vector<uint32_t> rungs_;                      // by statement
  std::map<LineOfFile, uint32_t> numbers_;           // of the rungs that begin there
  std::map<uint32_t, uint32_t> ends_;                // by number of a rung: its last line
  std::multimap<LineOfFile, uint32_t> statementsAt_; // by line
  std::map<SourcePos, uint32_t> definitions_;        // of names in sources, by position
  std::multimap<LineOfFile, uint32_t> declared_;     // those in the program's own files, by line
  std::vector<uint32_t> symbolOfLabel_;
  std::vector<uint32_t> symbolOfProcedure_;
  std::map<uint32_t, uint32_t> modules_; // sequences of modules, by unit

  // Of the current file.
  uint32_t file_ = 0;
  ModuleKind module_ = ModuleKind::Main;
  std::string comments_;   // not used yet
  bool isHeading_ = false; // they are a heading
  uint32_t rungEnd_ = 0;   // last line of the last rung
  uint32_t lastRung_ = 0;  // its number
  bool unitEnded_ = false; // the next rung needs a heading
};

// A statement is drawn in the rung that it begins in; one that waits in the rung of its own in which it does so.
void Charts::numberStatements() {
  for (const ir::Routine& routine : built_.routines)
    for (const ir::Rung& rung : routine.rungs) {
      if (rung.number == 0) continue;
      numbers_.emplace(LineOfFile(rung.begin.file.index, rung.begin.line), rung.number);
      uint32_t& end = ends_[rung.number];
      end = std::max({end, rung.begin.line, rung.lastLine});
    }
  rungs_.resize(source_.statements.size());
  for (uint32_t i = 0; i < rungs_.size(); ++i) {
    const Statement& statement = source_.statements[i];
    const Trace::Statement& at = trace_.statements[i];
    statementsAt_.emplace(LineOfFile(statement.file, statement.line), i);
    if (!at.routine.valid()) continue;
    const auto own = numbers_.find({statement.file, statement.line});
    const bool waits = (statement.row->effects & kWaits) != 0 && own != numbers_.end();
    rungs_[i] = waits ? own->second : built_.at(at.routine).rungs[at.first].number;
  }
  numberStatementsWithoutCode();
}

// They are drawn with the statement before them.
void Charts::numberStatementsWithoutCode() {
  uint32_t before = 0;
  uint32_t file = kNone;
  for (uint32_t i = 0; i < rungs_.size(); ++i) {
    const Statement& statement = source_.statements[i];
    if (std::exchange(file, statement.file) != statement.file) before = 0;
    if (rungs_[i] != 0)
      before = rungs_[i];
    else if (statement.row != nullptr && statement.row->role == Role::NoCode)
      rungs_[i] = before;
  }
}

void Charts::findSymbols() {
  symbolOfLabel_.assign(source_.labels.size(), kNone);
  symbolOfProcedure_.assign(source_.procedures.size(), kNone);
  for (uint32_t i = 0; i < program_.symbols.all().size(); ++i) {
    const Symbol& symbol = program_.symbols[i];
    if (symbol.kind == SymbolKind::Label) symbolOfLabel_[symbol.index] = i;
    if (symbol.kind == SymbolKind::Procedure) symbolOfProcedure_[symbol.index] = i;
  }
  std::map<FileId, uint32_t> files;
  for (uint32_t i = 0; i < source_.files.size(); ++i) files.emplace(source_.files[i].id, i);
  const std::span<const Definition> definitions = analysis_.definitions();
  for (uint32_t i = 0; i < definitions.size(); ++i) {
    if (!definitions[i].range.valid() || (definitions[i].place.bits == 0 && !definitions[i].isConstant())) continue;
    const SourcePos at = definitions[i].range.begin;
    definitions_.emplace(at, i);
    if (const auto file = files.find(source_.sources.fileOf(at)); file != files.end())
      declared_.emplace(LineOfFile(file->second, source_.sources.lineCol(at).line), i);
  }
}

bool Charts::isDrawnElsewhere(const chart::Rung& rung) const {
  const auto file = std::ranges::find(source_.files, rung.file, &SourceFile::id) - source_.files.begin();
  const auto [first, end] = statementsAt_.equal_range({static_cast<uint32_t>(file), rung.line});
  return std::any_of(first, end, [&](const auto& at) { return rungs_[at.second] != 0; });
}

// Labels, uses of macros and networks.
void Charts::fill(chart::Rung& rung, std::span<const uint32_t> statements) {
  std::set<uint32_t> macros; // lines
  for (const uint32_t index : statements) {
    const Statement& statement = source_.statements[index];
    for (uint32_t i = statement.label; i < source_.labels.size() && source_.labels[i].statement == index; ++i) {
      rung.labels.emplace_back(source_.labels[i].name);
      if (symbolOfLabel_[i] != kNone)
        rung.targets.push_back(targetOf(program_.symbols, symbolOfLabel_[i], statement.range(), true));
    }
    const bool isMacro = source_.sources.fileOf(statement.pos) != source_.files[statement.file].id ||
                         source_.sources.lineCol(statement.pos).line != statement.line;
    if (!isMacro || !macros.insert(statement.line).second) continue;
    const std::string_view use = source_.sources.lineText(source_.files[statement.file].id, statement.line);
    rung.comments.emplace_back(
        fmt::format("Macro: {}", text::trimmed(use.substr(0, std::min(commentOf(use), use.size())))));
  }
  addNetworks(program_, statements, rung);
  if (!rung.nodes.empty()) return;
  // The beginning of a mechanism, the end of a module, or what a statement of another rung does after a call.
  const std::string_view line = source_.sources.lineText(rung.file, rung.line);
  const std::string_view code = text::trimmed(line.substr(0, std::min(commentOf(line), line.size())));
  const bool isOther = isDrawnElsewhere(rung);
  rung.nodes.push_back({.kind = chart::NodeKind::Box,
                        .title = std::string(code),
                        .comment = isOther ? "continued after a call" : "",
                        .line = rung.line,
                        .column = 1});
  rung.networks.push_back(0);
}

void Charts::makeRungs() {
  std::map<uint32_t, std::vector<uint32_t>> statements; // by number of the rung
  for (uint32_t i = 0; i < rungs_.size(); ++i)
    if (rungs_[i] != 0 && source_.statements[i].row->role != Role::MechBegin) statements[rungs_[i]].push_back(i);
  made_.rungs.resize(numbers_.size());
  for (const auto& [place, number] : numbers_) {
    chart::Rung& rung = made_.rungs[number - 1];
    rung.number = number;
    rung.file = source_.files[place.first].id;
    rung.line = place.second;
    const std::string_view line = source_.sources.lineText(rung.file, rung.line);
    if (const size_t at = commentOf(line); at != std::string_view::npos)
      rung.title = text::trimmed(line.substr(at + 1));
    fill(rung, statements[number]);
  }
}

// ---- items ----------------------------------------------------------------------------------------------------------

void Charts::comment(std::string_view text) {
  const bool heads = isHeading(text);
  text = withoutRuling(text);
  if (text.empty()) return;
  if (heads || isHeading_) closeComments();
  isHeading_ = heads;
  comments_.append(comments_.empty() || comments_.ends_with('\n') ? "" : "\n").append(text);
}

void Charts::closeComments() {
  while (comments_.ends_with('\n')) comments_.pop_back();
  std::string text = std::exchange(comments_, {});
  const bool heads = std::exchange(isHeading_, false);
  if (text.empty()) return;
  if (module_ == ModuleKind::Data) return add(ItemKind::Declaration, std::move(text), {}, 0, chart::kNone);
  if (heads) unitEnded_ = false;
  add(heads ? ItemKind::Section : ItemKind::Comment, std::move(text), {}, 0);
}

// The names that the line declares.
void Charts::declarations(uint32_t line) {
  const auto [first, end] = declared_.equal_range({file_, line});
  if (first == end) return;
  if (module_ == ModuleKind::Data) closeComments();
  for (auto at = first; at != end; ++at) add(ItemKind::Declaration, {}, {}, line, at->second);
}

// A single line of comment before a unit is its title.
void Charts::heading(ItemKind kind, std::string text, const Statement& statement, TargetUse target) {
  const bool single = comments_.find('\n') == std::string::npos && comments_.size() <= kTitle;
  if (single && !comments_.empty()) {
    text += ": " + std::exchange(comments_, {});
    isHeading_ = false;
  }
  closeComments();
  add(kind, std::move(text), commentAfter(source_, statement), statement.line);
  made_.items.back().target = target;
  unitEnded_ = false;
}

void Charts::begin(const Statement& statement) {
  const Unit& unit = source_.at(statement.unit);
  switch (statement.row->role) {
  case Role::Module:
    if (static_cast<ModuleKind>(statement.row->variant) == ModuleKind::Data) closeComments();
    module_ = static_cast<ModuleKind>(statement.row->variant);
    unitEnded_ = false;
    if (module_ == ModuleKind::Data) return;
    heading(ItemKind::Module, std::string(moduleName(module_)), statement);
    if (const auto found = modules_.find(statement.unit.index);
        found != modules_.end() && made_.sequences[found->second].parts.size() > 1)
      add(ItemKind::Sequence, {}, {}, statement.line, found->second);
    return;
  case Role::MechBegin: return heading(ItemKind::Section, fmt::format("Mechanism {}", unit.name), statement);
  case Role::ProcBegin:
    return heading(ItemKind::Section, fmt::format("Procedure {}", unit.name), statement,
                   targetOf(program_.symbols, symbolOfProcedure_[unit.index], statement.range(), true));
  default: return;
  }
}

void Charts::end(const Statement& statement) {
  const Role role = statement.row->role;
  if (role == Role::MechEnd || role == Role::ProcEnd) unitEnded_ = true;
  if (role != Role::ModuleEnd) return;
  closeComments();
  module_ = ModuleKind::Main;
}

void Charts::rung(uint32_t line) {
  const auto found = numbers_.find({file_, line});
  if (found == numbers_.end()) return;
  if (unitEnded_ && !isHeading_) {
    closeComments();
    add(ItemKind::Section, fmt::format("{}, continued", moduleName(module_)), {}, 0);
  }
  closeComments();
  unitEnded_ = false;
  add(ItemKind::Rung, {}, {}, line, found->second - 1);
  rungEnd_ = ends_[found->second];
  lastRung_ = found->second;
}

void Charts::line(uint32_t number) {
  const std::string_view text = source_.sources.lineText(source_.files[file_].id, number);
  const size_t at = commentOf(text);
  const std::string_view code = text::trimmed(text.substr(0, std::min(at, text.size())));
  if (code.empty() && at != std::string_view::npos) {
    const std::string_view words = text::trimmed(text.substr(at + 1));
    if (number > rungEnd_) return comment(words);
    if (!withoutRuling(words).empty()) made_.rungs[lastRung_ - 1].comments.emplace_back(withoutRuling(words));
    return;
  }
  if (code.empty() && !comments_.empty() && !isHeading_ && !comments_.ends_with("\n\n")) comments_ += '\n';
  const auto [first, last] = statementsAt_.equal_range({file_, number});
  const auto each = [&](auto act) {
    for (auto i = first; i != last; ++i)
      if (source_.statements[i->second].row != nullptr) act(source_.statements[i->second]);
  };
  each([&](const Statement& statement) { begin(statement); });
  declarations(number);
  rung(number);
  each([&](const Statement& statement) { end(statement); });
}

void Charts::file(uint32_t file) {
  file_ = file;
  rungEnd_ = 0;
  add(ItemKind::File, {}, {}, 0);
  for (uint32_t line = 1; line <= source_.sources.lineCount(source_.files[file].id); ++line) this->line(line);
  closeComments();
}

// Names of files that are included; they come after those of the program's own files.
void Charts::includedNames() {
  std::set<uint32_t> listed;
  for (const Item& item : made_.items)
    if (item.kind == ItemKind::Declaration) listed.insert(item.index);
  for (const auto& [position, definition] : definitions_)
    if (!listed.contains(definition)) add(ItemKind::Declaration, {}, {}, 0, definition);
}

void Charts::makeSequences() {
  std::vector<std::vector<uint32_t>> statements(source_.units.size());
  for (uint32_t i = 0; i < source_.statements.size(); ++i) {
    const Statement& statement = source_.statements[i];
    if (statement.row == nullptr || !statement.unit.valid()) continue;
    statements[source_.owner(statement.unit).index].push_back(i);
  }
  for (const Trace::Sequence& sequence : trace_.sequences) {
    made_.sequences.push_back(sequenceOf({program_, trace_, built_, rungs_, statements}, sequence));
    if (made_.sequences.back().rung == 0)
      modules_[sequence.unit.index] = static_cast<uint32_t>(made_.sequences.size()) - 1;
  }
}

chart::Program Charts::run() {
  numberStatements();
  findSymbols();
  makeRungs();
  makeSequences();
  for (uint32_t i = 0; i < source_.files.size(); ++i) {
    made_.files.push_back(source_.files[i].id);
    file(i);
  }
  includedNames();
  return std::move(made_);
}

} // namespace

chart::Program chartsOf(const TypedProgram& program, const Analysis& analysis, const Trace& trace,
                        const ir::Module& module) {
  return Charts(program, analysis, trace, module).run();
}

} // namespace rung::frontend::technol

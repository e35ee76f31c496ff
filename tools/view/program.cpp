// Combines the lines of the files with the parser's result, and collects the uses of each name.
#include "tools/view/program.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <unordered_map>

#include "frontend/ladder/text/drawing.h"
#include "frontend/network/address.h"
#include "frontend/network/read/canonical.h"
#include "ir/support/allowance.h"
#include "ir/support/check.h"
#include "rtlib/text/blanks.h"
#include "rtlib/text/letters.h"
#include "tools/view/names.h"
#include "tools/view/sheet_builder.h"

namespace rung::view {

namespace {

using frontend::ladder::Declaration;
using frontend::ladder::DeclarationKind;
using frontend::ladder::LadderFile;
using frontend::ladder::StatementKind;

constexpr size_t kUsesShown = 8;    // for a coil, at the right rail
constexpr size_t kWritersShown = 1; // for a contact
constexpr size_t kTitle = 120;      // most characters of a comment that may be a title

// Without the rulings with which authors frame comments, `--- inputs -------`.
std::string_view plain(std::string_view text) {
  constexpr std::string_view kRuling = "-=*#~_+";
  const auto isRuling = [&](std::string_view run) { return run.size() > 2; };
  const size_t first = std::min(text.find_first_not_of(kRuling), text.size());
  if (isRuling(text.substr(0, first))) text.remove_prefix(first);
  const size_t last = text.find_last_not_of(kRuling);
  const size_t end = last == std::string_view::npos ? 0 : last + 1;
  if (isRuling(text.substr(end))) text = text.substr(0, end);
  return text::trimmed(text);
}

// A message number without leading zeros.
std::string plainNumber(std::string_view text) {
  const size_t first = text.find_first_not_of('0');
  return first == std::string_view::npos ? "0" : std::string(text.substr(first));
}

constexpr uint32_t kNone = UINT32_MAX;

// The uses of each name, in the order of first use.
class UseList {
public:
  struct Entry {
    std::string name; // as first written
    Named named;
    std::vector<Use> uses;
  };

  explicit UseList(const report::CrossReference& reference) : index_(reference) {}

  // The index of the entry; kNone if the name is not listed.
  uint32_t add(const Named& named, std::string_view name, Use use) {
    if (named.key.empty()) return kNone;
    const auto [at, fresh] = byKey_.emplace(named.key, static_cast<uint32_t>(entries_.size()));
    if (fresh) entries_.push_back({std::string(name), named, {}});
    if (named.place) index_.add(*named.place, use);
    std::vector<Use>& uses = entries_[at->second].uses;
    // A rung occurs at most twice: as reader and as writer.
    if (std::find(uses.rbegin(), uses.rbegin() + std::min<ptrdiff_t>(2, std::ssize(uses)), use) ==
        uses.rbegin() + std::min<ptrdiff_t>(2, std::ssize(uses)))
      uses.push_back(use);
    return at->second;
  }
  // Called once all uses are added: adds the uses of a place by other operands, and by none.
  void settle() {
    for (Entry& entry : entries_)
      if (entry.named.place) entry.uses = index_.of(*entry.named.place);
  }
  // Uses of a place, whether an operand names it or not. Valid after settle().
  std::vector<Use> of(const ir::BitRange& place) { return index_.of(place); }
  const Entry* find(const std::string& key) const {
    const auto at = byKey_.find(key);
    return at == byKey_.end() ? nullptr : &entries_[at->second];
  }
  const std::vector<Entry>& entries() const { return entries_; }

private:
  UseIndex index_;
  std::unordered_map<std::string, uint32_t> byKey_;
  std::vector<Entry> entries_;
};

// A row at the right rail for the rungs that use a coil or lead to a target; they are not known before the last rung.
struct WaitingRow {
  uint32_t figure = 0;
  uint32_t row = 0;
  uint32_t id = 0; // of the coil's entry, or of the target
};

// The rungs that read and write an entry.
struct Sides {
  std::vector<uint32_t> readers;
  std::vector<uint32_t> writers;
};

class Reader : private SheetListener {
public:
  Reader(const SourceManager& sources, const Input& input)
      : sources_(sources), input_(input), language_(input.language),
        names_(*input.dialect, *input.analysis, *input.reference), uses_(*input.reference) {}
  Program run();

private:
  void readTexts();
  void readFile(const LadderFile& file);
  void readStatement(const LadderFile& file, const frontend::ladder::Statement& statement);
  void readDeclaration(const Declaration& declaration);
  void readRung(const LadderFile& file, const frontend::ladder::Rung& rung, std::string_view remark);
  bool isHint(std::string_view text) const;
  void comment(std::string_view text);
  void flushComments(const Place& place);
  Link onUse(const OperandUse& use) override;
  Link onTarget(const frontend::TargetUse& target, uint32_t row) override;
  void beginModule(const frontend::ladder::Module& module, std::string_view remark, const Place& place);
  void titleFromSection(Block& block, const frontend::ladder::Module& module);
  void titleFromSymbol(Block& block, std::string_view subprogram) const;
  void splitUses();
  CrossReference readersOf(uint32_t entry) const;
  CrossReference writersOf(uint32_t entry, std::string_view lead, uint32_t without, size_t most) const;
  CrossReference callersOf(uint32_t target) const;
  void fillRows();
  void numberRows();
  void settle(Link& link) const;
  void settleLinks();
  void addNameTables();
  std::string keyOfMessage(std::string_view name) const;
  void addMessageTable(DeclarationKind kind, std::string_view title);
  void add(Block::Kind kind, std::string text, std::string_view remark, const Place& place) {
    program_.blocks.push_back({.kind = kind, .text = std::move(text), .comment = std::string(remark), .place = place});
  }
  void nameFiles();
  uint32_t indexOf(FileId file) const;
  Place placeOf(const LadderFile& file, uint32_t line) const;
  Place placeOf(SourcePos pos) const;
  Place placeOfRung(const LadderFile& file, const frontend::ladder::Rung& rung) const;
  Place placeOfElement(SourcePos drawn) const;
  bool converted() const { return input_.files != input_.authors; }

  const SourceManager& sources_;
  const Input& input_;
  const frontend::network::Language* const language_; // null: not a program of networks
  std::vector<LadderFile> files_;
  Names names_;
  Texts texts_;
  Program program_;
  UseList uses_;
  Targets targets_;
  std::vector<WaitingRow> coils_;
  std::vector<WaitingRow> marks_;                          // rows of targets
  std::vector<std::pair<uint32_t, uint32_t>> subprograms_; // of networks: index of the block, target
  std::vector<Sides> sides_;                               // by entry of uses_
  std::vector<uint32_t> rowIds_;                           // by entry of uses_
  std::vector<NameRow> declared_;
  std::map<size_t, std::optional<ir::BitRange>> places_; // of those with a name

  // Of the current file.
  std::string comments_; // comments not used yet
};

// NCT numbers message texts; in programs of networks 8 x byte + bit + 1 is the bit of A that requests one.
void Reader::readTexts() {
  if (language_ == nullptr) {
    for (const LadderFile& file : files_)
      for (const Declaration& declaration : file.declarations)
        if (declaration.kind == DeclarationKind::Message)
          texts_.emplace(plainNumber(declaration.name.text), declaration.value.text);
    return;
  }
  for (const ir::MessageText& message : input_.messages) {
    const uint32_t bit = message.number - 1;
    texts_.emplace(fmt::format("A{}.{}", bit / 8, bit % 8), message.text);
  }
}

void Reader::nameFiles() {
  std::vector<std::string> paths;
  for (FileId file : input_.authors) paths.emplace_back(sources_.name(file));
  program_.files = shownFiles(paths);
  program_.title = titleOf(program_.files);
}

uint32_t Reader::indexOf(FileId file) const {
  const auto at = std::find(input_.authors.begin(), input_.authors.end(), file);
  return static_cast<uint32_t>(at - input_.authors.begin());
}

Place Reader::placeOf(const LadderFile& file, uint32_t line) const {
  if (converted()) return {};
  return {indexOf(file.file), line, 1};
}

Place Reader::placeOf(SourcePos pos) const {
  const LineCol at = sources_.lineCol(pos);
  return {indexOf(sources_.fileOf(pos)), at.line, at.column};
}

Place Reader::placeOfRung(const LadderFile& file, const frontend::ladder::Rung& rung) const {
  if (!converted()) return placeOf(file, rung.firstLine);
  return placeOf(input_.origins.rungs[program_.figures.size()].begin);
}

Place Reader::placeOfElement(SourcePos drawn) const {
  if (!converted()) return placeOf(drawn);
  const auto elements = input_.origins.elements;
  const auto at = std::lower_bound(elements.begin(), elements.end(), drawn,
                                   [](const frontend::network::Origin& one, SourcePos pos) { return one.drawn < pos; });
  return at == elements.end() || at->drawn != drawn ? Place{} : placeOf(at->written);
}

// A hint that a conversion writes for what only a command list can express is not a comment of the author.
bool Reader::isHint(std::string_view text) const {
  return converted() && frontend::network::parseBlocksHint(*language_, text);
}

void Reader::comment(std::string_view text) {
  if (isHint(text)) return;
  text = plain(text);
  if (!text.empty()) comments_.append(text).push_back('\n');
}

void Reader::flushComments(const Place& place) {
  while (comments_.ends_with('\n')) comments_.pop_back();
  if (!comments_.empty()) add(Block::Kind::Comment, std::move(comments_), {}, place);
  comments_.clear();
}

void Reader::readDeclaration(const Declaration& declaration) {
  for (size_t at = 0; at < comments_.size();) {
    const size_t end = comments_.find('\n', at);
    if (end > at) declared_.push_back({.comment = comments_.substr(at, end - at)});
    at = end + 1;
  }
  comments_.clear();
  if (frontend::ladder::holdsText(declaration.kind)) return;
  const Named named = names_.find(declaration.name);
  places_.emplace(declared_.size(), named.place);
  declared_.push_back({.key = named.key,
                       .constant = declaration.kind == DeclarationKind::Const,
                       .input = named.input,
                       .output = named.output,
                       .name = std::string(declaration.name.text),
                       .address = named.address,
                       .comment = withoutAllowances(declaration.comment)});
}

void Reader::readRung(const LadderFile& file, const frontend::ladder::Rung& rung, std::string_view remark) {
  const auto index = static_cast<uint32_t>(program_.figures.size());
  Figure figure;
  figure.number = index + 1;
  figure.title = rung.comment;
  figure.place = placeOfRung(file, rung);
  if (!remark.empty()) figure.comments.emplace_back(remark);
  for (const frontend::ladder::Comment& comment : rung.comments)
    if (comment.alone && !isHint(comment.text)) figure.comments.emplace_back(comment.text);
  const frontend::ladder::Drawing drawing =
      frontend::ladder::readDrawing(sources_, file.file, rung, input_.dialect->findBox);
  const auto placeOf = [this](SourcePos drawn) { return placeOfElement(drawn); };
  program_.figures.push_back(std::move(figure));
  Sheet sheet = buildSheet({input_.dialect->findBox, names_, texts_, placeOf, language_ != nullptr}, drawing, *this);
  program_.figures[index].sheet = std::move(sheet);
  program_.blocks.push_back({.kind = Block::Kind::Rung, .figure = index});
  if (!subprograms_.empty() && targets_.at(subprograms_.back().second).rung == 0)
    targets_.define(subprograms_.back().second, program_.figures[index].number);
}

// Until all rungs have been read, a link contains the index of its entry or target (see settleLinks).
Link Reader::onUse(const OperandUse& use) {
  const Figure& figure = program_.figures.back();
  const uint32_t entry = uses_.add(use.named, use.operand, {figure.number, use.writes});
  if (entry == kNone) return {};
  if (use.coil) coils_.push_back({static_cast<uint32_t>(program_.figures.size() - 1), use.row, entry});
  return {Link::To::Name, entry};
}

Link Reader::onTarget(const frontend::TargetUse& use, uint32_t row) {
  const uint32_t number = program_.figures.back().number;
  const uint32_t target = targets_.idOf(use);
  if (!use.defines) {
    targets_.ask(target, number);
    return {Link::To::Rung, target};
  }
  targets_.define(target, number);
  marks_.push_back({static_cast<uint32_t>(program_.figures.size() - 1), row, target});
  return {};
}

// "5: overrides" before "SUB P5" becomes "overrides"; so does "P5: overrides".
std::string_view withoutName(std::string_view title, std::string_view name) {
  const size_t colon = title.find(':');
  if (colon == std::string_view::npos) return title;
  const auto letters = [](std::string_view text) {
    std::string result;
    for (char c : text)
      if (c != ' ') result += text::upper(c);
    return result;
  };
  const std::string said = letters(title.substr(0, colon));
  const std::string whole = letters(name);
  return !said.empty() && whole.ends_with(said) ? text::trimmed(title.substr(colon + 1)) : title;
}

// A drawing does not have the ends of levels and subprograms: "END OF P1" above SPE comes before the next subprogram.
bool isOfEnd(std::string_view comment) { return text::equalsIgnoringCase(comment.substr(0, comment.find(' ')), "END"); }

// The section just before a module, or the last line of comment before a subprogram of networks, becomes its title.
// That section is not listed separately then. Comments before a level describe the program.
void Reader::titleFromSection(Block& block, const frontend::ladder::Module& module) {
  if (program_.blocks.empty()) return;
  const Block& before = program_.blocks.back();
  if (before.kind == Block::Kind::Section) {
    block.title = withoutName(before.text, block.text);
    if (block.comment.empty()) block.comment = before.comment;
    program_.blocks.pop_back();
  } else if (before.kind == Block::Kind::Comment && language_ != nullptr && module.name.size() == 2) {
    const std::string_view line = std::string_view(before.text).substr(before.text.find_last_of('\n') + 1);
    if (line.size() <= kTitle && !isOfEnd(line)) block.title = withoutName(line, block.text);
  }
}

void Reader::titleFromSymbol(Block& block, std::string_view subprogram) const {
  for (const LadderFile& file : files_)
    for (const Declaration& declaration : file.declarations)
      if (declaration.kind == DeclarationKind::Symbol && text::equalsIgnoringCase(declaration.value.text, subprogram)) {
        block.title = declaration.name.text;
        if (block.comment.empty()) block.comment = withoutAllowances(declaration.comment);
        return;
      }
}

void Reader::beginModule(const frontend::ladder::Module& module, std::string_view remark, const Place& place) {
  std::string name;
  for (const frontend::Word& word : module.name) name.append(name.empty() ? "" : " ").append(word.text);
  Block block{.kind = Block::Kind::Module, .text = name, .comment = std::string(remark), .place = place};
  titleFromSection(block, module);
  if (language_ == nullptr) {
    block.text = "Module " + name;
  } else if (const frontend::TargetUse* subprogram = names_.targetAt(module.name.back())) {
    block.text = fmt::format("Subprogram {}", module.name.back().text);
    if (block.title.empty()) titleFromSymbol(block, module.name.back().text);
    subprograms_.emplace_back(program_.blocks.size(), targets_.idOf(*subprogram));
  } else if (const auto level = language_->findLevel(name)) {
    block.text = fmt::format("Level {}", *level + 1);
  }
  program_.blocks.push_back(std::move(block));
}

void Reader::readStatement(const LadderFile& file, const frontend::ladder::Statement& statement) {
  switch (statement.kind) {
  case StatementKind::Comment: return comment(file.comments[statement.index].text);
  case StatementKind::Blank:
    if (!comments_.empty() && !comments_.ends_with("\n\n")) comments_.push_back('\n');
    return;
  case StatementKind::Declaration: return readDeclaration(file.declarations[statement.index]);
  case StatementKind::Dialect:
    if (!statement.comment.empty()) comment(statement.comment);
    break;
  case StatementKind::Module:
  case StatementKind::Section:
  case StatementKind::Rung: break;
  }
  const Place place = placeOf(file, statement.line);
  flushComments(place);
  if (statement.kind == StatementKind::Module)
    beginModule(file.modules[statement.index], statement.comment, place);
  else if (statement.kind == StatementKind::Section)
    add(Block::Kind::Section, std::string(file.sections[statement.index].title.text), statement.comment, place);
  else if (statement.kind == StatementKind::Rung)
    readRung(file, file.rungs[statement.index], statement.comment);
}

void Reader::readFile(const LadderFile& file) {
  comments_.clear();
  if (input_.files.size() > 1)
    add(Block::Kind::File, program_.files[indexOf(file.file)].name, {}, {indexOf(file.file), 0, 0});
  for (const frontend::ladder::Statement& statement : file.statements) readStatement(file, statement);
  flushComments({});
}

// `rungs`, which ascend, except one of them, and shortened to a maximum number.
CrossReference shortened(std::string_view lead, const std::vector<uint32_t>& rungs, uint32_t without, size_t most) {
  CrossReference found{lead, {}, 0, {}};
  for (size_t i = 0; i < rungs.size() && found.rungs.size() < most; ++i)
    if (rungs[i] != without) found.rungs.push_back(rungs[i]);
  const bool has = std::binary_search(rungs.begin(), rungs.end(), without);
  found.further = static_cast<uint32_t>(rungs.size() - found.rungs.size() - (has ? 1 : 0));
  return found;
}

void Reader::splitUses() {
  for (const UseList::Entry& entry : uses_.entries()) {
    Sides& sides = sides_.emplace_back();
    for (const Use& use : entry.uses) (use.writes ? sides.writers : sides.readers).push_back(use.rung);
  }
}

CrossReference Reader::readersOf(uint32_t entry) const {
  CrossReference found = shortened("read in", sides_[entry].readers, 0, kUsesShown);
  found.all = {Link::To::Name, rowIds_[entry]};
  return found;
}

CrossReference Reader::writersOf(uint32_t entry, std::string_view lead, uint32_t without, size_t most) const {
  CrossReference found = shortened(lead, sides_[entry].writers, without, most);
  found.all = {Link::To::Name, rowIds_[entry]};
  return found;
}

CrossReference Reader::callersOf(uint32_t target) const {
  const std::vector<uint32_t>& callers = targets_.at(target).callers;
  return {"called in", callers, 0, {}};
}

// Fills rows at the right rail: for a coil, where its bit is read and where else it is written; for a target, the rungs
// that lead to it. At a contact: the rungs that write it.
void Reader::fillRows() {
  const auto put = [this](const WaitingRow& row, CrossReference reference) {
    if (!reference.rungs.empty()) program_.figures[row.figure].sheet.rows[row.row].uses.push_back(std::move(reference));
  };
  for (const WaitingRow& coil : coils_) {
    put(coil, readersOf(coil.id));
    put(coil, writersOf(coil.id, "also written in", program_.figures[coil.figure].number, kUsesShown));
  }
  for (const WaitingRow& mark : marks_) put(mark, callersOf(mark.id));
  for (const auto& [block, target] : subprograms_) program_.blocks[block].callers = callersOf(target);
  for (Figure& figure : program_.figures)
    for (Cell& cell : figure.sheet.cells)
      if (cell.kind == Cell::Kind::Contact && cell.operand.link.to == Link::To::Name)
        cell.writers = writersOf(cell.operand.link.id, "\u2190", figure.number, kWritersShown);
}

// Numbers the rows with names; every entry of the uses gets its row.
void Reader::numberRows() {
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

void Reader::settle(Link& link) const {
  if (link.to == Link::To::Nothing) return;
  link.id = link.to == Link::To::Name ? rowIds_[link.id] : targets_.at(link.id).rung;
  if (link.id == (link.to == Link::To::Name ? kNone : 0)) link = {};
}

void Reader::settleLinks() {
  for (Figure& figure : program_.figures) {
    for (Cell& cell : figure.sheet.cells) {
      settle(cell.link);
      settle(cell.operand.link);
      for (Operand& operand : cell.operands) settle(operand.link);
    }
  }
}

// NCT numbers messages; programs of networks give each a bit.
std::string Reader::keyOfMessage(std::string_view name) const {
  if (language_ == nullptr) return messageKey(plainNumber(name));
  const auto text = frontend::network::splitAddress(*language_, name);
  if (!text || text->bit.size() != 1) return {};
  const frontend::network::Address bit{text->area, static_cast<uint32_t>(text->byte),
                                       static_cast<uint8_t>(text->bit[0] - '0'), true};
  return frontend::network::textOf(*language_, bit);
}

void Reader::addMessageTable(DeclarationKind kind, std::string_view title) {
  NameTable table{std::string(title), true, {}};
  for (const LadderFile& file : files_) {
    for (const Declaration& declaration : file.declarations) {
      if (declaration.kind != kind) continue;
      NameRow row{.name = std::string(declaration.name.text),
                  .address = std::string(declaration.value.text),
                  .comment = std::string(declaration.comment)};
      if (kind == DeclarationKind::Message) row.key = keyOfMessage(declaration.name.text);
      if (const auto* entry = uses_.find(row.key)) row.uses = entry->uses;
      table.rows.push_back(std::move(row));
    }
  }
  if (!table.rows.empty()) program_.tables.push_back(std::move(table));
}

void Reader::addNameTables() {
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

Program Reader::run() {
  Diagnostics discarded; // reported when the program was compiled
  for (FileId file : input_.files)
    files_.push_back(frontend::ladder::parseLadder(sources_, file, discarded, input_.dialect->findBox));
  nameFiles();
  RUNG_CHECK(!discarded.hasErrors(), "the program has been compiled");
  program_.control = input_.dialect->title;
  readTexts();
  for (const LadderFile& file : files_) readFile(file);
  uses_.settle();
  addNameTables();
  addMessageTable(DeclarationKind::Message, "Messages");
  addMessageTable(DeclarationKind::Button, "Function buttons");
  numberRows();
  splitUses();
  fillRows();
  settleLinks();
  return std::move(program_);
}

} // namespace

std::vector<SourceFile> shownFiles(const std::vector<std::string>& paths) {
  const auto baseOf = [](const std::string& path) { return path.substr(path.find_last_of('/') + 1); };
  std::map<std::string, int> known;
  for (const std::string& path : paths) ++known[baseOf(path)];
  std::vector<SourceFile> files;
  for (const std::string& path : paths) files.push_back({path, known[baseOf(path)] > 1 ? path : baseOf(path)});
  return files;
}

// A single file gives the title; several files are usually in a separate folder.
std::string titleOf(const std::vector<SourceFile>& files) {
  if (files.size() == 1) return files[0].name;
  const auto folderOf = [](const std::string& path) { return path.substr(0, path.find_last_of('/') + 1); };
  const std::string folder = folderOf(files[0].path);
  const bool same =
      std::all_of(files.begin(), files.end(), [&](const SourceFile& file) { return folderOf(file.path) == folder; });
  if (!same || folder.size() < 2) return fmt::format("{} and {} more", files[0].name, files.size() - 1);
  const size_t begin = folder.find_last_of('/', folder.size() - 2) + 1; // 0 without another '/'
  return folder.substr(begin, folder.size() - 1 - begin);
}

Program readProgram(const SourceManager& sources, const Input& input) { return Reader(sources, input).run(); }

namespace {

using Kind = ContentsEntry::Kind;

class Collector {
public:
  explicit Collector(const Program& program) : program_(program) {}

  std::vector<ContentsEntry> run() {
    for (uint32_t i = 0; i < program_.blocks.size(); ++i) add(i);
    close(0);
    return std::move(entries_);
  }

private:
  void add(uint32_t index);
  void open(Kind kind, uint32_t index, const std::string& title);
  // Closes the open entries of this rank and below.
  void close(uint32_t rank) {
    while (!open_.empty() && rankOf(entries_[open_.back()].kind) >= rank) open_.pop_back();
  }
  static uint32_t rankOf(Kind kind) { return static_cast<uint32_t>(kind); }

  const Program& program_;
  std::vector<ContentsEntry> entries_;
  std::vector<size_t> open_; // entries that contain the next one
};

void Collector::open(Kind kind, uint32_t index, const std::string& title) {
  const Block& block = program_.blocks[index];
  const bool first = !entries_.empty() && entries_.back().kind == Kind::File && entries_.back().firstRung == 0;
  if (kind == Kind::Module && first) { // most files consist of one module
    entries_.back().title = block.text + (title.empty() ? "" : ": " + title);
    return;
  }
  close(rankOf(kind));
  const auto level = static_cast<uint32_t>(open_.size());
  open_.push_back(entries_.size());
  entries_.push_back({kind, index, level, block.text, title, 0, 0});
}

void Collector::add(uint32_t index) {
  const Block& block = program_.blocks[index];
  switch (block.kind) {
  case Block::Kind::Comment: return;
  case Block::Kind::File: return open(Kind::File, index, block.comment);
  case Block::Kind::Module: return open(Kind::Module, index, block.title.empty() ? block.comment : block.title);
  case Block::Kind::Section: return open(Kind::Section, index, block.comment);
  case Block::Kind::Rung: break;
  }
  const uint32_t number = program_.figures[block.figure].number;
  for (size_t entry : open_) {
    if (entries_[entry].firstRung == 0) entries_[entry].firstRung = number;
    entries_[entry].lastRung = number;
  }
}

} // namespace

std::vector<ContentsEntry> contentsOf(const Program& program) { return Collector(program).run(); }

} // namespace rung::view

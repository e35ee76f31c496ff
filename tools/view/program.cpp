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
#include "ir/support/check.h"
#include "rtlib/text/blanks.h"
#include "rtlib/text/letters.h"
#include "tools/view/names.h"
#include "tools/view/program_builder.h"
#include "tools/view/sheet_builder.h"

namespace rung::view {

namespace {

using frontend::ladder::Declaration;
using frontend::ladder::DeclarationKind;
using frontend::ladder::LadderFile;
using frontend::ladder::StatementKind;

constexpr size_t kTitle = 120; // most characters of a comment that may be a title

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

class Reader : private ProgramBuilder {
public:
  Reader(const SourceManager& sources, const Input& input)
      : ProgramBuilder(sources, *input.dialect, *input.analysis, *input.reference, input.authors), input_(input),
        language_(input.language) {}
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
  void beginModule(const frontend::ladder::Module& module, std::string_view remark, const Place& place);
  void titleFromSection(Block& block, const frontend::ladder::Module& module);
  std::string keyOfMessage(std::string_view name) const;
  void addMessageTable(DeclarationKind kind, std::string_view title);
  Place placeOf(const LadderFile& file, uint32_t line) const;
  Place placeOfRung(const LadderFile& file, const frontend::ladder::Rung& rung) const;
  Place placeOfElement(SourcePos drawn) const;
  bool converted() const { return input_.files != input_.authors; }

  const Input& input_;
  const frontend::network::Language* const language_; // null: not a program of networks
  std::vector<LadderFile> files_;
  Texts texts_;
  std::string comments_; // of the current file, not used yet
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

Place Reader::placeOf(const LadderFile& file, uint32_t line) const {
  if (converted()) return {};
  return {indexOf(file.file), line, 1};
}

Place Reader::placeOfRung(const LadderFile& file, const frontend::ladder::Rung& rung) const {
  if (!converted()) return placeOf(file, rung.firstLine);
  return ProgramBuilder::placeOf(input_.origins.rungs[program_.figures.size()].begin);
}

Place Reader::placeOfElement(SourcePos drawn) const {
  if (!converted()) return ProgramBuilder::placeOf(drawn);
  const auto elements = input_.origins.elements;
  const auto at = std::lower_bound(elements.begin(), elements.end(), drawn,
                                   [](const frontend::network::Origin& one, SourcePos pos) { return one.drawn < pos; });
  return at == elements.end() || at->drawn != drawn ? Place{} : ProgramBuilder::placeOf(at->written);
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
    if (end > at) declareComment(comments_.substr(at, end - at));
    at = end + 1;
  }
  comments_.clear();
  if (frontend::ladder::holdsText(declaration.kind)) return;
  declare(names_.find(declaration.name), declaration.name.text, declaration.kind == DeclarationKind::Const,
          shownComment(declaration.comment));
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
  endRung();
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

void Reader::beginModule(const frontend::ladder::Module& module, std::string_view remark, const Place& place) {
  std::string name;
  for (const frontend::Word& word : module.name) name.append(name.empty() ? "" : " ").append(word.text);
  Block block{.kind = Block::Kind::Module, .text = name, .comment = std::string(remark), .place = place};
  titleFromSection(block, module);
  if (language_ == nullptr) {
    block.text = "Module " + name;
  } else if (const frontend::TargetUse* subprogram = names_.targetAt(module.name.back())) {
    block.text = fmt::format("Subprogram {}", module.name.back().text);
    beginSubprogram(*subprogram);
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

Program Reader::run() {
  Diagnostics discarded; // reported when the program was compiled
  for (FileId file : input_.files)
    files_.push_back(frontend::ladder::parseLadder(sources_, file, discarded, input_.dialect->findBox));
  RUNG_CHECK(!discarded.hasErrors(), "the program has been compiled");
  readTexts();
  for (const LadderFile& file : files_) readFile(file);
  addNameTables();
  addMessageTable(DeclarationKind::Message, "Messages");
  addMessageTable(DeclarationKind::Button, "Function buttons");
  return finish();
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
  case Block::Kind::Comment:
  case Block::Kind::Chart: return;
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

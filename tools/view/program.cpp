// Reads the lines of the files beside what the parser found in them, and gathers who uses which name.
#include "tools/view/program.h"

#include <algorithm>
#include <charconv>
#include <map>
#include <memory>
#include <unordered_map>

#include <fmt/format.h>

#include "frontend/dialects/gsk/canonical.h"
#include "frontend/ladder/drawing.h"
#include "ir/support/check.h"
#include "tools/view/names.h"
#include "tools/view/sheet_builder.h"

namespace rung::view {
namespace {

using ladder::Declaration;
using ladder::DeclarationKind;
using ladder::LadderFile;
using ladder::StatementKind;

constexpr size_t kUsesShown = 8; // of a coil, at the right rail

std::string_view trimmed(std::string_view text) {
  const size_t first = text.find_first_not_of(' ');
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(' ') - first + 1);
}

// Without the ruling lines that authors frame comments with, `--- inputs -------`.
std::string_view plain(std::string_view text) {
  constexpr std::string_view kRuling = "-=*#~_+";
  const auto isRuling = [&](std::string_view run) { return run.size() > 2; };
  const size_t first = std::min(text.find_first_not_of(kRuling), text.size());
  if (isRuling(text.substr(0, first))) text.remove_prefix(first);
  const size_t last = text.find_last_not_of(kRuling);
  const size_t end = last == std::string_view::npos ? 0 : last + 1;
  if (isRuling(text.substr(end))) text = text.substr(0, end);
  return trimmed(text);
}

// A number as messages are counted by, without leading zeros.
std::string plainNumber(std::string_view text) {
  const size_t first = text.find_first_not_of('0');
  return first == std::string_view::npos ? "0" : std::string(text.substr(first));
}

// What is used where, in the order of the first use.
class UseList {
public:
  struct Entry {
    std::string name; // as first written
    Named named;
    std::vector<Use> uses;
  };

  void add(const Named& named, std::string_view name, Use use) {
    if (named.key.empty()) return;
    const auto [at, fresh] = byKey_.emplace(named.key, static_cast<uint32_t>(entries_.size()));
    if (fresh) entries_.push_back({std::string(name), named, {}});
    std::vector<Use>& uses = entries_[at->second].uses;
    // A rung comes twice at most: it reads and writes.
    const auto same = [&](const Use& one) { return one.rung == use.rung && one.writes == use.writes; };
    if (!std::any_of(uses.rbegin(), uses.rbegin() + std::min<ptrdiff_t>(2, std::ssize(uses)), same))
      uses.push_back(use);
  }
  const Entry* find(const std::string& key) const {
    const auto at = byKey_.find(key);
    return at == byKey_.end() ? nullptr : &entries_[at->second];
  }
  const std::vector<Entry>& entries() const { return entries_; }

private:
  std::unordered_map<std::string, uint32_t> byKey_;
  std::vector<Entry> entries_;
};

// A coil at the right rail, whose users are not known before the last rung.
struct CoilRow {
  uint32_t figure = 0;
  uint32_t row = 0;
  std::string key;
};

class Reader {
public:
  Reader(const SourceManager& sources, const Input& input) : sources_(sources), input_(input), rows_(*input.dialect) {}
  Program run();

private:
  void readTexts();
  void readFile(const LadderFile& file);
  void readLine(const LadderFile& file, const SourceLine& line);
  void readStatement(const LadderFile& file, const SourceLine& line);
  void readDeclaration(const Declaration& declaration);
  void readRung(const LadderFile& file, const ladder::Rung& rung, std::string_view remark);
  void comment(std::string_view text);
  void flushComments(const Place& place);
  std::string readersOf(const std::string& key) const;
  void fillCoils();
  void addNameTables();
  void addMessageTable(DeclarationKind kind, std::string_view title);
  void add(Block::Kind kind, std::string text, std::string_view remark, const Place& place) {
    program_.blocks.push_back({kind, std::move(text), std::string(remark), place, 0});
  }
  void nameFiles();
  uint32_t indexOf(FileId file) const;
  Place placeOf(const LadderFile& file, uint32_t line) const;
  Place placeOf(SourcePos pos) const;
  Place placeOfRung(const LadderFile& file, const ladder::Rung& rung) const;
  Place placeOfElement(SourcePos drawn) const;
  bool converted() const { return input_.files != input_.authors; }

  const SourceManager& sources_;
  const Input& input_;
  Rows rows_;
  std::vector<LadderFile> files_;
  std::unique_ptr<Names> names_;
  Texts texts_;
  Program program_;
  UseList uses_;
  std::vector<CoilRow> coils_;
  std::vector<NameRow> declared_;

  // In the file at hand.
  LineWords words_;
  std::string comments_; // that nothing has taken yet
  size_t nextStatement_ = 0;
  uint32_t nextRung_ = 0;
};

// NCT has them in the source, GSK in a file beside it: 8 x byte + bit + 1 is the bit of A that asks for one.
void Reader::readTexts() {
  for (const LadderFile& file : files_)
    for (const Declaration& declaration : file.declarations)
      if (declaration.kind == DeclarationKind::Message)
        texts_.emplace(plainNumber(declaration.name.text), declaration.value.text);
  if (!names_->isGsk()) return;
  for (const ir::MessageText& message : input_.module->messages) {
    const uint32_t bit = message.number - 1;
    texts_.emplace(fmt::format("A{}.{}", bit / 8, bit % 8), message.text);
  }
}

void Reader::nameFiles() {
  std::map<std::string, int> known;
  const auto baseOf = [&](FileId file) {
    const std::string_view name = sources_.name(file);
    return std::string(name.substr(name.find_last_of('/') + 1)); // all of it without a '/'
  };
  for (FileId file : input_.authors) ++known[baseOf(file)];
  for (FileId file : input_.authors) {
    const std::string path(sources_.name(file));
    const std::string name = baseOf(file);
    program_.files.push_back({path, known[name] > 1 ? path : name});
    program_.title += (program_.title.empty() ? "" : ", ") + program_.files.back().name;
  }
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

Place Reader::placeOfRung(const LadderFile& file, const ladder::Rung& rung) const {
  if (!converted()) return placeOf(file, rung.firstLine);
  return placeOf(input_.origins.rungs[program_.figures.size()].begin);
}

Place Reader::placeOfElement(SourcePos drawn) const {
  if (!converted()) return placeOf(drawn);
  const auto elements = input_.origins.elements;
  const auto at = std::lower_bound(elements.begin(), elements.end(), drawn,
                                   [](const gsk::Origin& one, SourcePos pos) { return one.drawn < pos; });
  return at == elements.end() || at->drawn != drawn ? Place{} : placeOf(at->written);
}

// A conversion's hint at what only a command list can say is no comment of the author.
void Reader::comment(std::string_view text) {
  if (converted() && gsk::parseBlocksHint(text)) return;
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
    if (end > at) declared_.push_back({{}, {}, comments_.substr(at, end - at), {}});
    at = end + 1;
  }
  comments_.clear();
  if (declaration.kind == DeclarationKind::Message || declaration.kind == DeclarationKind::Button) return;
  declared_.push_back({std::string(declaration.name.text), {}, std::string(declaration.comment), {}});
}

void Reader::readRung(const LadderFile& file, const ladder::Rung& rung, std::string_view remark) {
  const auto index = static_cast<uint32_t>(program_.figures.size());
  Figure figure;
  figure.number = index + 1;
  figure.title = rung.comment;
  figure.place = placeOfRung(file, rung);
  if (!remark.empty()) figure.comments.emplace_back(remark);
  const auto placeOf = [this](SourcePos drawn) { return placeOfElement(drawn); };
  const ladder::Drawing drawing = ladder::readDrawing(sources_, file.file, rung, rows_.furtherPins());
  figure.sheet = buildSheet({rows_, *names_, texts_, placeOf}, drawing, [&](const OperandUse& use) {
    uses_.add(use.named, use.operand, {figure.number, use.writes});
    if (use.coil) coils_.push_back({index, use.row, use.named.key});
  });
  program_.figures.push_back(std::move(figure));
  program_.blocks.push_back({Block::Kind::Rung, {}, {}, {}, index});
}

void Reader::readStatement(const LadderFile& file, const SourceLine& line) {
  splitWords(line, {}, words_);
  const Place place = placeOf(file, line.number);
  if (words_.words[0].text == "dialect") {
    if (!words_.comment.empty()) comment(words_.comment);
    return flushComments(place);
  }
  const ladder::Statement& statement = file.statements[nextStatement_++];
  if (statement.kind == StatementKind::Declaration) return readDeclaration(file.declarations[statement.index]);
  flushComments(place);
  switch (statement.kind) {
  case StatementKind::Declaration: return;
  case StatementKind::Module: {
    std::string name;
    for (const Word& word : file.modules[statement.index].name) name.append(name.empty() ? "" : " ").append(word.text);
    return add(Block::Kind::Module, std::move(name), words_.comment, place);
  }
  case StatementKind::Section:
    return add(Block::Kind::Section, std::string(file.sections[statement.index].title.text), words_.comment, place);
  case StatementKind::Rung: return readRung(file, file.rungs[statement.index], words_.comment);
  }
}

void Reader::readLine(const LadderFile& file, const SourceLine& line) {
  const std::string_view text = trimmed(line.text);
  if (text.empty()) {
    if (!comments_.empty() && !comments_.ends_with("\n\n")) comments_.push_back('\n');
  } else if (text[0] == ';') {
    std::string_view words = trimmed(text.substr(1));
    const bool inside = nextRung_ > 0 && line.number < file.rungs[nextRung_ - 1].lastLine;
    if (!inside) return comment(words);
    if (!converted() || !gsk::parseBlocksHint(words)) program_.figures.back().comments.emplace_back(words);
  } else if (std::string_view("|+-[({").find(text[0]) == std::string_view::npos) {
    const size_t rungs = program_.figures.size();
    readStatement(file, line);
    if (program_.figures.size() > rungs) ++nextRung_;
  }
}

void Reader::readFile(const LadderFile& file) {
  nextStatement_ = 0;
  nextRung_ = 0;
  comments_.clear();
  if (input_.files.size() > 1) add(Block::Kind::File, program_.files[indexOf(file.file)].name, {}, {});
  LineReader lines(sources_, file.file);
  for (SourceLine line; lines.next(line);) readLine(file, line);
  flushComments({});
}

std::string Reader::readersOf(const std::string& key) const {
  std::string text;
  size_t count = 0;
  for (const Use& use : uses_.find(key)->uses) {
    if (use.writes) continue;
    if (++count <= kUsesShown) text.append(text.empty() ? "read in " : ", ").append(std::to_string(use.rung));
  }
  if (count > kUsesShown) text += fmt::format(" and {} more", count - kUsesShown);
  return text;
}

// A coil tells where its bit is read, at the right rail. Many coils may be of one bit.
void Reader::fillCoils() {
  std::unordered_map<std::string, std::string> readers;
  for (const CoilRow& coil : coils_) {
    const auto [at, fresh] = readers.emplace(coil.key, std::string());
    if (fresh) at->second = readersOf(coil.key);
    program_.figures[coil.figure].sheet.rows[coil.row].uses = at->second;
  }
}

void Reader::addMessageTable(DeclarationKind kind, std::string_view title) {
  NameTable table{std::string(title), true, {}};
  for (const LadderFile& file : files_) {
    for (const Declaration& declaration : file.declarations) {
      if (declaration.kind != kind) continue;
      NameRow row{std::string(declaration.name.text),
                  std::string(declaration.value.text),
                  std::string(declaration.comment),
                  {}};
      const bool message = kind == DeclarationKind::Message;
      if (const auto* entry = message ? uses_.find(messageKey(plainNumber(declaration.name.text))) : nullptr)
        row.uses = entry->uses;
      table.rows.push_back(std::move(row));
    }
  }
  if (!table.rows.empty()) program_.tables.push_back(std::move(table));
}

void Reader::addNameTables() {
  std::unordered_map<std::string, bool> taken;
  for (NameRow& row : declared_) {
    if (row.name.empty()) continue;
    const Named named = names_->find(row.name);
    row.address = named.address;
    taken[named.key] = true;
    if (const auto* entry = uses_.find(named.key)) row.uses = entry->uses;
  }
  const bool any = std::any_of(declared_.begin(), declared_.end(), [](const NameRow& r) { return !r.name.empty(); });
  if (any) program_.tables.push_back({"Declared names", false, std::move(declared_)});
  NameTable others{"Other names and addresses", false, {}};
  for (const UseList::Entry& entry : uses_.entries()) {
    if (taken.contains(entry.named.key) || entry.named.key.starts_with("message ")) continue;
    others.rows.push_back({entry.name, entry.named.address, entry.named.comment, entry.uses});
  }
  std::sort(others.rows.begin(), others.rows.end(), [](const NameRow& a, const NameRow& b) { return a.name < b.name; });
  if (!others.rows.empty()) program_.tables.push_back(std::move(others));
}

Program Reader::run() {
  Diagnostics unheard; // reported when the program was compiled
  for (FileId file : input_.files) files_.push_back(ladder::parseLadder(sources_, file, unheard, rows_.furtherPins()));
  nameFiles();
  RUNG_CHECK(!unheard.hasErrors(), "the program has been compiled");
  program_.control = input_.dialect->title;
  names_ = std::make_unique<Names>(*input_.dialect, *input_.module, files_);
  readTexts();
  for (const LadderFile& file : files_) readFile(file);
  fillCoils();
  addNameTables();
  addMessageTable(DeclarationKind::Message, "Messages");
  addMessageTable(DeclarationKind::Button, "Function buttons");
  return std::move(program_);
}

} // namespace

Program readProgram(const SourceManager& sources, const Input& input) { return Reader(sources, input).run(); }

} // namespace rung::view

// Lays out the words of each line in columns. Lines are not joined or split, so macros and structures need not be
// understood. Blanks between words of an operand are kept as one.
#include "frontend/dialects/technol/format.h"

#include <fmt/format.h>

#include <map>
#include <utility>

#include "frontend/dialects/technol/read/file_reader.h"
#include "frontend/dialects/technol/read/lexer.h"
#include "frontend/syntax/page.h"
#include "ir/support/check.h"
#include "ir/support/put.h"
#include "rtlib/text/letters.h"

namespace rung::frontend::technol {
namespace {

constexpr size_t kInstructionColumn = 8;
constexpr size_t kOperandColumn = 13;
constexpr size_t kCommentColumn = 34;
constexpr size_t kTab = 8;

constexpr Table kLabels{
    .second = kInstructionColumn, .third = kOperandColumn, .alignsThird = false, .endsAtBlank = true};
constexpr Table kMembers = kLabels; // names without a colon

// Column of a character on the screen, with tabs expanded.
size_t columnOf(std::string_view line, size_t offset) {
  size_t column = 0;
  for (const char c : line.substr(0, offset)) column = c == '\t' ? (column / kTab + 1) * kTab : column + 1;
  return column;
}

// Whether the statement begins in the first column: modules and similar statements.
bool beginsInFirstColumn(const Row& row) {
  switch (row.role) {
  case Role::Module:
  case Role::ModuleEnd:
  case Role::Local:
  case Role::LocalEnd:
  case Role::Stop: return true;
  default: return row.info.mnemonic == "DEF_T_MACRO" || row.info.mnemonic == "END_T_MACRO";
  }
}

// Declarations, whose unlabelled lines may occur between labelled ones of a table.
bool declares(const Row& row) {
  return row.role == Role::Dfm || row.role == Role::Ds || row.role == Role::Str || row.role == Role::Equi;
}

class Formatter {
public:
  Formatter(const SourceManager& sources, FileId file, Diagnostics& diagnostics)
      : sources_(sources), diagnostics_(diagnostics), file_(file), page_(sources.text(file), kCommentColumn) {}

  std::string run() {
    LineReader lines(sources_, file_);
    for (SourceLine line; lines.next(line);) read(line);
    return page_.take();
  }

private:
  void read(const SourceLine& line);
  void ownComment(std::string_view text, size_t column);
  void words(const SourceLine& line, size_t first, size_t comment);
  void statement(std::string_view comment);
  void unlabelled(std::string_view comment);
  size_t labelTokens() const;
  bool isName(size_t token) const { return token < tokens_.size() && tokens_[token].kind == TokenKind::Name; }
  bool isMember(size_t token) const;
  bool beginsStatement() const;
  std::string spelledFrom(size_t token) const;

  const SourceManager& sources_;
  Diagnostics& diagnostics_;
  FileId file_;
  Page page_;
  std::vector<Token> tokens_;         // of the current line
  std::optional<size_t> commentedAt_; // column of the comment of the previous line
  bool open_ = false;                 // a comma at the end of the previous line continues the statement
  bool stopped_ = false;              // the rest of the file is not parsed
};

void Formatter::read(const SourceLine& line) {
  const std::string_view text = line.text;
  const size_t first = text.find_first_not_of(stopped_ ? " \t" : " \t\f");
  const auto above = std::exchange(commentedAt_, std::nullopt);
  if (first == std::string_view::npos) return page_.blank();
  if (stopped_) return page_.line(std::string(withoutTrailingSpace(text)));
  const size_t comment = std::min(commentOf(text), text.size());
  if (comment < text.size()) commentedAt_ = columnOf(text, comment);
  if (first < comment) return words(line, first, comment);
  if (above && commentedAt_ == above) return page_.line("", text.substr(first));
  ownComment(text.substr(first), commentedAt_.value());
}

// Puts a comment on its own line into the first column if it was there, otherwise into the column of instructions.
void Formatter::ownComment(std::string_view text, size_t column) {
  page_.comment(std::string(column == 0 ? 0 : kInstructionColumn, ' ').append(text));
  commentedAt_.reset();
}

void Formatter::words(const SourceLine& line, size_t first, size_t comment) {
  const std::string_view after = line.text.substr(comment);
  if (FileReader::isInclude(line.text)) { // a path is not a sequence of tokens
    const std::string_view code = withoutTrailingSpace(line.text.substr(first, comment - first));
    const size_t word = code.find_first_of(" \t");
    const std::string_view path = code.substr(std::min(code.find_first_not_of(" \t", word), code.size()));
    open_ = false;
    return page_.line(std::string(kInstructionColumn, ' ').append(code.substr(0, word)).append(" ").append(path),
                      after);
  }
  tokens_.clear();
  if (!tokenize(line, tokens_, diagnostics_)) return;
  RUNG_CHECK(!tokens_.empty(), "a line with more than a comment has words");
  statement(after);
  open_ = tokens_.back().is(',');
}

bool Formatter::isMember(size_t token) const {
  const Row* row = isName(token) ? findRow(tokens_[token].text) : nullptr;
  return row != nullptr && row->role == Role::MemberSize && row->info.mnemonic != "DUP";
}

// Number of tokens of a label: `NAME:`, or the name of a structure, member or instance, which has no colon; otherwise
// 0.
size_t Formatter::labelTokens() const {
  if (tokens_.size() > 1 && tokens_[0].kind != TokenKind::Punct && tokens_[1].is(':')) return 2;
  if (!isName(0) || !isName(1) || findRow(tokens_[0].text) != nullptr) return 0;
  const bool isData = tokens_.size() > 2 && tokens_[2].is('<');
  const bool isRepeated = isName(3) && text::equalsIgnoringCase(tokens_[3].text, "DUP");
  return isMember(1) || isData || isRepeated ? 1 : 0;
}

// Whether the line begins a statement although the previous one ends with a comma.
bool Formatter::beginsStatement() const {
  if (labelTokens() != 0) return true;
  return isName(0) && findRow(tokens_[0].text) != nullptr && reservedWord(tokens_[0].text) == Reserved::Yes;
}

// The source text from `token` on, with its apostrophes; without blanks around commas.
std::string Formatter::spelledFrom(size_t token) const {
  std::string text;
  for (size_t i = token; i < tokens_.size(); ++i) {
    const bool apart = i > token && tokens_[i - 1].range().end < tokens_[i].pos;
    if (apart && !tokens_[i].is(',') && !tokens_[i - 1].is(',')) text += ' ';
    text += sources_.text(tokens_[i].range());
  }
  return text;
}

void Formatter::unlabelled(std::string_view comment) {
  const Row* row = isName(0) ? findRow(tokens_[0].text) : nullptr;
  const bool first = row != nullptr && beginsInFirstColumn(*row);
  std::string text(first ? 0 : kInstructionColumn, ' ');
  if (!isName(0)) return page_.line(text + spelledFrom(0), comment);
  text += tokens_[0].text;
  const std::string operands = spelledFrom(1);
  if (!operands.empty()) text.append(first || text.size() >= kOperandColumn ? 1 : kOperandColumn - text.size(), ' ');
  text += operands;
  return row != nullptr && declares(*row) ? page_.aside(std::move(text), comment)
                                          : page_.line(std::move(text), comment);
}

void Formatter::statement(std::string_view comment) {
  if (open_ && !beginsStatement()) return page_.line(std::string(kOperandColumn, ' ') + spelledFrom(0), comment);
  const size_t label = labelTokens();
  const Row* row = isName(label) ? findRow(tokens_[label].text) : nullptr;
  stopped_ = row != nullptr && row->role == Role::Stop;
  if (label == 0) return unlabelled(comment);
  const std::string name = std::string(sources_.text(tokens_[0].range())).append(label == 2 ? ":" : "");
  if (label == tokens_.size()) return page_.line(name, comment);
  const Table& table = label == 2 ? kLabels : kMembers;
  if (!isName(label)) return page_.row(table, {name, spelledFrom(label)}, comment);
  page_.row(table, {name, std::string(tokens_[label].text), spelledFrom(label + 1)}, comment);
}

} // namespace

// A text that is not UTF-8 is decoded first, so that errors are reported correctly. The layout then uses the original
// bytes: all characters that separate words are the same in every encoding.
std::optional<std::string> format(SourceManager& sources, FileId file, Diagnostics& diagnostics) {
  const std::string_view text = sources.text(file);
  const size_t before = diagnostics.errorCount();
  const auto readableFile = readable(sources, file, diagnostics);
  if (!readableFile) return std::nullopt;
  std::string out = Formatter(sources, *readableFile, diagnostics).run();
  if (diagnostics.errorCount() != before) return std::nullopt;
  if (sources.text(*readableFile) != text) {
    Diagnostics discarded;
    out = Formatter(sources, sources.addBuffer(std::string(sources.name(file)), std::string(text)), discarded).run();
    RUNG_CHECK(!discarded.hasErrors(), "words are the same in all encodings");
  }
  return out;
}

// Listing with line and rung numbers.

namespace {

using LineOfFile = std::pair<std::string_view, uint32_t>;

std::map<LineOfFile, uint32_t> rungNumbers(const ir::Module& module) {
  std::map<LineOfFile, uint32_t> numbers;
  for (const ir::Routine& routine : module.routines)
    for (const ir::Rung& rung : routine.rungs)
      if (rung.number != 0)
        numbers.emplace(LineOfFile(module.files[rung.begin.file.index], rung.begin.line), rung.number);
  return numbers;
}

} // namespace

std::string listing(const SourceManager& sources, std::span<const FileId> files, const ir::Module& module) {
  const std::map<LineOfFile, uint32_t> numbers = rungNumbers(module);
  std::string out;
  for (const FileId file : files) {
    if (!out.empty()) out += '\n';
    put(out, "; {}\n; line rung\n", sources.name(file));
    const uint32_t lines = sources.lineCount(file);
    for (uint32_t line = 1; line <= lines; ++line) {
      const std::string_view text = sources.lineText(file, line);
      if (line == lines && text.empty()) break; // the empty line after the last line end
      const auto number = numbers.find({sources.name(file), line});
      const std::string rung = number == numbers.end() ? "" : std::to_string(number->second);
      if (text.empty())
        put(out, "{:6}\n", line);
      else
        put(out, "{:6} {:>5}  {}\n", line, rung, text);
    }
  }
  return out;
}

} // namespace rung::frontend::technol

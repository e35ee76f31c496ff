// Symbols and comments as LADDER-III and other programs write them: `symbol,address,comment`, with or without the line
// %@2-E(…), which says the columns.
#include <algorithm>
#include <map>
#include <optional>

#include <fmt/format.h>

#include "ir/support/utf8.h"
#include "rtlib/text/blanks.h"
#include "rtlib/text/letters.h"
#include "tools/imported/imported.h"
#include "tools/imported/lines.h"

namespace rung::imported {
namespace {

constexpr size_t kMostComments = 16;  // languages of LADDER-III
constexpr size_t kLongestSymbol = 40; // characters, of the newest controls
constexpr size_t kNoColumn = SIZE_MAX;

// Where a line has what; from 0.
struct Columns {
  size_t symbol = 0;
  size_t address = 1;
  std::vector<size_t> comments; // CM1, CM2 …; kNoColumn: it has none
};

struct Row {
  std::string symbol;
  std::string address;
  std::vector<std::string> comments;
};

class Reader {
public:
  explicit Reader(std::vector<Remark>& remarks) : remarks_(remarks) {}

  std::vector<Row> read(std::string_view text) {
    for (const Line& line : linesOf(text)) {
      const std::string_view words = text::trimmed(line.text);
      if (words.empty() || words.starts_with(';') || words == "%@A" || words == "%@E") continue;
      if (hasEnded_) {
        remark(positionOf(line, 0), "the section has ended at the % before; the rest is left out");
        break;
      }
      readLine(line, words);
    }
    return std::move(rows_);
  }

private:
  void remark(text::Position at, std::string text, bool wrong = false) {
    remarks_.push_back({at, std::move(text), wrong});
  }

  void readLine(const Line& line, std::string_view words) {
    if (words == "%")
      hasEnded_ = !rows_.empty();
    else if (words.starts_with("%@"))
      readHeader(line);
    else
      readRow(line);
  }

  // %@2-E(SYM=1 ADR=2 CM1=3); a blank may precede the bracket.
  void readHeader(const Line& line) {
    const size_t open = line.text.find('('), close = line.text.find(')');
    if (!text::startsWithIgnoringCase(text::trimmed(line.text), "%@2-E"))
      return remark(positionOf(line, 0),
                    fmt::format("'{}' begins another section; expected %@2-E(SYM=1 ADR=2 CM1=3)", inBrief(line.text)),
                    true);
    if (open == std::string_view::npos || close == std::string_view::npos || close < open) return;
    columns_ = {.symbol = kNoColumn, .address = kNoColumn, .comments = {}};
    for (size_t at = open + 1; at < close;) {
      const size_t begin = line.text.find_first_not_of(" \t,", at);
      at = std::min(line.text.find_first_of(" \t,)", begin), close);
      if (begin < close) readColumn(line, begin, line.text.substr(begin, at - begin));
    }
    if (columns_->symbol == kNoColumn || columns_->address == kNoColumn)
      remark(positionOf(line, open), "found no column of the symbol or of the address, expected SYM=1 ADR=2", true);
  }

  void readColumn(const Line& line, size_t begin, std::string_view word) {
    const size_t equals = std::min(word.find('='), word.size());
    const std::string_view key = word.substr(0, equals);
    const auto column = numberIn(word.substr(std::min(equals + 1, word.size())), kMostComments + 2);
    const auto comment = key.size() > 2 && text::startsWithIgnoringCase(key, "CM")
                             ? numberIn(key.substr(2), kMostComments)
                             : std::nullopt;
    const bool isSymbol = text::equalsIgnoringCase(key, "SYM"), isAddress = text::equalsIgnoringCase(key, "ADR");
    if (!column || (!isSymbol && !isAddress && !comment))
      return remark(positionOf(line, begin), fmt::format("found '{}', expected SYM=n, ADR=n or CM1=n", inBrief(word)),
                    true);
    if (isSymbol) columns_->symbol = *column - 1;
    if (isAddress) columns_->address = *column - 1;
    if (!comment) return;
    columns_->comments.resize(std::max(columns_->comments.size(), *comment), kNoColumn);
    columns_->comments[*comment - 1] = *column - 1;
  }

  // 1 to `most`.
  static std::optional<size_t> numberIn(std::string_view text, size_t most) {
    const auto number = detail::takeDigits(text);
    return number && text.empty() && *number >= 1 && *number <= most ? std::optional<size_t>(*number) : std::nullopt;
  }

  static Columns usual(size_t fields) {
    Columns columns;
    for (size_t i = 2; i < std::min(fields, kMostComments + 2); ++i) columns.comments.push_back(i);
    return columns;
  }

  void readRow(const Line& line) {
    const std::vector<Field> fields = fieldsOf(line);
    const Columns columns = columns_ ? *columns_ : usual(fields.size());
    const auto field = [&](size_t column) { return column < fields.size() ? fields[column].text : std::string(); };
    if (columns.address >= fields.size() || columns.symbol >= fields.size())
      return remark(positionOf(line, 0),
                    fmt::format("found '{}', expected a symbol, a comma and an address", inBrief(line.text)), true);
    const bool isTitle = rows_.empty() && !columns_ && !pmcAddress(field(columns.address)) && isTitleLine(line);
    if (isTitle) return;
    Row row{.symbol = field(columns.symbol), .address = field(columns.address), .comments = {}};
    for (const size_t column : columns.comments) row.comments.push_back(field(column));
    checkRow(line, fields[columns.symbol].at, fields[columns.address].at, std::move(row));
  }

  // Titles of the columns, which spreadsheets want.
  static bool isTitleLine(const Line& line) {
    const std::vector<Field> fields = fieldsOf(line);
    return text::startsWithIgnoringCase(fields[0].text, "symbol") ||
           text::startsWithIgnoringCase(fields[1].text, "address");
  }

  void checkRow(const Line& line, text::Position symbolAt, text::Position addressAt, Row row) {
    const std::optional<PmcAddress> address = pmcAddress(row.address);
    if (!address)
      return remark(addressAt,
                    fmt::format("found '{}', expected an address such as X8.4, D100 or P12", inBrief(row.address)),
                    true);
    if (address->pmc != 1)
      return remark(addressAt, fmt::format("{} belongs to PMC {}; left out", inBrief(row.address), address->pmc));
    if (row.symbol.empty())
      return remark(addressAt, fmt::format("{} has a comment and no symbol; left out", inBrief(row.address)));
    if (const size_t bad = row.symbol.find_first_of(" \t,;%\""); bad != std::string::npos)
      return remark(symbolAt, fmt::format("the symbol '{}' has a '{}' in it", inBrief(row.symbol), row.symbol[bad]),
                    true);
    if (countCodePoints(row.symbol) > kLongestSymbol)
      remark(symbolAt, fmt::format("the symbol {} is longer than {} characters, the most that any control takes",
                                   inBrief(row.symbol), kLongestSymbol));
    const bool isNumber = row.symbol.find_first_not_of("0123456789") == std::string::npos;
    if (isNumber || pmcAddress(row.symbol))
      remark(symbolAt, fmt::format("the symbol {} is also {}, which takes precedence in a program", inBrief(row.symbol),
                                   isNumber ? "a number" : "an address"));
    if (isKnown(line, symbolAt, row, nameOf(*address))) return;
    for (std::string& comment : row.comments) comment = withoutMarks(std::move(comment));
    rows_.push_back(std::move(row));
  }

  // A section has no quoted fields.
  static std::string withoutMarks(std::string comment) {
    std::ranges::replace(comment, ',', ';');
    std::ranges::replace(comment, '"', '\'');
    return comment;
  }

  // Symbols are compared without case. The same definition may be there twice.
  bool isKnown(const Line& line, text::Position at, const Row& row, const std::string& address) {
    const auto [known, isNew] = symbols_.try_emplace(text::upper(row.symbol), Known{address, line.number});
    if (!isNew && known->second.address != address)
      remark(at,
             fmt::format("{} is {} here and {} in line {}", inBrief(row.symbol), address, known->second.address,
                         known->second.line),
             true);
    return !isNew;
  }

  struct Known {
    std::string address;
    uint32_t line;
  };

  std::vector<Remark>& remarks_;
  std::optional<Columns> columns_; // of the header
  std::vector<Row> rows_;
  bool hasEnded_ = false;
  std::map<std::string, Known> symbols_; // by their names in capitals
};

std::string sectionOf(const std::vector<Row>& rows, const Source& source) {
  size_t comments = 1;
  for (const Row& row : rows) comments = std::max(comments, row.comments.size());
  std::string text = fmt::format("; Made by rungc import from {}.\n%@2-E(SYM=1 ADR=2", asShown(source.name));
  for (size_t i = 1; i <= comments; ++i) text += fmt::format(" CM{}={}", i, i + 2);
  text += ")\n";
  for (const Row& row : rows) {
    text += fmt::format("{},{}", asShown(row.symbol), asShown(row.address));
    for (size_t i = 0; i < comments; ++i) text += "," + (i < row.comments.size() ? asShown(row.comments[i]) : "");
    text += '\n';
  }
  return text + "%\n";
}

} // namespace

Imported symbolSection(const Source& source) {
  Imported made;
  const std::vector<Row> rows = Reader(made.remarks).read(source.text);
  if (rows.empty() && made.isUsable())
    made.remarks.push_back({{}, "found no symbol, expected lines such as START,X0010.0,START BUTTON", true});
  made.text = sectionOf(rows, source);
  return made;
}

} // namespace rung::imported

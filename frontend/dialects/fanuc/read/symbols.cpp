// See symbols.h.
#include "frontend/dialects/fanuc/read/symbols.h"

#include <algorithm>
#include <array>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "frontend/network/address.h"
#include "ir/support/diag/pmc.h"
#include "rtlib/text/blanks.h"
#include "rtlib/text/letters.h"
#include "rtlib/text/number.h"

namespace rung::frontend::fanuc {
namespace {

using network::Context;
using network::UserName;

// Reads what a symbol names: a bit, a byte, a subprogram or a label.
bool readPlace(Context& context, std::string_view text, UserName& name) {
  const char letter = text.empty() ? '\0' : text::upper(text[0]);
  if (letter == 'P' || letter == 'L') {
    const auto number = network::parseDigits(text.substr(1));
    if (!number) return false;
    name.kind = UserName::Kind::Numbered;
    name.text = letter == 'P' ? "P" : "L";
    name.value = static_cast<int64_t>(*number);
    return true;
  }
  const auto address = network::parseAddress(context.language, text);
  if (address) name.address = *address; // whether the control has it shows where the symbol is used
  return address.has_value();
}

Word wordOf(const SourceLine& line, std::string_view part) {
  const auto at = static_cast<size_t>(part.data() - line.text.data());
  return {part, line.range(at, at + part.size()), false};
}

// `address symbol`, in form C with a line `$1 '' 'comment'` after it.
class PlainReader {
public:
  PlainReader(Diagnostics& diagnostics, const SymbolSink& sink) : diagnostics_(diagnostics), sink_(sink) {}

  void line(const SourceLine& line) {
    const std::string_view text = text::trimmed(line.text);
    if (text.starts_with('$')) return comment(text);
    flush();
    if (text.starts_with(';')) return sink_.remark(text.substr(1));
    if (text.empty()) return;
    const size_t blank = text.find_first_of(" \t");
    if (blank == std::string_view::npos) {
      diagnostics_.report(diag::BadListedSymbol, wordOf(line, text).range) << text << "an address and its symbol";
      return;
    }
    place_ = text.substr(0, blank);
    symbol_ = text::trimmed(text.substr(blank));
    symbol_ = symbol_.substr(0, symbol_.find_first_of(" \t"));
    line_ = line;
  }
  void flush() {
    if (!symbol_.empty()) sink_.symbol(wordOf(line_, symbol_), wordOf(line_, place_), comments_);
    symbol_ = {};
    comments_.clear();
  }

private:
  // Comments in single quotes; empty ones do not count.
  void comment(std::string_view text) {
    while (true) {
      const size_t open = text.find('\'');
      const size_t close = open == std::string_view::npos ? open : text.find('\'', open + 1);
      if (close == std::string_view::npos) return;
      const std::string_view comment = text::trimmed(text.substr(open + 1, close - open - 1));
      if (!comment.empty()) comments_.push_back(comment);
      text.remove_prefix(close + 1);
    }
  }

  Diagnostics& diagnostics_;
  const SymbolSink& sink_;
  SourceLine line_;
  std::string_view place_, symbol_;
  Comments comments_;
};

// The columns of a table, from its code: `(SYM=1 ADR=2 CM1=3 CM2=4)`; the numbers count from 1, 0: there is none.
struct Columns {
  size_t symbol = 1, address = 2;
  std::vector<size_t> comments;
};

size_t columnNamed(std::string_view code, std::string_view name, size_t otherwise) {
  const size_t at = code.find(name);
  if (at == std::string_view::npos) return otherwise;
  const std::string_view digits = code.substr(at + name.size());
  const auto number = network::parseDigits(digits.substr(0, digits.find_first_not_of("0123456789")));
  return number ? static_cast<size_t>(*number) : otherwise;
}

Columns columnsOf(std::string_view code) {
  constexpr int kMostComments = 16; // LADDER-III has a comment for each language of the control, at most
  const std::string upper = text::upper(code);
  Columns columns{columnNamed(upper, "SYM=", 1), columnNamed(upper, "ADR=", 2), {columnNamed(upper, "CM1=", 3)}};
  for (int number = 2; number <= kMostComments; ++number)
    columns.comments.push_back(columnNamed(upper, fmt::format("CM{}=", number), 0));
  return columns;
}

// The fields of a line, without the quotes of those that have them. (A quote inside a field is not known to be
// written.)
std::vector<std::string_view> fieldsOf(std::string_view text) {
  std::vector<std::string_view> fields;
  while (true) {
    const bool quoted = text.starts_with('"');
    const size_t close = quoted ? text.find('"', 1) : std::string_view::npos;
    const size_t comma = text.find(',', close == std::string_view::npos ? 0 : close);
    std::string_view field = text::trimmed(text.substr(0, comma));
    if (field.size() >= 2 && field.front() == '"' && field.back() == '"') field = field.substr(1, field.size() - 2);
    fields.push_back(field);
    if (comma == std::string_view::npos) return fields;
    text.remove_prefix(comma + 1);
  }
}

void tableLine(const Columns& columns, const SourceLine& line, const SymbolSink& sink) {
  const std::string_view text = text::trimmed(line.text);
  if (text.starts_with(';')) return sink.remark(text.substr(1));
  if (text.empty()) return;
  const std::vector<std::string_view> fields = fieldsOf(text);
  const auto field = [&](size_t column) {
    return column == 0 || column > fields.size() ? std::string_view() : fields[column - 1];
  };
  if (field(columns.symbol).empty() || field(columns.address).empty()) return; // a comment without the other one
  Comments comments;
  for (const size_t column : columns.comments) comments.push_back(field(column));
  while (!comments.empty() && comments.back().empty()) comments.pop_back();
  sink.symbol(wordOf(line, field(columns.symbol)), wordOf(line, field(columns.address)), comments);
}

} // namespace

std::string joined(const Comments& comments) {
  return fmt::format("{}", fmt::join(comments, fmt::format(" {} ", kNextComment)));
}

Comments commentsIn(std::string_view joined) {
  Comments comments;
  while (true) {
    const size_t end = joined.find(kNextComment);
    comments.push_back(text::trimmed(joined.substr(0, end)));
    if (end == std::string_view::npos) return comments;
    joined.remove_prefix(end + kNextComment.size());
  }
}

void addSymbol(Context& context, const Word& name, const Word& place, const Comments& comments) {
  const auto first = std::ranges::find_if(comments, [](std::string_view comment) { return !comment.empty(); });
  UserName symbol{.name = name.text, .declared = name.range, .comment = first == comments.end() ? "" : *first};
  if (readPlace(context, place.text, symbol))
    context.names.addListed(context.diagnostics, std::move(symbol));
  else
    context.diagnostics.report(diag::BadListedSymbol, place.range) << place.text << "the address of a symbol";
}

void addDrawnSymbol(Context& context, const Word& name, const Word& place, std::string_view comment) {
  addSymbol(context, name, place, commentsIn(comment));
}

void readSymbols(const SourceManager& sources, Diagnostics& diagnostics, FileId file, const Section& section,
                 const SymbolSink& sink) {
  if (section.kind == Section::Kind::SymbolTable) {
    const Columns columns = columnsOf(section.code);
    return eachLine(sources, file, section, [&](const SourceLine& line) { tableLine(columns, line, sink); });
  }
  PlainReader reader(diagnostics, sink);
  eachLine(sources, file, section, [&](const SourceLine& line) { reader.line(line); });
  reader.flush();
}

} // namespace rung::frontend::fanuc

// Formats the lines of a parsed file (see format.h).
#include "frontend/ladder/text/format.h"

#include <algorithm>

#include "frontend/ladder/text/drawing.h"
#include "frontend/syntax/page.h"
#include "ir/support/check.h"

namespace rung::frontend::ladder {
namespace {

constexpr Table kNames; // symbol, const
constexpr Table kMessages;
constexpr Table kButtons;
constexpr Table kData;
constexpr Table kStatements{.endsAtBlank = true}; // all other statements, in one cell

// The table that lines with this keyword belong to; null if they do not form a table.
const Table* tableOf(std::string_view keyword) {
  if (keyword == "symbol" || keyword == "const") return &kNames;
  if (keyword == "message") return &kMessages;
  if (keyword == "data") return &kData;
  return keyword == "button" ? &kButtons : nullptr;
}

std::string spelled(const Word& word) {
  const std::string_view quote = word.quoted ? "\"" : "";
  return std::string(quote).append(word.text).append(quote);
}

class Formatter {
public:
  // `kept`: per rung, whether its drawing stays unchanged.
  Formatter(const SourceManager& sources, const LadderFile& file, FindBox findBox, const std::vector<bool>& kept)
      : sources_(sources), file_(file), findBox_(findBox), kept_(kept), page_(sources.text(file.file), 0) {}

  std::string run() {
    LineReader lines(sources_, file_.file);
    for (SourceLine source; lines.next(source);) line(source);
    return page_.take();
  }

private:
  void line(const SourceLine& source);
  void comment(std::string_view text, size_t first);
  void drawn(const SourceLine& source);
  void statement(const SourceLine& source);
  void openRung();
  bool isInDrawing() const { return nextDrawn_ < drawing_.lines.size(); }
  // Text of the next line of the drawing.
  std::string drawnText() const;

  const SourceManager& sources_;
  const LadderFile& file_;
  const FindBox findBox_;
  const std::vector<bool>& kept_;
  Page page_;
  LineWords words_;
  size_t nextRung_ = 0;
  Drawing drawing_;
  std::optional<std::vector<std::string>> laidOut_; // new lines of the drawing; nullopt if it stays unchanged
  size_t nextDrawn_ = 0;
};

void Formatter::line(const SourceLine& source) {
  const size_t first = source.text.find_first_not_of(' ');
  if (first == std::string_view::npos) return page_.blank();
  if (source.text[first] == ';') return comment(source.text.substr(first), first);
  if (beginsDrawing(source.text[first])) return drawn(source);
  statement(source);
}

// A comment outside the first column is indented like the next line of the drawing.
void Formatter::comment(std::string_view text, size_t first) {
  const size_t column = first > 0 && isInDrawing() ? drawnText().find_first_not_of(' ') : 0;
  page_.comment(std::string(column, ' ').append(text));
}

std::string Formatter::drawnText() const {
  if (laidOut_) return (*laidOut_)[nextDrawn_];
  const DrawnLine& drawn = drawing_.lines[nextDrawn_];
  return std::string(drawn.source.text.substr(0, drawing_.tokensOf(drawn).back().end));
}

void Formatter::drawn(const SourceLine& source) {
  const DrawnLine& drawn = drawing_.lines[nextDrawn_];
  RUNG_CHECK(drawn.source.number == source.number, "the lines of a drawing are those of its rung");
  const std::string_view after = source.text.substr(drawing_.tokensOf(drawn).back().end);
  page_.line(drawnText(), after.substr(std::min(after.find(';'), after.size())));
  ++nextDrawn_;
}

void Formatter::openRung() {
  const Rung& rung = file_.rungs[nextRung_];
  drawing_ = readDrawing(sources_, file_.file, rung, findBox_);
  laidOut_ = kept_[nextRung_] ? std::nullopt : layOut(drawing_);
  nextDrawn_ = 0;
  ++nextRung_;
}

void Formatter::statement(const SourceLine& source) {
  splitWords(source, {}, words_);
  const std::string_view comment =
      words_.hasComment ? source.text.substr(words_.commentRange.begin.value - source.begin.value) : "";
  std::vector<std::string> cells;
  for (const Word& word : words_.words) cells.push_back(spelled(word));
  if (const Table* table = tableOf(words_.words[0].text)) return page_.row(*table, std::move(cells), comment);
  std::string text = cells[0];
  for (const std::string& cell : std::span(cells).subspan(1)) text.append(" ").append(cell);
  page_.row(kStatements, {std::move(text)}, comment);
  if (words_.words[0].text == "rung") openRung();
}

// The meaning of a rung, independent of its lines and columns.
std::string meaningOf(const Rung& rung) {
  const std::string dump = dumpRung(rung);
  return dump.substr(dump.find('\n'));
}

// Per rung, whether it means something else in `text` than in the file.
std::vector<bool> changedRungs(const LadderFile& file, const std::string& text, FindBox findBox) {
  SourceManager sources;
  Diagnostics discarded;
  const LadderFile again = parseLadder(sources, sources.addBuffer("formatted", text), discarded, findBox);
  RUNG_CHECK(again.rungs.size() == file.rungs.size(), "no rung is lost");
  std::vector<bool> changed;
  for (size_t i = 0; i < file.rungs.size(); ++i)
    changed.push_back(again.rungs[i].bad || meaningOf(again.rungs[i]) != meaningOf(file.rungs[i]));
  return changed;
}

} // namespace

std::optional<std::string> format(const SourceManager& sources, FileId file, FindBox findBox,
                                  Diagnostics& diagnostics) {
  const size_t before = diagnostics.errorCount();
  const LadderFile ladder = parseLadder(sources, file, diagnostics, findBox);
  if (diagnostics.errorCount() != before) return std::nullopt;
  std::vector<bool> kept(ladder.rungs.size(), false);
  std::string text = Formatter(sources, ladder, findBox, kept).run();
  kept = changedRungs(ladder, text, findBox);
  if (std::ranges::find(kept, true) == kept.end()) return text;
  text = Formatter(sources, ladder, findBox, kept).run();
  kept = changedRungs(ladder, text, findBox);
  RUNG_CHECK(std::ranges::find(kept, true) == kept.end(), "a rung that is kept stays the same");
  return text;
}

} // namespace rung::frontend::ladder

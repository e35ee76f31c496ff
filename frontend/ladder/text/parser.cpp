// Parses the statements of ladder text; drawings are passed to the scanner and the wiring.
#include <algorithm>
#include <iterator>
#include <string>
#include <utility>

#include "frontend/ladder/text/drawing.h"
#include "frontend/ladder/text/keywords.h"
#include "frontend/ladder/text/ladder_file.h"
#include "frontend/ladder/text/list_word.h"
#include "frontend/syntax/word_lexer.h"
#include "ir/support/check.h"
#include "ir/support/diag/ladder.h"
#include "ir/support/diag/source.h"
#include "ir/support/meant.h"
#include "rtlib/text/letters.h"

namespace rung::frontend::ladder {
namespace {

constexpr WordRules kRules{};

/// Context of a drawing line.
enum class Place : uint8_t {
  Outside, ///< no open rung: an error
  Rung,    ///< to the open rung
  Skipped, ///< follows a line that was already reported
};

class Parser {
public:
  Parser(const SourceManager& sources, FileId file, Diagnostics& diagnostics, FindBox findBox)
      : sources_(sources), diagnostics_(diagnostics), findBox_(findBox) {
    result_.file = file;
  }

  LadderFile run();

private:
  void line(const SourceLine& line);
  void drawingLine(const SourceLine& line);
  void statement(const SourceLine& line);
  bool checkWords(const SourceLine& line);
  void dispatch(const SourceLine& line, std::string_view keyword);

  void dialect();
  void module();
  void declaration(DeclarationKind kind);
  void section();
  void openRung(const SourceLine& line);
  void closeRung();
  void finishRung(Rung& rung);

  void reportUnknown(const Word& keyword);
  void malformed(std::string_view form);
  void add(StatementKind kind, size_t index) {
    result_.statements.push_back({kind, static_cast<uint32_t>(index), line_, words_.comment});
  }
  SourceRange statementRange() const { return join(words_.words.front().range, words_.words.back().range); }
  bool isText(size_t word) const { return words_.words.size() > word && words_.words[word].quoted; }

  const SourceManager& sources_;
  Diagnostics& diagnostics_;
  const FindBox findBox_;
  LadderFile result_;
  LineWords words_;
  uint32_t line_ = 0;             ///< line of the last statement
  std::vector<Comment> comments_; ///< comments since the last statement or drawing line
  Drawing drawing_;
  Place place_ = Place::Outside;
  bool rungIsEmpty_ = false; // whether the last rung has no drawing
  bool hadStatement_ = false;
  bool hadOutsideRung_ = false;
  bool isList_ = false; // the file is an instruction list
};

LadderFile Parser::run() {
  if (!checkEncoding(sources_, result_.file, diagnostics_)) return std::move(result_);
  LineReader lines(sources_, result_.file);
  for (SourceLine source; lines.next(source);) line(source);
  closeRung();
  if (!hadStatement_) diagnostics_.report(diag::MissingDialect, sources_.range(result_.file, 0, 0));
  return std::move(result_);
}

void Parser::line(const SourceLine& source) {
  const size_t tab = source.text.find('\t');
  if (tab != std::string_view::npos) diagnostics_.report(diag::TabCharacter, source.range(tab, tab + 1));
  const size_t first = source.text.find_first_not_of(" \t");
  if (first == std::string_view::npos) {
    closeRung();
    result_.statements.push_back({StatementKind::Blank, 0, source.number});
    return;
  }
  const char c = source.text[first];
  if (c == ';')
    return comments_.push_back(commentFrom(source, first)); // also between drawing lines: a comment is not a blank line
  if (!beginsDrawing(c)) {
    closeRung();
    statement(source);
  } else if (tab != std::string_view::npos) {
    addUnreadLine(source, drawing_);
  } else {
    drawingLine(source);
  }
}

void Parser::drawingLine(const SourceLine& source) {
  if (place_ == Place::Rung) {
    drawing_.comments.insert(drawing_.comments.end(), comments_.begin(), comments_.end());
    comments_.clear();
    scanDrawingLine(source, drawing_, diagnostics_);
    Rung& rung = result_.rungs.back();
    rung.lastLine = source.number;
    rung.range.end = source.at(source.text.find_last_not_of(' ') + 1);
  } else if (place_ == Place::Outside && rungIsEmpty_) { // the drawing of a rung that was reported as empty
    place_ = Place::Skipped;
  } else if (place_ == Place::Outside) {
    DiagBuilder report = diagnostics_.report(diag::StrayDrawing, source.range());
    report.note("the statement `rung` begins a rung, and its drawing follows on the next line");
    if (!result_.rungs.empty())
      report.note(result_.rungs.back().statement, "this rung's drawing ended at a blank line or another statement");
    place_ = Place::Skipped;
  }
}

void Parser::reportUnknown(const Word& keyword) {
  if (isList_) return; // reported at the list's first line
  DiagBuilder report = diagnostics_.report(diag::UnknownStatement, keyword.range);
  report << keyword.text;
  isList_ = isListLine(words_.words);
  if (isList_) {
    report.note(kListNote);
    return;
  }
  if (keyword.text.starts_with("//") || keyword.text.starts_with('#')) {
    report.note("a comment begins with ';'");
    return;
  }
  const auto foreign = std::ranges::find_if(
      kForeignKeywords, [&](const Keyword& one) { return text::equalsIgnoringCase(one.word, keyword.text); });
  if (foreign != std::end(kForeignKeywords))
    report.note(foreign->meaning);
  else if (keyword.text.ends_with(':'))
    report.note("a label is a box in a rung of its own; `rungc explain` with the dialect lists the boxes");
  else
    suggest(report, keyword.range, text::likeliest(keyword.text, kKeywords, &Keyword::word));
}

/// Splits the line into words; false if a word cannot be read, which is reported.
bool Parser::checkWords(const SourceLine& source) {
  splitWords(source, kRules, words_);
  for (const Word& word : words_.words) {
    if (word.quoted) continue;
    const size_t begin = word.range.begin.value - source.begin.value;
    const size_t bad = findUnprintable(source.text, begin, begin + word.text.size());
    if (bad == begin + word.text.size()) continue;
    reportBadCharacter(source.text, bad, source.begin, diagnostics_);
    return false;
  }
  if (!words_.unterminatedQuote) return true;
  diagnostics_.report(diag::UnterminatedQuote, words_.words.back().range) << '"';
  return false;
}

void Parser::statement(const SourceLine& source) {
  const bool isFirst = !hadStatement_;
  hadStatement_ = true;
  if (!checkWords(source)) {
    // A broken line may have been a `rung` statement: the drawing below it is skipped without further errors.
    place_ = Place::Skipped;
    return;
  }
  const Word& keyword = words_.words.front();
  const bool known = std::ranges::find(kKeywords, keyword.text, &Keyword::word) != std::end(kKeywords);
  if (!known || keyword.quoted) {
    reportUnknown(keyword);
    place_ = Place::Skipped;
    return;
  }
  if (isFirst && keyword.text != "dialect") diagnostics_.report(diag::MissingDialect, keyword.range);
  line_ = source.number;
  dispatch(source, keyword.text);
}

void Parser::dispatch(const SourceLine& source, std::string_view keyword) {
  if (keyword == "rung") return openRung(source);
  if (keyword == "symbol") return declaration(DeclarationKind::Symbol);
  if (keyword == "const") return declaration(DeclarationKind::Const);
  if (keyword == "message") return declaration(DeclarationKind::Message);
  if (keyword == "button") return declaration(DeclarationKind::Button);
  if (keyword == "data") return declaration(DeclarationKind::Data);
  if (keyword == "section") return section();
  if (keyword == "module") return module();
  return dialect();
}

void Parser::malformed(std::string_view form) {
  diagnostics_.report(diag::MalformedStatement, statementRange()) << words_.words.front().text << form;
}

void Parser::dialect() {
  const auto isStatement = [](const Statement& one) { return one.kind < StatementKind::Comment; };
  if (std::ranges::any_of(result_.statements, isStatement)) {
    diagnostics_.report(diag::MisplacedDialect, statementRange());
  } else if (words_.words.size() != 2 || words_.words[1].quoted) {
    malformed("dialect NAME");
  } else {
    result_.dialect = words_.words[1].text;
    result_.dialectRange = words_.words[1].range;
    add(StatementKind::Dialect, 0);
  }
}

void Parser::module() {
  const bool hasText = std::any_of(words_.words.begin(), words_.words.end(), [](const Word& w) { return w.quoted; });
  if (words_.words.size() < 2 || hasText) {
    malformed("module NAME");
    return;
  }
  add(StatementKind::Module, result_.modules.size());
  result_.modules.push_back({{words_.words.begin() + 1, words_.words.end()}, statementRange()});
}

void Parser::declaration(DeclarationKind kind) {
  const bool wantsText = holdsText(kind);
  if (words_.words.size() != 3 || isText(1) || isText(2) != wantsText) {
    if (!wantsText && words_.words.size() > 1 && !isText(1)) result_.badNames.push_back(words_.words[1]);
    switch (kind) {
    case DeclarationKind::Symbol: return malformed("symbol NAME VALUE");
    case DeclarationKind::Const: return malformed("const NAME VALUE");
    case DeclarationKind::Message: return malformed("message NUMBER \"text\"");
    case DeclarationKind::Button: return malformed("button NUMBER \"text\"");
    case DeclarationKind::Data: return malformed("data SECTION \"line\"");
    }
  }
  add(StatementKind::Declaration, result_.declarations.size());
  result_.declarations.push_back({kind, words_.words[1], words_.words[2], words_.comment, statementRange()});
}

void Parser::section() {
  if (words_.words.size() != 2 || !isText(1)) return malformed("section \"title\"");
  add(StatementKind::Section, result_.sections.size());
  result_.sections.push_back({words_.words[1], statementRange()});
}

void Parser::openRung(const SourceLine& source) {
  Rung rung;
  rung.statement = rung.range = statementRange();
  rung.firstLine = rung.lastLine = source.number;
  if (words_.words.size() > 2 || (words_.words.size() == 2 && !isText(1))) {
    malformed("rung or rung \"comment\"");
  } else if (isText(1)) {
    rung.hasComment = true;
    rung.comment = words_.words[1].text;
  }
  if (!result_.modules.empty()) {
    rung.module = static_cast<uint32_t>(result_.modules.size() - 1);
  } else if (!hadOutsideRung_) {
    diagnostics_.report(diag::RungOutsideModule, rung.statement);
    hadOutsideRung_ = true;
  }
  add(StatementKind::Rung, result_.rungs.size());
  result_.rungs.push_back(std::move(rung));
  drawing_.clear();
  rungIsEmpty_ = false;
  place_ = Place::Rung;
}

void Parser::closeRung() {
  if (place_ == Place::Rung) finishRung(result_.rungs.back());
  place_ = Place::Outside;
  for (const Comment& comment : std::exchange(comments_, {})) {
    result_.statements.push_back(
        {StatementKind::Comment, static_cast<uint32_t>(result_.comments.size()), comment.line});
    result_.comments.push_back(comment);
  }
}

void Parser::finishRung(Rung& rung) {
  if (!drawing_.bad && drawing_.elements.empty()) {
    diagnostics_.report(diag::EmptyRung, rung.statement)
        .note("its drawing begins on the next line, without a blank line between");
    drawing_.bad = true;
    rungIsEmpty_ = true;
  }
  Diagnostics discarded; // further errors in a drawing that could not be read are consequences of the first
  dropRightRail(drawing_);
  groupPins(drawing_, findBox_, drawing_.bad ? discarded : diagnostics_);
  wireUp(drawing_, rung, drawing_.bad ? discarded : diagnostics_);
  rung.comments = std::move(drawing_.comments);
  rung.bad = drawing_.bad;
  if (!rung.bad) orderElements(rung, diagnostics_);
}

} // namespace

LadderFile parseLadder(const SourceManager& sources, FileId file, Diagnostics& diagnostics, FindBox findBox) {
  return Parser(sources, file, diagnostics, findBox).run();
}

std::vector<std::string_view> boxWords(std::string_view drawing) {
  std::vector<std::string_view> words;
  for (size_t at = drawing.find('{'); at != std::string_view::npos; at = drawing.find('{', at + 1)) {
    const size_t begin = std::min(drawing.find_first_not_of(' ', at + 1), drawing.size());
    words.push_back(drawing.substr(begin, drawing.find_first_of(" }\n", begin) - begin));
  }
  return words;
}

std::string_view peekDialect(const SourceManager& sources, FileId file) {
  LineReader lines(sources, file);
  LineWords words;
  for (SourceLine line; lines.next(line);) {
    splitWords(line, kRules, words);
    if (words.words.empty()) continue;
    const bool found = words.words.size() == 2 && text::equalsIgnoringCase(words.words[0].text, "dialect") &&
                       !words.words[0].quoted; // the parser reports a keyword in the wrong case
    return found ? words.words[1].text : std::string_view();
  }
  return {};
}

// Scans the lines of a rung again that was parsed before.

Drawing readDrawing(const SourceManager& sources, FileId file, const Rung& rung, FindBox findBox) {
  Drawing drawing;
  Diagnostics discarded;
  const char* const begin = sources.text(file).data();
  for (uint32_t number = rung.firstLine + 1; number <= rung.lastLine; ++number) {
    const std::string_view text = sources.lineText(file, number);
    const size_t first = text.find_first_not_of(' ');
    if (first == std::string_view::npos || text[first] == ';') continue;
    const auto offset = static_cast<size_t>(text.data() - begin);
    scanDrawingLine({number, text, sources.position(file, offset)}, drawing, discarded);
  }
  dropRightRail(drawing);
  groupPins(drawing, findBox, discarded);
  RUNG_CHECK(!drawing.bad, "the rung was parsed without errors");
  return drawing;
}

} // namespace rung::frontend::ladder

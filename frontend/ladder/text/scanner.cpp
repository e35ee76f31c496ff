// Scans one line of a drawing into tokens and elements.
#include <algorithm>
#include <optional>
#include <span>

#include <fmt/format.h>

#include "frontend/ladder/text/drawing.h"
#include "frontend/syntax/word_lexer.h"
#include "ir/support/diag/ladder.h"
#include "ir/support/diag/source.h"
#include "ir/support/utf8.h"
#include "rtlib/text/blanks.h"
#include "rtlib/text/letters.h"

namespace rung::frontend::ladder {
namespace {

constexpr std::string_view kContactForms = "[x], with '/', '@' or '%' before x, which is one operand without blanks";
constexpr std::string_view kCoilForms = "(x), (/x), (S x) or (R x), where x is one operand without blanks";
constexpr std::string_view kBoxForms = "{MNEMONIC operands}";

/// A word before the operand of a contact or coil in other ladders, and how it is drawn here; `same`: both mean the
/// same.
struct ForeignMark {
  std::string_view word;
  std::string_view here;
  bool same = true;
};
constexpr ForeignMark kContactMarks[] = {{"NOT", "[/"},      {"!", "[/"},      {"~", "[/"},      {"P", "[@"},
                                         {"N", "[%", false}, {"R_TRIG", "[@"}, {"F_TRIG", "[%"}, {"-", "[/", false}};
constexpr ForeignMark kCoilMarks[] = {{"SET", "(S "},
                                      {"S", "(S "},
                                      {"RST", "(R "},
                                      {"RESET", "(R "},
                                      {"R", "(R "},
                                      {"NOT", "(/"},
                                      {"!", "(/"},
                                      {"~", "(/"},
                                      {"L", "(S ", false},
                                      {"U", "(R ", false},
                                      {"OTL", "(S "},
                                      {"OTU", "(R "},
                                      {"LATCH", "(S ", false},
                                      {"UNLATCH", "(R ", false}};

bool isWire(char c) { return c == '-' || c == '+'; }
bool isPrintable(char c) { return c > ' ' && c < 0x7F; }

class LineScanner {
public:
  LineScanner(const SourceLine& line, Drawing& drawing, Diagnostics& diagnostics)
      : line_(line), text_(line.text), drawing_(drawing), diagnostics_(diagnostics) {}

  void run() {
    DrawnLine drawn{line_, {static_cast<uint32_t>(drawing_.tokens.size()), 0}};
    while (good_ && at_ < text_.size() && text_[at_] != ';') step();
    if (!good_) unread();
    drawn.tokens.count = static_cast<uint32_t>(drawing_.tokens.size()) - drawn.tokens.first;
    if (good_ && at_ < text_.size()) drawing_.comments.push_back(commentFrom(line_, at_));
    drawing_.lines.push_back(drawn);
  }

  void skip() {
    const auto first = static_cast<uint32_t>(drawing_.tokens.size());
    unread();
    drawing_.lines.push_back({line_, {first, 1}});
  }

private:
  void step();
  void wire();
  void element();
  void skipBad(size_t begin);
  void unread();
  void addError(size_t begin, size_t end);
  void countContinuations(size_t begin);
  void strayText();
  size_t emptyBarsEnd() const;
  void emptyBars(size_t end);
  void noteContact(DiagBuilder& report, size_t end) const;
  bool contact(Element& element);
  bool coil(Element& element);
  bool box(Element& element);
  bool operand(Element& element, size_t begin, size_t end, std::string_view forms);
  std::optional<size_t> simpleEnd(char close);
  size_t boxWordEnd(size_t begin) const;

  size_t skipBlanks(size_t begin, size_t end) const {
    while (begin < end && text_[begin] == ' ') ++begin;
    return begin;
  }
  size_t dropBlanks(size_t begin, size_t end) const {
    while (end > begin && text_[end - 1] == ' ') --end;
    return end;
  }
  void push(TokenKind kind, size_t begin, size_t end, uint32_t element) {
    drawing_.tokens.push_back({kind, static_cast<uint32_t>(begin), static_cast<uint32_t>(end),
                               static_cast<uint32_t>(begin - continuations_), element});
  }
  void pushOperand(size_t begin, size_t end, bool quoted) {
    const size_t quote = quoted ? 1 : 0;
    drawing_.operands.push_back(
        {text_.substr(begin + quote, end - begin - 2 * quote), line_.range(begin, end), quoted});
  }
  bool unclosed(size_t end, char close);
  bool badElement(size_t end, std::string_view forms);
  bool severalWords(const Element& element, size_t begin, size_t end, std::string_view forms);
  bool misplacedNegation(const Element& element, size_t begin, size_t end, std::string_view forms);
  void meant(DiagBuilder& report, std::string drawn, bool certain) const;
  bool badCharacter(size_t offset);

  const SourceLine& line_;
  std::string_view text_;
  Drawing& drawing_;
  Diagnostics& diagnostics_;
  size_t at_ = 0;
  size_t continuations_ = 0; ///< continuation bytes so far: byte offset − this = column
  bool good_ = true;
  size_t badEnd_ = 0; ///< end of the closing bracket of an element that was reported; 0 if it has none
};

void LineScanner::step() {
  const char c = text_[at_];
  if (c == ' ') {
    at_ = skipBlanks(at_, text_.size());
  } else if (const size_t end = emptyBarsEnd(); end != 0) {
    emptyBars(end);
  } else if (c == '|') {
    push(at_ == 0 ? TokenKind::Rail : TokenKind::Bar, at_, at_ + 1, kNone);
    ++at_;
  } else if (isWire(c)) {
    wire();
  } else if (c == '[' || c == '(' || c == '{') {
    element();
  } else {
    strayText();
  }
}

void LineScanner::wire() {
  size_t end = at_;
  while (end < text_.size() && isWire(text_[end])) ++end;
  push(TokenKind::Wire, at_, end, kNone);
  at_ = end;
}

void LineScanner::strayText() {
  good_ = false;
  size_t end = at_;
  while (end < text_.size() && isPrintable(text_[end]) && !isWire(text_[end]) && text_[end] != '|') ++end;
  if (end == at_) {
    badCharacter(at_);
    return;
  }
  DiagBuilder report = diagnostics_.report(diag::StrayText, line_.range(at_, end));
  report << text_.substr(at_, end - at_);
  noteContact(report, end);
}

/// Detects `-| |-`, a contact whose name may be above it; returns its end, or 0.
size_t LineScanner::emptyBarsEnd() const {
  if (at_ == 0 || text_[at_] != '|' || !isWire(text_[at_ - 1])) return 0;
  const size_t second = skipBlanks(at_ + 1, text_.size());
  const bool isContact = second + 1 < text_.size() && text_[second] == '|' && isWire(text_[second + 1]);
  return isContact ? second + 1 : 0;
}

void LineScanner::emptyBars(size_t end) {
  diagnostics_.report(diag::StrayText, line_.range(at_, end)).note("a contact is drawn as [x], a closed one as [/x]")
      << text_.substr(at_, end - at_);
  badEnd_ = end;
  skipBad(at_);
}

/// Adds a note for `-|A|-`, `-| /A |-` and `-] [-`, contacts of other ladders.
void LineScanner::noteContact(DiagBuilder& report, size_t end) const {
  const std::string_view word = text_.substr(at_, end - at_);
  const size_t before = text_.find_last_not_of(' ', at_ - 1);
  const size_t after = skipBlanks(end, text_.size());
  const bool barred = before < at_ && text_[before] == '|' && after < text_.size() && text_[after] == '|';
  if (word.starts_with(']') || (barred && word == "/"))
    report.note(fmt::format("a {}contact is drawn as [{}x]", barred ? "closed " : "", barred ? "/" : ""));
  else if (barred)
    report.note(fmt::format("a contact is drawn as [{}]", word));
}

void LineScanner::element() {
  const size_t begin = at_;
  const size_t operands = drawing_.operands.size();
  Element element;
  element.operands.first = static_cast<uint32_t>(operands);
  element.line = line_.number;
  element.column = static_cast<uint32_t>(begin - continuations_ + 1);
  switch (text_[begin]) {
  case '[': good_ = contact(element); break;
  case '(': good_ = coil(element); break;
  case '{': good_ = box(element); break;
  }
  if (!good_) {
    drawing_.operands.resize(operands);
    if (badEnd_ != 0) skipBad(begin);
    return;
  }
  element.range = line_.range(begin, at_);
  element.operands.count = static_cast<uint32_t>(drawing_.operands.size()) - element.operands.first;
  push(TokenKind::Element, begin, at_, static_cast<uint32_t>(drawing_.elements.size()));
  drawing_.elements.push_back(element);
  countContinuations(begin);
}

/// Skips a bad element whose end is known; scanning continues after it.
void LineScanner::skipBad(size_t begin) {
  addError(begin, badEnd_);
  at_ = badEnd_;
  countContinuations(begin);
  badEnd_ = 0;
  good_ = true;
}

/// Marks the rest of the line as unread.
void LineScanner::unread() { addError(at_, text_.size()); }

void LineScanner::addError(size_t begin, size_t end) {
  drawing_.bad = true;
  Element element;
  element.kind = ElementKind::Error;
  element.operands.first = static_cast<uint32_t>(drawing_.operands.size());
  element.range = line_.range(begin, dropBlanks(begin, end));
  element.line = line_.number;
  element.column = static_cast<uint32_t>(begin - continuations_ + 1);
  push(TokenKind::Element, begin, end, static_cast<uint32_t>(drawing_.elements.size()));
  drawing_.elements.push_back(element);
}

/// Counts the continuation bytes of an element, from `begin` to the current position.
void LineScanner::countContinuations(size_t begin) {
  const std::string_view drawn = text_.substr(begin, at_ - begin);
  continuations_ += drawn.size() - countCodePoints(drawn);
}

bool LineScanner::unclosed(size_t end, char close) {
  diagnostics_.report(diag::UnclosedElement, line_.range(at_, dropBlanks(at_ + 1, end))) << close;
  return false;
}

bool LineScanner::badElement(size_t end, std::string_view forms) {
  badEnd_ = end;
  diagnostics_.report(diag::BadElement, line_.range(at_, end)) << forms;
  return false;
}

/// Reports several words where one operand is expected.
bool LineScanner::severalWords(const Element& element, size_t begin, size_t end, std::string_view forms) {
  const bool contact = element.kind == ElementKind::Contact;
  badEnd_ = text_.find_first_of("])", end) + 1;
  const std::string_view words = text_.substr(begin, end - begin);
  const std::string_view first = words.substr(0, words.find(' '));
  const std::string_view rest = words.substr(skipBlanks(begin + first.size(), end) - begin);
  DiagBuilder report = diagnostics_.report(diag::BadElement, line_.range(at_, badEnd_));
  report << forms;
  const std::span<const ForeignMark> marks = contact ? std::span<const ForeignMark>(kContactMarks) : kCoilMarks;
  const auto mark =
      std::ranges::find_if(marks, [&](const ForeignMark& one) { return text::equalsIgnoringCase(one.word, first); });
  const bool isOperand = rest.find(' ') == std::string_view::npos && rest.find_first_of("/!#@%") != 0;
  if (mark != marks.end() && !element.negated && element.edge == 0 && isOperand)
    meant(report, fmt::format("{}{}", mark->here, rest), mark->same);
  else if (contact && mark == marks.end())
    report.note("contacts in series are drawn one after the other, contacts in parallel in branches");
  else if (mark == marks.end())
    report.note(fmt::format("an instruction is a box, which has braces: {{{}}}", words));
  return false;
}

/// Suggests what a bad element was meant to be; `drawn` lacks the closing bracket. A fix keeps the element's width.
void LineScanner::meant(DiagBuilder& report, std::string drawn, bool certain) const {
  const char close = text_[badEnd_ - 1];
  const size_t wide = badEnd_ - at_ - 1;
  report.note(fmt::format("did you mean {}{}?", drawn, close));
  if (!certain || drawn.size() > wide) return;
  drawn.resize(wide, ' ');
  report.fix(line_.range(at_, badEnd_), drawn + close);
}

/// Reports the negation of other languages, `~x`, or a negation after the edge, `@/x`.
bool LineScanner::misplacedNegation(const Element& element, size_t begin, size_t end, std::string_view forms) {
  badEnd_ = text_.find_first_of("])", end) + 1;
  DiagBuilder report = diagnostics_.report(diag::BadElement, line_.range(at_, badEnd_));
  report << forms;
  const std::string_view edge(&element.edge, element.edge != 0 ? 1 : 0);
  if (!element.negated && element.coil == CoilKind::Plain)
    meant(report, fmt::format("{}/{}{}", text_[at_], edge, text_.substr(begin + 1, end - begin - 1)), true);
  return false;
}

bool LineScanner::badCharacter(size_t offset) {
  reportBadCharacter(line_.text, offset, line_.begin, diagnostics_);
  return false;
}

/// Position of the closing bracket of a contact or coil; no other bracket may come before it.
std::optional<size_t> LineScanner::simpleEnd(char close) {
  const size_t end = text_.find_first_of("[](){}", at_ + 1);
  if (end != std::string_view::npos && text_[end] == close) return end;
  unclosed(std::min(end, text_.size()), close);
  return std::nullopt;
}

/// Scans the operand of a contact or coil, with an optional edge before it.
bool LineScanner::operand(Element& element, size_t begin, size_t end, std::string_view forms) {
  if (begin < end && (text_[begin] == '@' || text_[begin] == '%')) {
    element.edge = text_[begin];
    begin = skipBlanks(begin + 1, end);
  }
  const std::string_view word = text_.substr(begin, end - begin);
  const size_t bad = findUnprintable(text_, begin, end);
  if (bad != end && text_[bad] != ' ') {
    badEnd_ = text_.find_first_of("])", end) + 1;
    return badCharacter(bad);
  }
  // A comparison such as `a > 5` is left to the dialect, which knows the right instruction.
  const bool compares = element.kind == ElementKind::Contact && word.find_first_of("<>=") != std::string_view::npos;
  if (word.find(' ') != std::string_view::npos && !compares) return severalWords(element, begin, end, forms);
  if (word.empty()) return badElement(text_.find_first_of("])", end) + 1, forms);
  if (word[0] == '~' || word[0] == '/') return misplacedNegation(element, begin, end, forms);
  pushOperand(begin, end, false);
  return true;
}

bool LineScanner::contact(Element& element) {
  const std::optional<size_t> close = simpleEnd(']');
  if (!close) return false;
  size_t begin = skipBlanks(at_ + 1, *close);
  const size_t end = dropBlanks(begin, *close);
  element.kind = ElementKind::Contact;
  if (begin < end && text_[begin] == '/') {
    element.negated = true;
    begin = skipBlanks(begin + 1, end);
  }
  if (!operand(element, begin, end, kContactForms)) return false;
  at_ = *close + 1;
  return true;
}

/// Scans a coil. The second word distinguishes `(S x)` and `(R x)` from a coil on S or R.
bool LineScanner::coil(Element& element) {
  const std::optional<size_t> close = simpleEnd(')');
  if (!close) return false;
  size_t begin = skipBlanks(at_ + 1, *close);
  const size_t end = dropBlanks(begin, *close);
  element.kind = ElementKind::Coil;
  const size_t second = skipBlanks(std::min(begin + 1, end), end);
  if (second > begin + 1 && second < end && (text_[begin] == 'S' || text_[begin] == 'R')) {
    element.coil = text_[begin] == 'S' ? CoilKind::Set : CoilKind::Reset;
    begin = second;
  } else if (begin < end && text_[begin] == '/') {
    element.coil = CoilKind::Negated;
    begin = skipBlanks(begin + 1, end);
  }
  if (!operand(element, begin, end, kCoilForms)) return false;
  at_ = *close + 1;
  return true;
}

size_t LineScanner::boxWordEnd(size_t begin) const {
  size_t end = begin;
  while (end < text_.size() && isPrintable(text_[end]) && text_[end] != '{' && text_[end] != '}' && text_[end] != '"')
    ++end;
  return end;
}

/// Scans a box. The first word is the mnemonic (in a pin line, the name of the pin).
bool LineScanner::box(Element& element) {
  element.kind = ElementKind::Box;
  const uint32_t first = element.operands.first;
  size_t at = at_ + 1;
  for (;; at = skipBlanks(at, text_.size())) {
    if (at >= text_.size() || text_[at] == '{') return unclosed(at, '}');
    if (text_[at] == '}') break;
    size_t end = boxWordEnd(at);
    const bool quoted = text_[at] == '"';
    if (quoted) {
      const size_t close = text_.find('"', at + 1);
      if (close == std::string_view::npos) {
        diagnostics_.report(diag::UnterminatedQuote, line_.range(at, text_.size())) << '"';
        return false;
      }
      end = close + 1;
    } else if (end == at && text_[at] != ' ') {
      return badCharacter(at);
    }
    if (end > at) pushOperand(at, end, quoted);
    at = end;
  }
  if (drawing_.operands.size() == first || drawing_.operands[first].quoted) return badElement(at + 1, kBoxForms);
  element.mnemonic = drawing_.operands[first].text;
  element.mnemonicRange = drawing_.operands[first].range;
  ++element.operands.first;
  at_ = at + 1;
  return true;
}

} // namespace

void Drawing::clear() {
  lines.clear();
  tokens.clear();
  elements.clear();
  headOf.clear();
  nextPin.clear();
  operands.clear();
  comments.clear();
  bad = false;
}

void scanDrawingLine(const SourceLine& line, Drawing& drawing, Diagnostics& diagnostics) {
  LineScanner(line, drawing, diagnostics).run();
}

void addUnreadLine(const SourceLine& line, Drawing& drawing) {
  Diagnostics discarded;
  LineScanner(line, drawing, discarded).skip();
}

Comment commentFrom(const SourceLine& line, size_t begin) {
  const std::string_view text = text::trimmed(line.text.substr(begin + 1));
  const size_t end = line.text.find_last_not_of(" \t\r") + 1;
  return {text, line.range(begin, end), line.number, line.text.find_first_not_of(" \t") == begin};
}

size_t findUnprintable(std::string_view text, size_t begin, size_t end) {
  const auto* const found = std::find_if_not(text.begin() + begin, text.begin() + end, isPrintable);
  return static_cast<size_t>(found - text.begin());
}

} // namespace rung::frontend::ladder

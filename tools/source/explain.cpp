// See explain.h.
#include "tools/source/explain.h"

#include <filesystem>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "compiler/reference.h"
#include "frontend/ladder/text/keywords.h"
#include "frontend/syntax/word_lexer.h"
#include "ir/support/put.h"
#include "ir/support/utf8.h"
#include "rtlib/load/program_info.h"
#include "rtlib/nc/names/names.h"
#include "rtlib/text/blanks.h"
#include "rtlib/text/letters.h"
#include "tools/report/odd_names.h"
#include "tools/report/place_names.h"

namespace rung::source {

using frontend::Analysis;
using frontend::Definition;

const Definition* definitionOf(const Analysis& analysis, std::string_view name) {
  const Definition* found = nullptr;
  for (const Definition& definition : analysis.definitions()) {
    if (definition.name == name) return &definition;
    if (found == nullptr && text::equalsIgnoringCase(definition.name, name)) found = &definition;
  }
  return found;
}

size_t markLength(std::string_view line) { return line.starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0; }

bool endsWord(char c) { return std::string_view(" \t[](){}|;,\"'").find(c) != std::string_view::npos; }

std::string_view wordAt(std::string_view line, size_t at) {
  size_t begin = at;
  size_t end = at;
  while (begin > 0 && !endsWord(line[begin - 1])) --begin;
  while (end < line.size() && !endsWord(line[end])) ++end;
  return line.substr(begin, end - begin);
}

namespace {

std::string typeText(const rung_symbol& symbol) {
  const runtime::Ref place = runtime::refOf(symbol);
  const bool isText = place.kind == runtime::RefKind::Text;
  const std::string cell = isText                                 ? fmt::format("text of {} bytes", place.count)
                           : place.kind == runtime::RefKind::Real ? "real number"
                           : place.kind == runtime::RefKind::Bit  ? "bit"
                                                                  : fmt::format("integer of {} bits", place.width);
  return isText || place.count <= 1 ? cell : fmt::format("{} times {}", place.count, cell);
}

class Explainer {
public:
  // The reference has the names of places and the rungs that use them.
  explicit Explainer(const CheckedText& text)
      : sources_(text.sources), analysis_(text.analysis), reference_(text.reference) {}

  // The operand or name at the position; "" if there is none. `word`: everything written there up to blanks.
  std::string at(SourcePos at, const std::string& word) {
    if (const frontend::OperandUse* operand = analysis_.operandAt(at)) {
      put(out_, "{}: {} here{}\n", sources_.text(operand->range), nameOf(operand->access),
          operand->computed.empty() ? "" : fmt::format(", with '{}' added at run time", operand->computed));
      if (operand->base != frontend::kNoDefinition) define(analysis_.definitions()[operand->base]);
      uses(operand->place);
    } else if (const frontend::TargetUse* target = analysis_.targetAt(at)) {
      targets(*target);
    } else if (const Definition* name = analysis_.nameAt(at)) {
      if (std::string bit = text::equalsIgnoringCase(name->name, word) ? "" : addressed(word); !bit.empty()) return bit;
      explain(*name);
    } else if (const Definition* declared = analysis_.declaredAt(at)) {
      explain(*declared);
    }
    return ended();
  }

  // For a name or an address. "" if the program has neither.
  std::string word(const std::string& word) {
    const Definition* definition = definitionOf(analysis_, word);
    if (definition == nullptr) return addressed(word);
    explain(*definition);
    return ended();
  }

private:
  // For an address: its names, and the rungs that use it. "" if the program has neither.
  std::string addressed(const std::string& address) {
    if (reference_ == nullptr) return {};
    const auto place = nc::resolve(reference_->program(), address);
    if (!place || place->kind == runtime::RefKind::Constant) return {};
    for (const Definition& definition : analysis_.definitions())
      if (definition.range.valid() && isAt(definition.place, *place)) {
        put(out_, "{} is {}: {}\n", address, definition.name, typeOf(definition));
        define(definition);
      }
    const report::Entry entry = reference_->of(*place);
    if (!out_.empty() || !entry.accesses.empty()) show(entry);
    return std::move(out_);
  }

  std::string ended() {
    if (reference_ == nullptr && !out_.empty())
      out_ += "\nThe program has errors, so what its rungs do is not known: `rungc check` lists the errors.\n";
    return std::move(out_);
  }
  std::string placeOf(SourceRange range) const {
    const LineCol at = sources_.lineCol(range.begin);
    return fmt::format("{}:{}:{}", at.file, at.line, at.column);
  }

  void explain(const Definition& definition) {
    put(out_, "{}: {}\n", definition.name, definition.isConstant() ? definition.value : typeOf(definition));
    define(definition);
    if (!definition.isConstant()) uses(definition.place);
  }
  std::string typeOf(const Definition& definition) const {
    if (reference_ != nullptr)
      if (const rung_symbol* symbol = runtime::findSymbol(reference_->program(), definition.name))
        return typeText(*symbol);
    if (!hasPlace(definition)) return "a name without a place in memory";
    return definition.place.bits == 1 ? "bit" : fmt::format("{} bits", definition.place.bits);
  }
  void define(const Definition& definition) {
    if (!definition.comment.empty()) put(out_, "  {}\n", compiler::withoutManualLines(definition.comment));
    if (!definition.range.valid()) return;
    put(out_, "  declared at {}\n", placeOf(definition.range));
    if (reference_ == nullptr || !hasPlace(definition)) // otherwise the rungs that use it are shown
      put(out_, "  {}\n", text::trimmed(sources_.lineText(definition.range.begin)));
  }
  static bool hasPlace(const Definition& definition) { return definition.isConstant() || definition.place.bits != 0; }
  void uses(const frontend::NamedPlace& place) {
    if (reference_ == nullptr) return;
    const auto bits = report::rangeOf(reference_->program(), place);
    if (!bits) return;
    show(reference_->of(report::refAt(*bits)));
  }
  void show(const report::Entry& entry) {
    std::vector<report::Entry> entries{entry};
    report::markOdd(sources_, analysis_, *reference_, entries);
    put(out_, "{}{}", out_.empty() ? "" : "\n", report::shownAsText(*reference_, entries, true));
  }
  bool isAt(const frontend::NamedPlace& named, const runtime::Ref& place) const {
    const auto bits = report::rangeOf(reference_->program(), named);
    return bits && *bits == report::bitsOf(place);
  }
  void targets(const frontend::TargetUse& here) {
    put(out_, "{}: {}\n", sources_.text(here.range), here.defines ? "a label or subprogram" : "control goes there");
    for (const frontend::TargetUse& use : analysis_.targets())
      if (use.scope == here.scope && use.number == here.number)
        put(out_, "  {} {}\n", use.defines ? "is at  " : "asked at", placeOf(use.range));
  }

  const SourceManager& sources_;
  const Analysis& analysis_;
  const report::CrossReference* reference_;
  std::string out_;
};

frontend::LineWords wordsOf(const SourceManager& sources, SourcePos at) {
  const std::string_view text = sources.lineText(at);
  const size_t mark = markLength(text);
  const frontend::SourceLine line{
      sources.lineCol(at).line,
      text.substr(mark),
      {at.value - static_cast<uint32_t>(sources.offsetOf(at) - sources.lineStart(at).offset - mark)}};
  frontend::LineWords words;
  splitWords(line, {.comment = ';', .quotes = "\"'", .separators = {}}, words);
  return words;
}

// The title, text or comment at the position; "" for anything else.
std::string_view proseAt(const frontend::LineWords& words, SourcePos at) {
  const auto isIn = [&](SourceRange range) { return range.begin <= at && at < range.end; };
  if (words.hasComment && isIn(words.commentRange)) return "a comment";
  for (const frontend::Word& word : words.words) {
    if (!word.quoted || !isIn(word.range)) continue;
    const std::string_view first = words.words.front().text;
    if (first == "rung") return "the title of a rung";
    return first == "section" ? "the title of a section" : "a text";
  }
  return {};
}

// A number as the dialects write it, perhaps after its type: #5, *1.5, 40h, CNST.0.
bool isNumber(std::string_view word) {
  if (const size_t point = word.find('.'); point != std::string_view::npos && point > 0 && text::isLetter(word[0]))
    word.remove_prefix(point + 1);
  const size_t first = word.find_first_not_of("#*$+-.");
  if (first == std::string_view::npos) return false;
  return text::isDigit(word[first]) || word.substr(0, first).find_first_of("#*") != std::string_view::npos;
}

// The marks before an operand in its brackets.
std::string_view markAt(std::string_view line, size_t at) {
  const size_t open = at == 0 ? std::string_view::npos : line.find_last_of("[(", at);
  if (open == std::string_view::npos) return {};
  const std::string_view before = line.substr(open + 1, at - open - 1);
  if (before.find_first_not_of("/@%") != std::string_view::npos) return {};
  const bool coil = line[open] == '(';
  switch (line[at]) {
  case '/': return coil ? "the coil is negated" : "the contact is normally closed";
  case '@': return "at the rising edge";
  case '%': return "at the falling edge";
  case 'S':
  case 'R':
    if (!coil || line.substr(at + 1, 1) != " ") return {};
    return line[at] == 'S' ? "the coil sets its bit, and leaves it without power"
                           : "the coil resets its bit, and leaves it without power";
  default: return {};
  }
}

// Explains words by their position in a statement: a keyword, or what follows it.
std::string explainStatementWord(const frontend::LineWords& words, std::string_view word) {
  if (words.words.empty()) return {};
  const std::string_view first = words.words[0].text;
  const auto keyword = std::ranges::find(frontend::ladder::kKeywords, first, &frontend::ladder::Keyword::word);
  if (keyword == std::end(frontend::ladder::kKeywords)) return {};
  if (word == first) return fmt::format("{}: {}\n", word, keyword->meaning);
  if (first == "dialect") return fmt::format("{}: the control that the program is for\n", word);
  if (first == "module") return fmt::format("{}: the name of the module\n", word);
  return first == "message" || first == "button" ? fmt::format("{}: the number of the {}\n", word, first) : "";
}

// Explains what is written at a position.
class WordExplainer {
public:
  WordExplainer(const CheckedText& program, SourcePos at)
      : program_(program), sources_(program.sources), dialect_(program.dialect), at_(at), words_(wordsOf(sources_, at)),
        line_(sources_.lineText(at).substr(markLength(sources_.lineText(at)))),
        offset_(sources_.offsetOf(at) - sources_.lineStart(at).offset - markLength(sources_.lineText(at))) {}

  Explanation run() const {
    Explanation explanation = meaning();
    explanation.errors = errorsIn(wordRange());
    return explanation;
  }

private:
  SourceRange wordRange() const {
    const std::string_view word = wordAt(line_, offset_);
    const auto before = static_cast<uint32_t>(offset_ - static_cast<size_t>(word.data() - line_.data()));
    return {{at_.value - before}, {at_.value - before + static_cast<uint32_t>(word.size())}};
  }

  Explanation meaning() const {
    if (std::string text = explainer().at(at_, std::string(wordAt(line_, offset_))); !text.empty())
      return {.program = std::move(text)};
    if (const frontend::InstructionUse* use = program_.analysis.instructionAt(at_))
      if (auto text = compiler::explain(use->instruction->mnemonic, &dialect_)) return {.reference = std::move(*text)};
    if (const std::string_view prose = proseAt(words_, at_); !prose.empty())
      return {.program = fmt::format("{}\n", prose)};
    const char c = line_[offset_];
    if (c == ' ' || c == '\t') return {.program = "a blank\n"};
    if (isDrawn())
      if (const std::string_view mark = markAt(line_, offset_); !mark.empty()) return {.program = marked(mark)};
    if (c != '|' && endsWord(c))
      return {.program = fmt::format("'{}': nothing by itself; name the place of what is beside it\n", c)};
    const std::string word(wordAt(line_, offset_));
    if (c == '|' || word.find_first_not_of("+-") == std::string::npos)
      return {.program = isDrawn() ? "a wire\n" : fmt::format("'{}': nothing is given here\n", word)};
    return ofWord(word);
  }

  // Within the word.
  std::string errorsIn(SourceRange word) const {
    std::string text;
    for (const Diagnostic& one : program_.diagnostics.reported())
      if (one.severity == Severity::Error && one.range.valid() && word.begin <= one.range.begin &&
          one.range.end <= word.end)
        put(text, "error here: {} [{}]\n", messageOf(one), diagInfo(one.id).code);
    return text;
  }

  Explainer explainer() const { return Explainer(program_); }
  bool isDrawn() const { return dialect_.findBox != nullptr; }

  // With the operand to which the mark belongs.
  std::string marked(std::string_view mark) const {
    const size_t next = line_[offset_] == 'S' || line_[offset_] == 'R' ? line_.find_first_not_of(' ', offset_ + 1)
                                                                       : line_.find_first_not_of("/@%", offset_);
    return fmt::format(
        "'{}': {}\n{}", line_[offset_], mark,
        next == std::string_view::npos
            ? std::string()
            : explainer().at({at_.value + static_cast<uint32_t>(next - offset_)}, std::string(wordAt(line_, next))));
  }

  Explanation ofWord(const std::string& word) const {
    if (isDrawn())
      if (std::string text = explainStatementWord(words_, word); !text.empty()) return {.program = std::move(text)};
    Explanation both{.reference = compiler::explain(word, &dialect_).value_or(""), .program = explainer().word(word)};
    if (both.empty()) both.program = ofUnknown(word);
    return both;
  }

  std::string ofUnknown(const std::string& word) const {
    if (isNumber(word)) return fmt::format("'{}': a constant\n", word);
    if (const size_t begin = static_cast<size_t>(wordAt(line_, offset_).data() - line_.data());
        isDrawn() && begin > 0 && line_[begin - 1] == '{')
      return fmt::format("'{}': an input of the box that begins above\n", word);
    for (uint32_t i = 0; i < sources_.fileCount(); ++i)
      if (std::filesystem::path(sources_.name(FileId{i})).filename() == word)
        return fmt::format("'{}': a file of the program\n", word);
    return fmt::format("'{}': neither a name of the program nor an instruction or a signal of {}\n", word,
                       dialect_.name);
  }

  const CheckedText& program_;
  const SourceManager& sources_;
  const frontend::Dialect& dialect_;
  const SourcePos at_;
  const frontend::LineWords words_;
  const std::string_view line_;
  const size_t offset_; // offset in the line
};

} // namespace

Explanation explain(const CheckedText& text, SourcePos at) { return WordExplainer(text, at).run(); }

std::string explainName(const CheckedText& text, const std::string& word) { return Explainer(text).word(word); }

} // namespace rung::source

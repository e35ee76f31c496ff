// One statement of a scenario: a parser with a function for each row of statements.def, and the table of the rows.
#include "tools/scenario/statements.h"

#include <algorithm>
#include <fmt/format.h>

#include "rtlib/text/blanks.h"
#include "rtlib/text/letters.h"
#include "rtlib/text/number.h"
#include "rtlib/text/similar.h"
#include "tools/scenario/session.h"
#include "tools/scenario/words.h"

namespace rung::scenario {
namespace {

// Words that users of other tools may write.
struct Synonym {
  std::string_view word;
  std::string_view statement;
};
constexpr Synonym kSynonyms[] = {{"wait", "run"},     {"sleep", "run"},    {"delay", "run"},     {"assert", "expect"},
                                 {"check", "expect"}, {"test", "expect"},  {"write", "set"},     {"force", "set"},
                                 {"step", "scan"},    {"cycle", "scan"},   {"echo", "print"},    {"show", "print"},
                                 {"log", "print"},    {"load", "program"}, {"import", "include"}};

std::string_view wordOf(const StatementInfo& info) { return info.form.word; }

bool startsWithDigit(std::string_view text) { return !text.empty() && text::isDigit(text[0]); }

} // namespace

class LineParser {
public:
  explicit LineParser(std::vector<ScenarioWord> words) : words_(std::move(words)) {}

  ParsedLine run();

private:
  friend struct StatementInfo; // its rows refer to the functions that parse statements

  bool done() const { return next_ >= words_.size(); }
  const std::string& word() const { return words_[next_].text; }
  bool fail(std::string message) {
    if (error_.empty()) error_ = std::move(message);
    return false;
  }
  bool takeWord(std::string& into, std::string_view what) {
    if (done()) return fail(fmt::format("expected {}", what));
    into = words_[next_++].text;
    return true;
  }
  bool notAValue(const std::string& text);
  bool notHeld(const std::string& number) {
    return fail(
        fmt::format("no variable can hold {}: a real number is 5e-324 to 1.8e308, an integer has 64 bits", number));
  }
  bool takeValue(Value& into, bool numeric = false) {
    if (done()) return fail("expected a value");
    const ScenarioWord& word = words_[next_++];
    into = valueOf(word);
    if (into.kind == ValueKind::Text && !word.quoted) return notAValue(word.text);
    if (numeric && into.kind == ValueKind::Text) return fail("expected a number");
    return true;
  }
  bool count();
  bool duration();
  bool text() {
    if (done()) return fail("expected a text");
    s_.value.kind = ValueKind::Text;
    for (; !done(); ++next_) s_.value.text += (s_.value.text.empty() ? "" : " ") + word();
    return true;
  }
  bool takeKeys(std::vector<KeyValue>& into) {
    for (; !done() && word() != "->"; ++next_) {
      const size_t equals = word().find('=');
      if (equals == std::string::npos || equals == 0)
        return fail(fmt::format("expected KEY=VALUE, found '{}'", word()));
      into.push_back({word().substr(0, equals), valueOfKey(word().substr(equals + 1))});
      const Value& value = into.back().value;
      if (value.number.form == text::NumberForm::OutOfRange) return notHeld(value.text);
      if (value.number.form == text::NumberForm::TooLong)
        return fail(
            fmt::format("no integer can hold {0}: it has at most 64 bits; for a real number write {0}.0", value.text));
    }
    return true;
  }

  bool nameAndValue() { return takeWord(s_.name, "a name") && takeValue(s_.value); }
  bool expect() {
    if (!takeWord(s_.name, "a name")) return false;
    if (done() || word() != "~") return takeValue(s_.value);
    ++next_;
    s_.near = true;
    Value tolerance;
    if (!takeValue(s_.value, true) || !takeValue(tolerance, true)) return false;
    s_.tolerance = tolerance.real;
    return true;
  }
  bool expectRange() {
    if (!takeWord(s_.name, "a name") || !takeValue(s_.value, true) || !takeValue(s_.high, true)) return false;
    if (s_.value.real <= s_.high.real) return true;
    return fail(fmt::format("no value is in the range from {0} to {1}: write expect_range {2} {1} {0}", s_.value.text,
                            s_.high.text, s_.name));
  }
  bool expectMessage() {
    const std::optional<uint32_t> number = done() ? std::nullopt : text::wholeIn<uint32_t>(word());
    if (!number) return fail("expected a message number");
    s_.number = *number;
    ++next_;
    if (!done() && (word() == "on" || word() == "off")) s_.on = words_[next_++].text == "on";
    return takeKeys(s_.keys);
  }
  bool code() {
    std::string first;
    if (!takeWord(first, "a diagnostic code")) return false;
    s_.name = first;
    if (done()) return true;
    const auto line = text::wholeIn<uint32_t>(first);
    if (!line || *line == 0) return fail(fmt::format("'{}' is not a line number", first));
    s_.number = *line;
    return takeWord(s_.name, "a diagnostic code");
  }
  bool block() {
    if (!takeWord(s_.name, "start or done")) return false;
    if (s_.name == "start") return takeKeys(s_.keys);
    return s_.name == "done" || fail(fmt::format("expected start or done, found '{}'", s_.name));
  }
  bool plc() {
    if (!takeWord(s_.name, "stop, start or clear")) return false;
    if (s_.name == "stop" || s_.name == "start" || s_.name == "clear") return true;
    return fail(fmt::format("expected stop, start or clear, found '{}'", s_.name));
  }
  bool prepare() {
    if (!takeWord(s_.name, "a service") || !takeKeys(s_.keys)) return false;
    if (done()) return fail("expected -> and the answer");
    ++next_;
    return takeKeys(s_.results);
  }
  bool program() {
    for (; !done(); ++next_) s_.words.push_back(word());
    return !s_.words.empty() || fail("expected a file");
  }
  bool words() {
    for (; !done(); ++next_) s_.words.push_back(word());
    return true;
  }
  bool expectChange();
  bool connect() {
    s_.words.resize(2);
    return takeWord(s_.words[0], "a source") && takeWord(s_.words[1], "a destination");
  }
  bool config() { return takeWord(s_.name, "a key") && text(); }
  bool control() {
    std::string kind;
    return takeWord(kind, "recorded") &&
           (kind == "recorded" || fail(fmt::format("expected recorded, found '{}'", kind)));
  }
  bool within() {
    std::string turn;
    if (!takeWord(turn, "the number of a turn")) return false;
    const auto number = text::wholeIn<uint32_t>(turn);
    if (!number) return fail(fmt::format("'{}' is not the number of a turn", turn));
    s_.number = *number;
    return takeWord(s_.name, "an action") && words();
  }
  bool period() { return duration() && (s_.microseconds > 0 || fail("a period must be longer than 0")); }
  bool call() { return takeWord(s_.name, "a service") && takeKeys(s_.keys); }
  bool event() { return takeWord(s_.name, "an event") && takeKeys(s_.keys); }
  bool noCall() { return done() || takeWord(s_.name, "a service"); }
  bool print();
  bool name() { return takeWord(s_.name, "a name"); }
  bool nothing() { return true; }
  bool include() { return takeWord(s_.name, "a file"); }
  bool dialect() { return takeWord(s_.name, "a dialect"); }
  bool sent() {
    if (!takeWord(s_.name, "a port")) return false;
    if (next_ + 1 != words_.size() || words_[next_].text != "none") return takeKeys(s_.keys);
    s_.keys.push_back({.key = "none", .value = {}});
    ++next_;
    return true;
  }
  bool reply() { return takeKeys(s_.results); }

  std::string unknown();

  Statement s_;
  std::vector<ScenarioWord> words_;
  size_t next_ = 1;
  std::string error_;
  bool mayShapeStart_ = false;
};

bool LineParser::notAValue(const std::string& text) {
  if (text == "=" || text == "==")
    return fail(fmt::format("'{}' is not a value: only a blank comes before the value", text));
  if (startsWithDigit(text) && parseDuration(text).ok())
    return fail(fmt::format("'{}' is a time; a value is a number in the unit that the program counts in", text));
  if (text::writtenNumber(text).form == text::NumberForm::OutOfRange) return notHeld(text);
  return fail(fmt::format("'{}' is not a value: expected a number, on, off, true, false or a text in quotes", text));
}

bool LineParser::count() {
  if (done()) return true;
  const std::string unit = next_ + 1 < words_.size() ? words_[next_ + 1].text : std::string();
  const std::string time = isTimeUnit(unit) ? word() + unit : word();
  if (parseDuration(time).ok())
    return fail(fmt::format("{} takes a number of runs; for a time write: run {}", words_[0].text, time));
  const auto count = text::wholeIn<int64_t>(word());
  if (!count || *count < 0) return fail(fmt::format("'{}' is not a number of runs", word()));
  s_.count = static_cast<uint64_t>(*count);
  ++next_;
  const std::string& own = words_[0].text; // scan 3 scans, scan 3 times
  if (!done() && (word() == "times" || word() == own || word() == own + "s")) ++next_;
  return true;
}

bool LineParser::duration() {
  if (done()) return fail("expected a time such as 250ms or 2s");
  std::string text = word();
  ++next_;
  if (!done() && valueOf({text, false}).kind != ValueKind::Text) { // the unit is the next word
    if (word().starts_with("scan"))
      return fail(fmt::format("{} takes a time; for a number of scans write: scan {}", words_[0].text, text));
    text += " " + words_[next_++].text;
  }
  const Result<int64_t> us = parseDuration(text);
  if (!us.ok()) return fail(us.error());
  s_.microseconds = us.value();
  return true;
}

bool LineParser::print() {
  for (; !done(); ++next_) {
    const ScenarioWord& item = words_[next_];
    s_.keys.push_back(item.quoted ? KeyValue{{}, valueOf(item)} : KeyValue{item.text, {}});
  }
  return !s_.keys.empty() || fail("expected a name or a text in quotes");
}

// A cell may have the name "state", too.
bool LineParser::expectChange() {
  std::string kind;
  if (!takeWord(kind, "new, removed, moved, retyped, released, cut or renamed")) return false;
  const auto known = changeKindFromName(kind);
  if (!known)
    return fail(fmt::format("expected new, removed, moved, retyped, released, cut or renamed, found '{}'", kind));
  s_.change.kind = *known;
  if (*known == runtime::ChangeKind::Renamed)
    return takeWord(s_.change.formerName, "the former name") && takeWord(s_.change.name, "the new name");
  s_.change.slot = next_ + 1 < words_.size() && word() == kStateWord && !words_[next_].quoted;
  if (s_.change.slot) ++next_;
  return takeWord(s_.change.name, "a name");
}

std::string LineParser::unknown() {
  const std::string& word = words_[0].text;
  std::string_view meant;
  for (const Synonym& synonym : kSynonyms)
    if (synonym.word == word) meant = synonym.statement;
  if (meant.empty()) meant = text::mostSimilar(word, StatementInfo::all(), wordOf);
  if (meant.empty() && (word.starts_with(';') || word.starts_with("//")))
    return fmt::format("unknown statement '{}'; a comment begins with '#'", word);
  if (meant.empty() && words_.size() > 1 && words_[1].text == "=") meant = "set";
  if (meant.empty()) return fmt::format("unknown statement '{}'", word);
  const StatementInfo& info = *findStatement(meant);
  mayShapeStart_ = info.shapesStart();
  return fmt::format("unknown statement '{}'; did you mean: {}", word, info.form.form);
}

ParsedLine LineParser::run() {
  const StatementInfo* info = findStatement(words_[0].text);
  if (info == nullptr) {
    std::string problem = unknown();
    return {{}, std::move(problem), mayShapeStart_};
  }
  s_.kind = info->kind;
  if ((this->*info->parse)() && !done()) {
    const bool remark = word().starts_with(';') || word().starts_with("//");
    fail(fmt::format("unexpected '{}' after the statement{}", word(), remark ? "; a comment begins with '#'" : ""));
  }
  if (error_.empty()) return {std::move(s_), {}, info->shapesStart()};
  if (error_.starts_with("expected") || error_.starts_with("unexpected"))
    error_ += fmt::format(" (the statement is: {})", info->form.form);
  if (info->kind == Kind::Expect && isMessageWord(s_.name)) error_ += kMessageNote;
  return {{}, std::move(error_), info->shapesStart()};
}

// ---- the table -----------------------------------------------------------------------------------------------------

constexpr StatementInfo StatementInfo::kRows[] = {
#define RUNG_STATEMENT(itsKind, word, text, meaning, ...)                                                              \
  {.kind = Kind::itsKind, .form = {word, text, meaning}, __VA_ARGS__},
#include "tools/scenario/statements.def"
#undef RUNG_STATEMENT
};

namespace {

constexpr bool isComplete(const StatementInfo& info) {
  const StatementForm& form = info.form;
  const bool acts = info.advances != Advance::Nothing || info.program != OtherProgram::None || info.sets;
  return !form.word.empty() && form.form.starts_with(form.word) && !form.meaning.empty() && info.parse != nullptr &&
         (info.run != nullptr) == (info.stage == Stage::Run) && info.expects == form.word.starts_with("expect") &&
         (info.stage == Stage::Run || !acts);
}

} // namespace

const StatementInfo& StatementInfo::of(Kind kind) {
  static_assert(std::ranges::all_of(kRows, isComplete), "a row of statements.def lacks something");
  const auto counts = [](const StatementInfo& info) {
    return info.advances == Advance::Scans || info.advances == Advance::Parts;
  };
  static_assert(
      std::ranges::all_of(
          kRows, [&](const StatementInfo& info) { return counts(info) == (info.parse == &LineParser::count); }),
      "the prompt records an interrupted statement as its word and the count that was reached");
  return kRows[static_cast<size_t>(kind)];
}

std::span<const StatementInfo> StatementInfo::all() { return kRows; }

const StatementInfo* findStatement(std::string_view word) {
  const auto found = std::ranges::find(StatementInfo::all(), word, wordOf);
  return found == StatementInfo::all().end() ? nullptr : &*found;
}

bool isMessageWord(std::string_view name) {
  return text::equalsIgnoringCase(name, "message") || text::equalsIgnoringCase(name, "msg");
}

namespace {

// Whether a comment has no blank after its `#`: it may be meant as a name.
bool mayEndWithName(std::string_view line) {
  const size_t at = line.find(" #");
  return at != std::string_view::npos && at + 2 < line.size() && line[at + 2] != ' ' && line[at + 2] != '#';
}

} // namespace

ParsedLine parseLine(std::string_view line) {
  std::vector<ScenarioWord> words;
  std::string problem = splitLine(line, words);
  if (!problem.empty()) return {{}, std::move(problem), true};
  if (words.empty()) return {};
  ParsedLine parsed = LineParser(std::move(words)).run();
  if (parsed.problem.starts_with("expected a") && mayEndWithName(line))
    parsed.problem += "; a name that begins with # is written in quotes, other words after # are a comment";
  if (parsed.statement) parsed.statement->text = text::trimmed(line);
  return parsed;
}

Result<Statement> parseStatement(std::string_view line) {
  ParsedLine parsed = parseLine(line);
  if (!parsed.problem.empty()) return failure(std::move(parsed.problem));
  if (!parsed.statement) return failure("expected a statement");
  return std::move(*parsed.statement);
}

} // namespace rung::scenario

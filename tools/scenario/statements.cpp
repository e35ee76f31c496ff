// One statement of a scenario: a table of forms, each with a function that reads its words.
#include "tools/scenario/statements.h"

#include <algorithm>
#include <fmt/format.h>

#include "rtlib/text/blanks.h"
#include "rtlib/text/letters.h"
#include "rtlib/text/number.h"
#include "rtlib/text/similar.h"
#include "tools/scenario/lane.h"
#include "tools/scenario/words.h"

namespace rung::scenario {
namespace {

// What people write who come from elsewhere.
struct Synonym {
  std::string_view word;
  std::string_view statement;
};
constexpr Synonym kSynonyms[] = {{"wait", "run"},     {"sleep", "run"},    {"delay", "run"},     {"assert", "expect"},
                                 {"check", "expect"}, {"test", "expect"},  {"write", "set"},     {"force", "set"},
                                 {"step", "scan"},    {"cycle", "scan"},   {"echo", "print"},    {"show", "print"},
                                 {"log", "print"},    {"load", "program"}, {"import", "include"}};

bool startsWithDigit(std::string_view text) { return !text.empty() && text::isDigit(text[0]); }

// Statements that decide how the program is compiled and started.
bool shapesStart(Kind kind) {
  return kind == Kind::Include || kind == Kind::Program || kind == Kind::Dialect || kind == Kind::ExpectError ||
         kind == Kind::AllowErrors || preparesStart(kind);
}

class LineParser {
public:
  explicit LineParser(std::vector<ScenarioWord> words) : words_(std::move(words)) {}

  ParsedLine run();

private:
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
  bool takeCount();
  bool takeDuration();
  bool takeText() {
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

  bool set() { return takeWord(s_.name, "a name") && takeValue(s_.value); }
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
  bool expectCode() {
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
    std::string what;
    if (!takeWord(what, "start or done")) return false;
    if (what == "done") {
      s_.kind = Kind::BlockDone;
      return true;
    }
    if (what != "start") return fail(fmt::format("expected start or done, found '{}'", what));
    return takeKeys(s_.keys);
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
  bool names() {
    for (; !done(); ++next_) s_.words.push_back(word());
    return true;
  }
  bool expectChange();
  bool connect() {
    s_.words.resize(2);
    return takeWord(s_.words[0], "a source") && takeWord(s_.words[1], "a destination");
  }
  bool config() { return takeWord(s_.name, "a key") && takeText(); }
  bool period() { return takeDuration() && (s_.microseconds > 0 || fail("a period must be longer than 0")); }
  bool call() { return takeWord(s_.name, "a service") && takeKeys(s_.keys); }
  bool event() { return takeWord(s_.name, "an event") && takeKeys(s_.keys); }
  bool noCall() { return done() || takeWord(s_.name, "a service"); }
  bool print();
  bool difference() { return takeWord(s_.name, "a name"); }
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

  struct Row {
    StatementForm form;
    Kind kind = Kind::Program;
    bool (LineParser::*read)() = nullptr;
  };
  static const Row* find(std::string_view word);
  static const Row kRows[];
  friend std::vector<StatementForm> formsOfRows();
};

using P = LineParser;
const P::Row P::kRows[] = {
    {{"program", "program FILE…", "the source files under test"}, Kind::Program, &P::program},
    {{"include", "include FILE", "the statements of another file"}, Kind::Include, &P::include},
    {{"dialect", "dialect nct|technol|gsk", "needed where the files do not say"}, Kind::Dialect, &P::dialect},
    {{"config", "config KEY VALUE", "a configuration value, before the first scan"}, Kind::Config, &P::config},
    {{"connect", "connect SRC DST", "TECHNOL: binds a symbol to a terminal"}, Kind::Connect, &P::connect},
    {{"period", "period 10ms", "the main task's period"}, Kind::Period, &P::period},
    {{"set", "set NAME VALUE", "writes a variable, an input or a signal of the NC"}, Kind::Set, &P::set},
    {{"scan", "scan [N]", "runs N scans"}, Kind::Scan, &P::takeCount},
    {{"fast", "fast [N]", "runs only the fast task, N times"}, Kind::Fast, &P::takeCount},
    {{"slot", "slot [N]", "GSK: runs N slots of 8 ms"}, Kind::Slot, &P::takeCount},
    {{"run", "run 250ms", "runs scans until this much time has passed"}, Kind::Run, &P::takeDuration},
    {{"expect", "expect NAME VALUE | expect NAME ~ VALUE TOLERANCE", "NAME has this value"}, Kind::Expect, &P::expect},
    {{"expect_range", "expect_range NAME LOW HIGH", "NAME lies between them"}, Kind::ExpectRange, &P::expectRange},
    {{"expect_message", "expect_message NUMBER [on|off] [KEY=VALUE …]", "the message is, or is not, displayed"},
     Kind::ExpectMessage,
     &P::expectMessage},
    {{"expect_log", "expect_log TEXT", "a new log entry contains TEXT"}, Kind::ExpectLog, &P::takeText},
    {{"expect_call", "expect_call SERVICE [KEY=VALUE …]", "the next request is this one; removes it from the queue"},
     Kind::ExpectCall,
     &P::call},
    {{"expect_no_call", "expect_no_call [SERVICE]", "no such request is pending"}, Kind::ExpectNoCall, &P::noCall},
    {{"expect_sent", "expect_sent PORT KEY=VALUE… | expect_sent PORT none",
      "TECHNOL: the next data sent by a serial port or a CAN channel"},
     Kind::ExpectSent,
     &P::sent},
    {{"reply", "reply [KEY=VALUE …]", "answers the oldest pending request"}, Kind::Reply, &P::reply},
    {{"prepare", "prepare SERVICE [KEY=VALUE …] -> [KEY=VALUE …]", "prepares the answer to the next such request"},
     Kind::Prepare,
     &P::prepare},
    {{"block", "block start [KEY=VALUE …] | block done", "the NC starts a block, or has finished its motion"},
     Kind::BlockStart,
     &P::block},
    {{"event", "event NAME [KEY=VALUE …]", "an event of the NC or a command of the operator"}, Kind::Event, &P::event},
    {{"plc", "plc stop|start|clear", "a command of the operator to the PLC"}, Kind::Plc, &P::plc},
    {{"cold_start", "cold_start", "off and on; nothing is retained"}, Kind::ColdStart, &P::nothing},
    {{"warm_start", "warm_start", "off and on; retained memory is kept"}, Kind::WarmStart, &P::nothing},
    {{"expect_error", "expect_error [LINE] CODE", "compiling fails with this error"},
     Kind::ExpectError,
     &P::expectCode},
    {{"allow_errors", "allow_errors", "compiling may report errors that are not expected, too"},
     Kind::AllowErrors,
     &P::nothing},
    {{"expect_warning", "expect_warning [LINE] CODE", "compiling reports this warning"},
     Kind::ExpectWarning,
     &P::expectCode},
    {{"expect_fault", "expect_fault TEXT", "the program has stopped with a fault that contains TEXT"},
     Kind::ExpectFault,
     &P::takeText},
    {{"print", "print NAME…|\"TEXT\"…", "writes values and texts to the result"}, Kind::Print, &P::print},
    {{"replace", "replace FILE…", "another program takes over, with the state of this one"},
     Kind::Replace,
     &P::program},
    {{"expect_change",
      "expect_change new|removed|moved|retyped|released|cut [state] NAME | expect_change renamed FORMER NAME",
      "the replacement has made this change to a variable, or to internal state"},
     Kind::ExpectChange,
     &P::expectChange},
    {{"expect_no_change", "expect_no_change", "the replacement has made no other change"},
     Kind::ExpectNoChange,
     &P::nothing},
    {{"shadow", "shadow [FILE…]", "runs a program beside this one to compare them; without files: ends it"},
     Kind::Shadow,
     &P::names},
    {{"expect_difference", "expect_difference NAME",
      "the shadow had another value there, or was alone in requesting it"},
     Kind::ExpectDifference,
     &P::difference},
    {{"expect_no_difference", "expect_no_difference", "the shadow has no other difference"},
     Kind::ExpectNoDifference,
     &P::nothing},
    {{"force", "force NAME VALUE", "forces a variable to a value for every reader"}, Kind::Force, &P::set},
    {{"unforce", "unforce [NAME…]", "releases them; without names: all"}, Kind::Unforce, &P::names},
};

const LineParser::Row* LineParser::find(std::string_view word) {
  const auto* row = std::ranges::find(kRows, word, [](const Row& r) { return r.form.word; });
  return row == std::end(kRows) ? nullptr : row;
}

bool LineParser::notAValue(const std::string& text) {
  if (text == "=" || text == "==")
    return fail(fmt::format("'{}' is not a value: only a blank comes before the value", text));
  if (startsWithDigit(text) && parseDuration(text).ok())
    return fail(fmt::format("'{}' is a time; a value is a number in the unit that the program counts in", text));
  if (text::writtenNumber(text).form == text::NumberForm::OutOfRange) return notHeld(text);
  return fail(fmt::format("'{}' is not a value: expected a number, on, off, true, false or a text in quotes", text));
}

bool LineParser::takeCount() {
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

bool LineParser::takeDuration() {
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

// A cell may be called "state", too.
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
  if (meant.empty()) meant = text::mostSimilar(word, kRows, [](const Row& row) { return row.form.word; });
  if (meant.empty() && (word.starts_with(';') || word.starts_with("//")))
    return fmt::format("unknown statement '{}'; a comment begins with '#'", word);
  if (meant.empty() && words_.size() > 1 && words_[1].text == "=") meant = "set";
  if (meant.empty()) return fmt::format("unknown statement '{}'", word);
  const Row& row = *find(meant);
  mayShapeStart_ = shapesStart(row.kind);
  return fmt::format("unknown statement '{}'; did you mean: {}", word, row.form.form);
}

ParsedLine LineParser::run() {
  const Row* row = find(words_[0].text);
  if (row == nullptr) {
    std::string problem = unknown();
    return {{}, std::move(problem), mayShapeStart_};
  }
  s_.kind = row->kind;
  if ((this->*row->read)() && !done()) {
    const bool remark = word().starts_with(';') || word().starts_with("//");
    fail(fmt::format("unexpected '{}' after the statement{}", word(), remark ? "; a comment begins with '#'" : ""));
  }
  if (error_.empty()) return {std::move(s_), {}, shapesStart(row->kind)};
  if (error_.starts_with("expected") || error_.starts_with("unexpected"))
    error_ += fmt::format(" (the statement is: {})", row->form.form);
  if (row->kind == Kind::Expect && isMessageWord(s_.name)) error_ += kMessageNote;
  return {{}, std::move(error_), shapesStart(row->kind)};
}

std::vector<StatementForm> formsOfRows() {
  std::vector<StatementForm> forms;
  for (const LineParser::Row& row : LineParser::kRows) forms.push_back(row.form);
  return forms;
}

} // namespace

bool isMessageWord(std::string_view name) {
  return text::equalsIgnoringCase(name, "message") || text::equalsIgnoringCase(name, "msg");
}

bool preparesStart(Kind kind) { return kind == Kind::Config || kind == Kind::Connect || kind == Kind::Period; }

ParsedLine parseLine(std::string_view line) {
  std::vector<ScenarioWord> words;
  std::string problem = splitLine(line, words);
  if (!problem.empty()) return {{}, std::move(problem), true};
  if (words.empty()) return {};
  ParsedLine parsed = LineParser(std::move(words)).run();
  if (parsed.statement) parsed.statement->text = text::trimmed(line);
  return parsed;
}

Result<Statement> parseStatement(std::string_view line) {
  ParsedLine parsed = parseLine(line);
  if (!parsed.problem.empty()) return failure(std::move(parsed.problem));
  if (!parsed.statement) return failure("expected a statement");
  return std::move(*parsed.statement);
}

std::span<const StatementForm> statementForms() {
  static const std::vector<StatementForm> kForms = formsOfRows();
  return kForms;
}

} // namespace rung::scenario

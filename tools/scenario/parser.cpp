// The scenario parser (see scenario.h): a table of statements, each with a function that reads its words.
#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdlib>
#include <fmt/format.h>
#include <optional>

#include "tools/scenario/scenario.h"

namespace rung::scenario {
namespace {

struct ScenarioWord {
  std::string text; // a quoted text without its quotes; KEY="a b" keeps them, see splitKey
  bool quoted = false;
};

std::optional<int64_t> parseInt(std::string_view text) {
  const bool negative = !text.empty() && text[0] == '-';
  if (negative || (!text.empty() && text[0] == '+')) text.remove_prefix(1);
  int base = 10;
  if (text.size() > 2 && text[0] == '0' && (text[1] == 'x' || text[1] == 'X')) {
    base = 16;
    text.remove_prefix(2);
  }
  uint64_t magnitude = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), magnitude, base);
  if (error != std::errc() || end != text.data() + text.size() || text.empty()) return std::nullopt;
  return static_cast<int64_t>(negative ? 0 - magnitude : magnitude);
}

std::optional<double> parseReal(std::string_view text) {
  const std::string copy(text);
  if (copy.empty() || copy.find_first_of("xX") != std::string::npos) return std::nullopt;
  char* end = nullptr;
  const double value = std::strtod(copy.c_str(), &end);
  if (end != copy.c_str() + copy.size()) return std::nullopt;
  return value;
}

Value valueOf(const ScenarioWord& word) {
  Value value;
  value.text = word.text;
  value.kind = ValueKind::Text;
  if (word.quoted) return value;
  if (const auto integer = parseInt(word.text)) {
    value.kind = ValueKind::Int;
    value.integer = *integer;
    value.real = static_cast<double>(*integer);
  } else if (const auto real = parseReal(word.text)) {
    value.kind = ValueKind::Real;
    value.real = *real;
  }
  return value;
}

class LineParser {
public:
  LineParser(Statement& statement, std::vector<ScenarioWord> words) : s_(statement), words_(std::move(words)) {}

  // Empty when the line is right.
  std::string run();

private:
  bool done() const { return next_ >= words_.size(); }
  bool fail(std::string message) {
    if (error_.empty()) error_ = std::move(message);
    return false;
  }
  bool takeWord(std::string& into, std::string_view what) {
    if (done()) return fail(fmt::format("expected {}", what));
    into = words_[next_++].text;
    return true;
  }
  bool takeValue(Value& into, bool numeric = false) {
    if (done()) return fail("expected a value");
    const ScenarioWord& word = words_[next_++];
    into = valueOf(word);
    if (into.kind == ValueKind::Text && !word.quoted)
      return fail(fmt::format("'{}' is no value: expected a number or a text in quotes", word.text));
    if (numeric && into.kind == ValueKind::Text) return fail("expected a number");
    return true;
  }
  bool takeCount() {
    if (done()) return true;
    const auto count = parseInt(words_[next_].text);
    if (!count || *count < 0) return fail(fmt::format("'{}' is no number of runs", words_[next_].text));
    s_.count = static_cast<uint64_t>(*count);
    ++next_;
    return true;
  }
  bool takeDuration() {
    if (done()) return fail("expected a duration such as 250ms");
    const auto us = parseDuration(words_[next_].text);
    if (!us) return fail(fmt::format("'{}' is no duration: expected a number with us, ms or s", words_[next_].text));
    s_.microseconds = *us;
    ++next_;
    return true;
  }
  bool takeText() {
    if (done()) return fail("expected a text");
    s_.value.kind = ValueKind::Text;
    for (; !done(); ++next_) s_.value.text += (s_.value.text.empty() ? "" : " ") + words_[next_].text;
    return true;
  }
  bool takeKeys(std::vector<KeyValue>& into) {
    for (; !done() && words_[next_].text != "->"; ++next_) {
      const std::string& text = words_[next_].text;
      const size_t equals = text.find('=');
      if (equals == std::string::npos || equals == 0) return fail(fmt::format("expected KEY=VALUE, found '{}'", text));
      ScenarioWord value{text.substr(equals + 1), false};
      if (value.text.size() >= 2 && value.text.front() == '"' && value.text.back() == '"')
        value = {value.text.substr(1, value.text.size() - 2), true};
      into.push_back({text.substr(0, equals), valueOf(value)});
    }
    return true;
  }

  bool set() { return takeWord(s_.name, "a name") && takeValue(s_.value); }
  bool expect() {
    if (!takeWord(s_.name, "a name")) return false;
    if (done() || words_[next_].text != "~") return takeValue(s_.value);
    ++next_;
    s_.near = true;
    Value tolerance;
    if (!takeValue(s_.value, true) || !takeValue(tolerance, true)) return false;
    s_.tolerance = tolerance.real;
    return true;
  }
  bool expectMessage() {
    Value number;
    if (!takeValue(number, true)) return false;
    s_.number = static_cast<uint32_t>(number.integer);
    if (!done() && (words_[next_].text == "on" || words_[next_].text == "off")) s_.on = words_[next_++].text == "on";
    return takeKeys(s_.keys);
  }
  bool expectCode() {
    std::string first;
    if (!takeWord(first, "a diagnostic code")) return false;
    s_.name = first;
    if (done()) return true;
    const auto line = parseInt(first);
    if (!line || *line <= 0) return fail(fmt::format("'{}' is no line number", first));
    s_.number = static_cast<uint32_t>(*line);
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
    s_.kind = Kind::BlockStart;
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
    for (; !done(); ++next_) s_.words.push_back(words_[next_].text);
    return !s_.words.empty() || fail("expected a file");
  }
  bool connect() {
    s_.words.resize(2);
    return takeWord(s_.words[0], "a source") && takeWord(s_.words[1], "a destination");
  }

  Statement& s_;
  std::vector<ScenarioWord> words_;
  size_t next_ = 1;
  std::string error_;

  struct Form {
    std::string_view word;
    Kind kind;
    bool (*read)(LineParser&);
  };
  static const Form kForms[];
};

const LineParser::Form LineParser::kForms[] = {
    {"program", Kind::Program, [](LineParser& p) { return p.program(); }},
    {"dialect", Kind::Dialect, [](LineParser& p) { return p.takeWord(p.s_.name, "a dialect"); }},
    {"config", Kind::Config,
     [](LineParser& p) { return p.takeWord(p.s_.name, "a key") && (p.takeText(), p.error_.empty()); }},
    {"connect", Kind::Connect, [](LineParser& p) { return p.connect(); }},
    {"period", Kind::Period,
     [](LineParser& p) {
       return p.takeDuration() && (p.s_.microseconds > 0 || p.fail("a period is longer than nothing"));
     }},
    {"set", Kind::Set, [](LineParser& p) { return p.set(); }},
    {"scan", Kind::Scan, [](LineParser& p) { return p.takeCount(); }},
    {"fast", Kind::Fast, [](LineParser& p) { return p.takeCount(); }},
    {"slot", Kind::Slot, [](LineParser& p) { return p.takeCount(); }},
    {"run", Kind::Run, [](LineParser& p) { return p.takeDuration(); }},
    {"expect", Kind::Expect, [](LineParser& p) { return p.expect(); }},
    {"expect_range", Kind::ExpectRange,
     [](LineParser& p) {
       return p.takeWord(p.s_.name, "a name") && p.takeValue(p.s_.value, true) && p.takeValue(p.s_.high, true);
     }},
    {"expect_message", Kind::ExpectMessage, [](LineParser& p) { return p.expectMessage(); }},
    {"expect_log", Kind::ExpectLog, [](LineParser& p) { return p.takeText(); }},
    {"expect_call", Kind::ExpectCall,
     [](LineParser& p) { return p.takeWord(p.s_.name, "a service") && p.takeKeys(p.s_.keys); }},
    {"expect_no_call", Kind::ExpectNoCall,
     [](LineParser& p) { return p.done() || p.takeWord(p.s_.name, "a service"); }},
    {"reply", Kind::Reply, [](LineParser& p) { return p.takeKeys(p.s_.results); }},
    {"prepare", Kind::Prepare, [](LineParser& p) { return p.prepare(); }},
    {"block", Kind::BlockStart, [](LineParser& p) { return p.block(); }},
    {"event", Kind::Event, [](LineParser& p) { return p.takeWord(p.s_.name, "an event") && p.takeKeys(p.s_.keys); }},
    {"plc", Kind::Plc, [](LineParser& p) { return p.plc(); }},
    {"cold_start", Kind::ColdStart, [](LineParser&) { return true; }},
    {"warm_start", Kind::WarmStart, [](LineParser&) { return true; }},
    {"expect_error", Kind::ExpectError, [](LineParser& p) { return p.expectCode(); }},
    {"expect_warning", Kind::ExpectWarning, [](LineParser& p) { return p.expectCode(); }},
    {"expect_fault", Kind::ExpectFault, [](LineParser& p) { return p.takeText(); }},
};

std::string LineParser::run() {
  for (const Form& form : kForms) {
    if (form.word != words_[0].text) continue;
    s_.kind = form.kind;
    if (form.read(*this) && !done()) fail(fmt::format("unexpected '{}' behind the statement", words_[next_].text));
    return error_;
  }
  return fmt::format("unknown statement '{}'", words_[0].text);
}

// Words of a line up to a comment. A quote inside a word (KEY="a b") keeps its blanks and its quotes.
std::string split(std::string_view line, std::vector<ScenarioWord>& words) {
  size_t i = 0;
  const auto blank = [&] { return i < line.size() && (line[i] == ' ' || line[i] == '\t' || line[i] == '\r'); };
  while (true) {
    while (blank()) ++i;
    if (i >= line.size() || line[i] == '#') return {};
    ScenarioWord word;
    word.quoted = line[i] == '"';
    while (i < line.size() && !blank()) {
      if (line[i] != '"') {
        word.text += line[i++];
        continue;
      }
      const size_t close = line.find('"', i + 1);
      if (close == std::string_view::npos) return "a text is not closed: expected \"";
      const size_t skip = word.quoted ? 1 : 0;
      word.text += line.substr(i + skip, close + 1 - i - 2 * skip);
      i = close + 1;
    }
    words.push_back(std::move(word));
  }
}

} // namespace

std::optional<int64_t> parseDuration(std::string_view text) {
  struct Unit {
    std::string_view name;
    double us;
  };
  for (const Unit unit : {Unit{"ms", 1e3}, Unit{"us", 1.0}, Unit{"s", 1e6}}) {
    if (!text.ends_with(unit.name)) continue;
    const auto number = parseReal(text.substr(0, text.size() - unit.name.size()));
    if (!number || !(*number >= 0) || *number * unit.us > 9e15) return std::nullopt;
    return static_cast<int64_t>(*number * unit.us + 0.5);
  }
  return std::nullopt;
}

namespace {

bool advances(Kind kind) { return kind == Kind::Scan || kind == Kind::Fast || kind == Kind::Slot || kind == Kind::Run; }

bool preparesStart(Kind kind) { return kind == Kind::Config || kind == Kind::Connect || kind == Kind::Period; }

} // namespace

Scenario parse(std::string path, std::string_view text) {
  Scenario scenario;
  scenario.path = std::move(path);
  uint32_t number = 0;
  bool advanced = false;
  while (!text.empty()) {
    const size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    ++number;
    std::vector<ScenarioWord> words;
    std::string problem = split(line, words);
    if (problem.empty() && words.empty()) continue;
    Statement statement;
    statement.line = number;
    if (problem.empty()) problem = LineParser(statement, std::move(words)).run();
    advanced = advanced || (problem.empty() && advances(statement.kind));
    if (problem.empty() && advanced && preparesStart(statement.kind))
      problem = "config, connect and period stand in front of the first scan";
    if (!problem.empty())
      scenario.problems.push_back({number, std::move(problem)});
    else
      scenario.statements.push_back(std::move(statement));
  }
  if (scenario.problems.empty() && (scenario.statements.empty() || scenario.statements[0].kind != Kind::Program))
    scenario.problems.push_back({1, "a scenario begins with: program FILE"});
  return scenario;
}

} // namespace rung::scenario

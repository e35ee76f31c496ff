// PMC parameters, as the control writes them: `%`, a title in brackets, and a line `N600000 P48` for each. What each
// range of numbers means, and how certain that is: docs/importing.md.
#include <algorithm>
#include <map>
#include <optional>
#include <span>

#include <fmt/format.h>

#include "rtlib/text/blanks.h"
#include "rtlib/text/number.h"
#include "tools/imported/imported.h"
#include "tools/imported/lines.h"

namespace rung::imported {
namespace {

// ---- what the numbers mean

enum class Form : uint8_t {
  Word,   // two bytes at an even address
  Bits,   // a byte as eight binary digits, bit 7 first
  Data,   // one, two or four bytes, by the step to the next number
  NoValue // not a value of the memory
};

struct Range {
  uint32_t first, last; // numbers N
  std::string_view area;
  uint32_t place; // the address of `first`
  Form form;
  uint32_t most; // the greatest value of a Word
  std::string_view what;
  bool isCertain;
};

constexpr Range kRanges[] = {
    {600000, 608999, "T", 0, Form::Word, 32767, "set values of timers, in units of their accuracy", true},
    {609000, 609999, "T", 9000, Form::Word, 5, "accuracies of timers", true},
    {610000, 614999, "C", 0, Form::Word, 32767, "counters: preset and value", false},
    {615000, 619999, "C", 5000, Form::Word, 32767, "fixed counters: value", false},
    {620000, 629999, "K", 0, Form::Bits, 0, "keep relays", false},
    {630000, 639999, "", 0, Form::NoValue, 0, "how the control divides and shows the data table", true},
    {640000, 649999, "D", 0, Form::Data, 0, "data table", false},
};

const Range* rangeOf(uint32_t number) {
  const auto found =
      std::ranges::find_if(kRanges, [&](const Range& range) { return range.first <= number && number <= range.last; });
  return found == std::end(kRanges) ? nullptr : found;
}

// ---- reading

struct Parameter {
  uint32_t number = 0;
  std::string value; // as written
  text::Position at; // of the N
  text::Position valueAt;
};

struct ParameterFile {
  std::string title; // "(PMC=0I-F,MSID=1)"
  std::vector<Parameter> parameters;
};

class Reader {
public:
  explicit Reader(std::vector<Remark>& remarks) : remarks_(remarks) {}

  ParameterFile read(std::string_view text) {
    for (const Line& line : linesOf(text)) {
      if (isBlank(line)) continue;
      const std::string_view words = text::trimmed(line.text);
      if (hasEnded_) return leaveOut(line);
      hasEnded_ = words == "%" && !file_.parameters.empty();
      if (words == "%") continue;
      if (words.starts_with('(') && file_.parameters.empty())
        file_.title = asShown(words);
      else
        readParameter(line);
    }
    return std::move(file_);
  }

private:
  void wrong(text::Position at, std::string text) { remarks_.push_back({at, std::move(text), true}); }

  // A file has one list of parameters.
  ParameterFile leaveOut(const Line& line) {
    remarks_.push_back({positionOf(line, 0), "the list of parameters has ended at the % before; the rest is left out"});
    return std::move(file_);
  }

  void readParameter(const Line& line) {
    const size_t begin = line.text.find_first_not_of(" \t");
    const size_t end = std::min(line.text.find(';'), line.text.size()); // the end of a block in ISO code
    std::string_view rest = line.text.substr(begin, end - begin);
    const auto offset = [&] { return end - rest.size(); };
    const auto found = takeNumber(rest);
    if (!found)
      return wrong(positionOf(line, begin),
                   fmt::format("found '{}', expected a parameter such as N600000 P48", inBrief(line.text)));
    Parameter parameter{
        .number = *found, .value = {}, .at = positionOf(line, begin), .valueAt = positionOf(line, offset())};
    parameter.value = std::string(text::trimmed(rest));
    if (const auto [before, isNew] = lines_.try_emplace(parameter.number, line.number); !isNew)
      return wrong(parameter.at,
                   fmt::format("N{} is there again; the first one is in line {}", parameter.number, before->second));
    file_.parameters.push_back(std::move(parameter));
  }

  // Takes "N600000 P" off the text.
  static std::optional<uint32_t> takeNumber(std::string_view& rest) {
    if (!text::takePrefixIgnoringCase(rest, "N")) return std::nullopt;
    const size_t digits = std::min(rest.find_first_not_of("0123456789"), rest.size());
    const auto number = text::wholeIn<uint32_t>(rest.substr(0, digits));
    if (!number || digits != 6) return std::nullopt;
    rest.remove_prefix(std::min(rest.find_first_not_of(" \t", digits), rest.size()));
    return text::takePrefixIgnoringCase(rest, "P") ? number : std::nullopt;
  }

  std::vector<Remark>& remarks_;
  ParameterFile file_;
  bool hasEnded_ = false;
  std::map<uint32_t, uint32_t> lines_; // of a number
};

// ---- values

// Numbers without a gap in the file, all of one range or of none.
struct Run {
  const Range* range = nullptr;
  std::span<const Parameter> parameters;
};

std::vector<Run> runsOf(std::span<const Parameter> parameters) {
  std::vector<Run> runs;
  for (size_t i = 0; i < parameters.size(); ++i) {
    const Range* range = rangeOf(parameters[i].number);
    if (runs.empty() || runs.back().range != range) runs.push_back({range, parameters.subspan(i, 0)});
    runs.back().parameters = {runs.back().parameters.data(), runs.back().parameters.size() + 1};
  }
  return runs;
}

std::string numbersOf(const Run& run) {
  const uint32_t first = run.parameters.front().number, last = run.parameters.back().number;
  return first == last ? fmt::format("N{}", first) : fmt::format("N{} to N{}", first, last);
}

// The bytes that a number of the data table has: the step to the next number, or else from the one before.
uint32_t widthOf(std::span<const Parameter> data, size_t i) {
  const auto step = [&](size_t from) {
    const int64_t between = int64_t{data[from + 1].number} - data[from].number;
    return between == 1 || between == 2 || between == 4 ? static_cast<uint32_t>(between) : 0;
  };
  const uint32_t after = i + 1 < data.size() ? step(i) : 0;
  const uint32_t before = i > 0 ? step(i - 1) : 0;
  return after != 0 ? after : before != 0 ? before : 1;
}

class Writer {
public:
  Writer(std::vector<Remark>& remarks, const Source& source) : remarks_(remarks), source_(source) {}

  std::string write(const ParameterFile& file) {
    for (const Run& run : runsOf(file.parameters)) writeRun(run);
    return fmt::format(
        "# Made by rungc import from {}{}{}: what the control keeps while it is off.\n"
        "# A scenario takes it by `include FILE`, retained memory by `rungc run -i PROGRAM --retain NAME < FILE`.\n"
        "# Only values other than 0: {} of {}.\n{}",
        inBrief(source_.name), file.title.empty() ? "" : " ", file.title, written_, values_, text_);
  }

private:
  void remark(text::Position at, std::string text, bool wrong = false) {
    remarks_.push_back({at, std::move(text), wrong});
  }

  void writeRun(const Run& run) {
    const text::Position at = run.parameters.front().at;
    if (run.range == nullptr || run.range->form == Form::NoValue)
      return remark(at, fmt::format("{} (up to line {}): {}; left out", numbersOf(run), run.parameters.back().at.line,
                                    run.range == nullptr ? "not known" : run.range->what));
    values_ += run.parameters.size();
    if (!run.range->isCertain)
      remark(at, fmt::format("{}: {}; that is likely, not certain: compare with the control's screen", numbersOf(run),
                             run.range->what));
    text_ += fmt::format("\n# {}: {}{}\n", numbersOf(run), run.range->what, run.range->isCertain ? "" : " (likely)");
    for (size_t i = 0; i < run.parameters.size(); ++i)
      writeValue(*run.range, run.parameters[i], run.range->form == Form::Data ? widthOf(run.parameters, i) : 0);
  }

  void writeValue(const Range& range, const Parameter& parameter, uint32_t width) {
    switch (range.form) {
    case Form::Word: return writeWord(range, parameter);
    case Form::Bits: return writeBits(range, parameter);
    case Form::Data: return writeData(range, parameter, width);
    case Form::NoValue: return;
    }
  }

  // The control writes decimal numbers only.
  static text::WrittenNumber numberIn(std::string_view value) {
    const bool isDecimal = value.find_first_not_of("-0123456789.") == std::string_view::npos;
    return isDecimal ? text::writtenNumber(value) : text::WrittenNumber{};
  }

  static uint32_t addressOf(const Range& range, const Parameter& parameter) {
    return parameter.number - range.first + range.place;
  }

  void set(const Range& range, const Parameter& parameter, std::string_view width, std::string_view value) {
    text_ += fmt::format("set {}{}{} {}\n", range.area, addressOf(range, parameter), width, value);
    ++written_;
  }

  void writeWord(const Range& range, const Parameter& parameter) {
    const text::WrittenNumber value = numberIn(parameter.value);
    if (parameter.number % 2 != 0)
      return remark(parameter.at,
                    fmt::format("N{} is odd; {} are words at even addresses", parameter.number,
                                range.area == "T" ? "timers" : "counters"),
                    true);
    if (value.form != text::NumberForm::Whole || value.negative || value.magnitude > range.most)
      return remark(parameter.valueAt,
                    fmt::format("the value is '{}', expected 0 to {}", inBrief(parameter.value), range.most), true);
    if (value.magnitude != 0) set(range, parameter, ":2", std::to_string(value.magnitude));
  }

  void writeBits(const Range& range, const Parameter& parameter) {
    const bool isBinary = parameter.value.find_first_not_of("01") == std::string::npos;
    if (parameter.value.size() != 8 || !isBinary)
      return remark(parameter.valueAt,
                    fmt::format("the value is '{}', expected eight binary digits", inBrief(parameter.value)), true);
    if (parameter.value.find('1') != std::string::npos) set(range, parameter, "", "0b" + parameter.value);
  }

  void writeData(const Range& range, const Parameter& parameter, uint32_t width) {
    const text::WrittenNumber value = numberIn(parameter.value);
    if (value.form == text::NumberForm::Real && value.real == 0) return;
    if (value.form == text::NumberForm::Real)
      return remark(parameter.valueAt,
                    fmt::format("{} has a decimal point; how the control stores such a number is not known; left out",
                                inBrief(parameter.value)));
    if (value.form != text::NumberForm::Whole)
      return remark(parameter.valueAt,
                    fmt::format("the value is '{}', expected a whole number", inBrief(parameter.value)), true);
    if (!text::fitsBits(value, width * 8))
      return remark(parameter.valueAt,
                    fmt::format("{} does not fit in {}, the step of the numbers here; left out",
                                inBrief(parameter.value), width == 1 ? "one byte" : fmt::format("{} bytes", width)));
    if (value.magnitude != 0) set(range, parameter, width == 1 ? "" : fmt::format(":{}", width), parameter.value);
  }

  std::vector<Remark>& remarks_;
  Source source_;
  std::string text_;
  size_t values_ = 0; // of ranges that are taken
  size_t written_ = 0;
};

} // namespace

Imported initialValues(const Source& source) {
  Imported made;
  const ParameterFile file = Reader(made.remarks).read(source.text);
  if (file.parameters.empty() && made.remarks.empty())
    made.remarks.push_back({{}, "found no parameter, expected lines such as N600000 P48", true});
  made.text = Writer(made.remarks, source).write(file);
  return made;
}

} // namespace rung::imported

// A signal operation file of the PMC simulator: `PMC SIGNAL DATA`, `REMARK,text`, and lines
// `SET,wait,(address,value,type),(address,value,type)…`. The wait, in ms, is from the SET line before.
#include <algorithm>
#include <array>
#include <optional>
#include <span>

#include <fmt/format.h>

#include "rtlib/text/blanks.h"
#include "rtlib/text/letters.h"
#include "rtlib/text/number.h"
#include "tools/imported/imported.h"
#include "tools/imported/lines.h"
#include "tools/imported/slots.h"

namespace rung::imported {
namespace {

constexpr int64_t kMostWaitMs = 86'400'000; // a day

struct Type {
  std::string_view word;
  uint32_t bits;
};

constexpr Type kTypes[] = {{"BIT", 1}, {"BYTE", 8}, {"WORD", 16}, {"DWORD", 32}, {"LONG", 32}};

const Type* typeOf(std::string_view word) {
  const auto found =
      std::ranges::find_if(kTypes, [&](const Type& type) { return text::equalsIgnoringCase(type.word, word); });
  return found == std::end(kTypes) ? nullptr : found;
}

// A name of a scenario: no blank, and nothing that would end the word.
bool isName(std::string_view text) {
  return !text.empty() && text.find_first_of(" \t\"") == std::string_view::npos && asShown(text) == text;
}

// In quotes if it has a #, which begins a comment where a word begins with it.
std::string written(const std::string& name) {
  return name.find('#') == std::string::npos ? name : fmt::format("\"{}\"", name);
}

class Reader {
public:
  explicit Reader(std::vector<Remark>& remarks) : remarks_(remarks) {}

  std::string read(std::string_view text) {
    for (const Line& line : linesOf(text)) {
      if (isBlank(line)) continue;
      const std::vector<Field> fields = withoutBrackets(fieldsOf(line));
      if (hasBegun_)
        readCommand(line, fields);
      else if (!readFirst(fields))
        return {};
    }
    if (text_.empty() && remarks_.empty()) wrong({}, "found no signals, expected PMC SIGNAL DATA and SET lines");
    return remark_ + text_ + "scan\n"; // the program sees what the last line sets
  }

private:
  void wrong(text::Position at, std::string text) { remarks_.push_back({at, std::move(text), true}); }

  // Brackets only show what belongs together. Empty fields at the end are those of a spreadsheet.
  static std::vector<Field> withoutBrackets(std::vector<Field> fields) {
    for (size_t i = 2; i < fields.size(); ++i) {
      std::string& text = fields[i].text;
      if (text.starts_with('(')) text.erase(0, 1);
      if (text.ends_with(')')) text.pop_back();
      text = std::string(text::trimmed(text));
    }
    while (fields.size() > 1 && fields.back().text.empty()) fields.pop_back();
    return fields;
  }

  bool readFirst(const std::vector<Field>& fields) {
    hasBegun_ = text::equalsIgnoringCase(fields[0].text, "PMC SIGNAL DATA");
    if (!hasBegun_) wrong(fields[0].at, fmt::format("found '{}', expected PMC SIGNAL DATA", inBrief(fields[0].text)));
    return hasBegun_;
  }

  void readCommand(const Line& line, const std::vector<Field>& fields) {
    const std::string command = text::upper(fields[0].text);
    if (command == "REMARK" || command == "R") return readRemark(line, fields);
    if (command == "SET" || command == "S") return readSet(fields);
    wrong(fields[0].at, fmt::format("found '{}', expected REMARK or SET", inBrief(fields[0].text)));
  }

  void readRemark(const Line& line, const std::vector<Field>& fields) {
    if (hasRemark_) return remarks_.push_back({fields[0].at, "only the first REMARK of a file counts; left out"});
    hasRemark_ = true;
    const size_t comma = line.text.find(',');
    if (comma != std::string_view::npos) remark_ = "# " + asShown(line.text.substr(comma + 1)) + '\n';
  }

  void readSet(const std::vector<Field>& fields) {
    const auto wait = fields.size() < 2 ? std::nullopt : text::wholeIn<int64_t>(fields[1].text);
    if (!wait || *wait < 0 || *wait > kMostWaitMs)
      return wrong(fields.size() < 2 ? fields[0].at : fields[1].at,
                   fmt::format("found '{}', expected the time to wait in ms, 0 to {}",
                               fields.size() < 2 ? "nothing" : inBrief(fields[1].text), kMostWaitMs));
    if (fields.size() % 3 != 2) return wrong(fields.back().at, "expected groups of address, value and type");
    text_ += "\n" + slotsText(slotsOf(*wait * 1000));
    for (size_t i = 2; i < fields.size(); i += 3) readGroup(std::span(fields).subspan(i, 3));
  }

  // address, value, type
  void readGroup(std::span<const Field> group) {
    const std::optional<PmcAddress> address = pmcAddress(group[0].text);
    const Type* type = typeOf(group[2].text);
    const text::WrittenNumber value = text::writtenNumber(group[1].text);
    if (!isName(group[0].text) || (address && address->pmc != 1))
      return wrong(group[0].at,
                   fmt::format("found '{}', expected an address of PMC 1 or a symbol", inBrief(group[0].text)));
    if (type == nullptr || (address && address->bit.has_value() != (type->bits == 1)))
      return wrong(group[2].at, fmt::format("found '{}', expected {}", inBrief(group[2].text),
                                            !address       ? "BIT, BYTE, WORD, DWORD or LONG"
                                            : address->bit ? "BIT for a bit"
                                                           : "BYTE, WORD, DWORD or LONG for a byte address"));
    if (!text::fitsBits(value, type->bits))
      return wrong(group[1].at, fmt::format("found '{}', expected a whole number of {} bit{}", inBrief(group[1].text),
                                            type->bits, type->bits == 1 ? "" : "s"));
    const std::string name = address ? nameOf(*address) : written(group[0].text);
    text_ +=
        fmt::format("set {}{} {}\n", name, type->bits > 8 ? fmt::format(":{}", type->bits / 8) : "", group[1].text);
  }

  std::vector<Remark>& remarks_;
  std::string remark_;
  std::string text_;
  bool hasBegun_ = false;
  bool hasRemark_ = false;
};

} // namespace

Imported scenarioOfSignals(const Source& source) {
  Imported made;
  made.text =
      fmt::format("# Made by rungc import from {}: a signal operation file of the PMC simulator. It expects nothing\n"
                  "# yet: say what the program is to do, by `expect`.\n",
                  asShown(source.name));
  made.text += Reader(made.remarks).read(source.text);
  return made;
}

} // namespace rung::imported

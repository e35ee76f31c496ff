// See lines.h and imported.h.
#include "tools/imported/lines.h"

#include <algorithm>

#include <fmt/format.h>

#include "ir/support/utf8.h"
#include "rtlib/text/blanks.h"
#include "rtlib/text/controls.h"
#include "rtlib/text/end_of_file.h"
#include "rtlib/text/utf8.h"
#include "tools/imported/imported.h"

namespace rung::imported {
namespace {

// Takes a field in quotes, whose first quote is at `at`; `at` is then the comma after it, or the end of the line.
std::string takeQuoted(std::string_view line, size_t& at) {
  std::string text;
  for (++at; at < line.size(); ++at) {
    if (line[at] == '"' && line.substr(at, 2) != "\"\"") break;
    if (line[at] == '"') ++at;
    text += line[at];
  }
  at = std::min(line.find(',', at), line.size());
  return std::string(text::trimmed(text));
}

std::string takePlain(std::string_view line, size_t& at) {
  const size_t end = std::min(line.find(',', at), line.size());
  const std::string_view text = text::trimmed(line.substr(at, end - at));
  at = end;
  return std::string(text);
}

} // namespace

std::string textOf(const Source& source, const Remark& remark) {
  return fmt::format("{}:{}:{}: {}: {}", source.name, remark.at.line, remark.at.column, remark.wrong ? "error" : "note",
                     remark.text);
}

bool Imported::isUsable() const { return std::ranges::none_of(remarks, &Remark::wrong); }

std::vector<Line> linesOf(std::string_view text) {
  std::vector<Line> lines;
  text = text::upToEndOfFile(text);
  for (uint32_t number = 1; !text.empty(); ++number) {
    const size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    if (line.ends_with('\r')) line.remove_suffix(1);
    lines.push_back({line, number});
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

bool isBlank(const Line& line) { return text::trimmed(line.text).empty(); }

text::Position positionOf(const Line& line, size_t offset) {
  return {.line = line.number, .column = static_cast<uint32_t>(countCodePoints(line.text.substr(0, offset)) + 1)};
}

std::vector<Field> fieldsOf(const Line& line) {
  std::vector<Field> fields;
  for (size_t at = 0;; ++at) {
    const size_t first = std::min(line.text.find_first_not_of(" \t\r", at), line.text.size());
    const bool isQuoted = first < line.text.size() && line.text[first] == '"';
    const text::Position place = positionOf(line, first);
    if (isQuoted) at = first;
    std::string text = isQuoted ? takeQuoted(line.text, at) : takePlain(line.text, at);
    fields.push_back({std::move(text), place});
    if (at >= line.text.size()) return fields;
  }
}

std::string nameOf(const PmcAddress& address) {
  const std::string bit = address.bit ? fmt::format(".{}", *address.bit) : "";
  return fmt::format("{}{}{}", address.area, address.number, bit);
}

std::string asShown(std::string_view text) { return text::withoutControls(text::trimmed(text)); }

std::string inBrief(std::string_view text) {
  constexpr size_t kMost = 80;
  const std::string_view trimmed = text::trimmed(text);
  if (trimmed.size() <= kMost) return asShown(trimmed);
  return asShown(text::wholeCharacters(trimmed, kMost)) + "...";
}

} // namespace rung::imported

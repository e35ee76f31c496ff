// See sections.h.
#include "frontend/dialects/fanuc/read/sections.h"

#include <algorithm>

#include "frontend/syntax/page.h"
#include "ir/support/utf8.h"
#include "rtlib/text/blanks.h"
#include "rtlib/text/letters.h"

namespace rung::frontend::fanuc {
namespace {

using Kind = Section::Kind;

struct Code {
  std::string_view text;
  Kind kind;
};
// Sections with variable symbols have the same lines.
constexpr Code kCodes[] = {
    {kParametersCode, Kind::Parameters},
    {kTitleCode, Kind::Title},
    {"%@2", Kind::Symbols},
    {"%@2-A", Kind::Symbols},
    {"%@2-B", Kind::Symbols},
    {"%@2-C", Kind::Symbols},
    {"%@2-C2", Kind::Symbols},
    {"%@2-D", Kind::Symbols},
    {"%@2-E", Kind::SymbolTable},
    {"%@3", Kind::Ladder},
    {"%@3-D", Kind::Ladder},
    {"%@4", Kind::Messages},
    {"%@5", Kind::Modules},
    {"%@7", Kind::Modules},
};

Kind kindOf(std::string_view line) {
  const std::string_view code = line.substr(0, line.find_first_of("( \t"));
  const auto* const found = std::ranges::find(kCodes, code, &Code::text);
  return found == std::end(kCodes) ? Kind::Unknown : found->kind;
}

class SectionFinder {
public:
  void line(const SourceLine& line) {
    const std::string_view text = text::trimmed(line.text);
    if (text == "%") return end(line.number, true);
    const size_t at = static_cast<size_t>(text.data() - line.text.data());
    const SourceRange range = line.range(at, at + text.size());
    if (!text.starts_with("%@")) return otherLine(text, range, line.number);
    end(line.number, false);
    const std::string code = text::upper(text);
    sawCode_ = true;
    isOutside_ = false;
    const bool begins = code.starts_with("%@A"), ends = code.starts_with("%@E");
    sections_.begins |= begins;
    sections_.ends |= ends;
    if (begins || ends) return;
    sections_.list.push_back({.kind = kindOf(code), .code = text, .range = range, .first = line.number + 1, .last = 0});
    open_ = true;
  }

  FileSections take(uint32_t lines) {
    end(lines + 1, false);
    if (!sawCode_) sections_.list.push_back({.kind = Kind::Ladder, .first = 1, .last = lines + 1});
    return std::move(sections_);
  }

private:
  // Text outside begins at a line that is not a comment, and ends where the next section begins.
  void otherLine(std::string_view text, SourceRange range, uint32_t number) {
    if (open_ || !sawCode_ || isOutside_ || text.empty() || text[0] == ';') return;
    isOutside_ = true;
    sections_.list.push_back({.kind = Kind::Outside, .range = range, .first = number, .last = number + 1});
  }
  void end(uint32_t line, bool isClosed) {
    if (open_) sections_.list.back().last = line;
    if (open_) sections_.list.back().isClosed = isClosed;
    open_ = false;
  }

  FileSections sections_;
  bool open_ = false;
  bool sawCode_ = false;
  bool isOutside_ = false; // the text since the last section has been noted
};

} // namespace

FileSections sectionsOf(const SourceManager& sources, FileId file) {
  SectionFinder finder;
  const uint32_t lines = sources.lineCount(file);
  for (uint32_t number = 1; number <= lines; ++number) finder.line(lineOf(sources, file, number));
  return finder.take(lines);
}

SourceLine lineOf(const SourceManager& sources, FileId file, uint32_t number) {
  std::string_view text = sources.lineText(file, number);
  const auto offset = static_cast<size_t>(text.data() - sources.text(file).data());
  const size_t mark = number == 1 && text.starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0;
  text.remove_prefix(mark);
  return {number, withoutTrailingSpace(text), sources.position(file, offset + mark)};
}

} // namespace rung::frontend::fanuc

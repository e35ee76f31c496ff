// See manual_lines.h.
#include "compiler/manual_lines.h"

#include <algorithm>
#include <vector>

#include "rtlib/text/blanks.h"
#include "rtlib/text/letters.h"

namespace rung::compiler {
namespace {

constexpr std::string_view kManual = "Manual: ";

bool namesLine(std::string_view clause) {
  for (size_t at = clause.find("l."); at != std::string_view::npos; at = clause.find("l.", at + 1))
    if (at + 2 < clause.size() && text::isDigit(clause[at + 2]) && (at == 0 || !text::isLetter(clause[at - 1])))
      return true;
  return false;
}

bool isNumbers(std::string_view clause) {
  return !clause.empty() && std::ranges::all_of(clause, [](char c) { return text::isDigit(c) || c == '-'; });
}

bool isProposal(std::string_view clause) { return clause.starts_with('P') && isNumbers(clause.substr(1)); }

// Parts between commas and semicolons, without those that name a line; 3022 in "l.363, 3022" is one, too.
std::string otherParts(std::string_view parts) {
  std::string kept;
  bool dropped = false;
  while (!parts.empty()) {
    const size_t end = std::min(parts.find_first_of(",;"), parts.size());
    const std::string_view part = text::trimmed(parts.substr(0, end));
    dropped = namesLine(part) || isProposal(part) || (dropped && isNumbers(part));
    if (!dropped) kept += parts.substr(0, end);
    const size_t next = std::min(end + 1, parts.size());
    if (!dropped) kept += parts.substr(end, next - end);
    parts.remove_prefix(next);
  }
  kept.resize(kept.find_last_not_of(" ,;") + 1);
  return kept;
}

// Of a line from "Manual: 5.19, l.1921." on: "Manual: 5.19."
std::string chapterOnly(std::string_view text) {
  const size_t end = std::min(text.find(". "), text.size() - 1);
  const std::string chapter = otherParts(text.substr(kManual.size(), end - kManual.size()));
  const std::string_view rest = text.substr(std::min(end + 2, text.size()));
  return (chapter.empty() ? std::string() : std::string(kManual) + chapter + (rest.empty() ? "." : ". ")) +
         std::string(rest);
}

// The brackets that begin at `open` end here.
void closeBracket(size_t open, std::string& out) {
  const std::string inner = out.substr(open + 1);
  const std::string kept = otherParts(inner);
  out.resize(open + 1);
  if (kept.empty() && !text::trimmed(inner).empty()) {
    out.pop_back();
    if (out.ends_with(' ')) out.pop_back();
  } else {
    out += (!kept.empty() && kept.size() < inner.size() ? kept : inner) + ")";
  }
}

std::string withoutBracketed(std::string_view line) {
  std::string out;
  std::vector<size_t> open;
  for (const char c : line) {
    if (c == '(') open.push_back(out.size());
    if (c != ')' || open.empty()) {
      out += c;
      continue;
    }
    closeBracket(open.back(), out);
    open.pop_back();
  }
  return out;
}

std::string withoutLines(std::string_view line) {
  const size_t manual = line.find(kManual);
  if (manual == std::string_view::npos) return withoutBracketed(line);
  std::string kept = withoutBracketed(line.substr(0, manual)) + chapterOnly(line.substr(manual));
  kept.resize(kept.find_last_not_of(' ') + 1);
  return kept;
}

} // namespace

std::string withoutManualLines(std::string_view markdown) {
  std::string out;
  bool fenced = false;
  while (!markdown.empty()) {
    const size_t end = std::min(markdown.find('\n'), markdown.size());
    const std::string_view line = markdown.substr(0, end);
    if (line.starts_with("```")) fenced = !fenced;
    const std::string kept = fenced ? std::string(line) : withoutLines(line);
    if (!kept.empty() || line.empty()) out.append(kept).append(markdown.substr(end, 1));
    markdown.remove_prefix(std::min(end + 1, markdown.size()));
  }
  return out;
}

} // namespace rung::compiler

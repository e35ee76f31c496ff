// Diagnostics as text: the position, the message, and the source line with the range underlined.
#include "ir/support/diag_render.h"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>

#include "ir/support/utf8.h"
#include "rtlib/text/controls.h"
#include "rtlib/text/utf8.h"

namespace rung {
namespace {

constexpr std::string_view kRed = "\x1b[1;31m";
constexpr std::string_view kYellow = "\x1b[1;33m";
constexpr std::string_view kBlue = "\x1b[1;34m";
constexpr std::string_view kBold = "\x1b[1m";
constexpr std::string_view kReset = "\x1b[0m";

/// The part of a line that is shown, in bytes.
struct Window {
  size_t begin = 0;
  size_t end = 0;
};

/// Moves an offset within a character back to its beginning.
size_t characterStart(std::string_view line, size_t offset) {
  while (offset > 0 && offset < line.size() && text::isUtf8Continuation(line[offset])) --offset;
  return offset;
}

/// About `width` bytes around the mark; the rest of the line is never read.
Window clip(std::string_view line, size_t mark, size_t width) {
  if (line.size() <= width) return {0, line.size()};
  const size_t before = std::min(mark, width / 2);
  const size_t begin = characterStart(line, std::min(mark - before, line.size() - width));
  return {begin, characterStart(line, std::min(line.size(), begin + width))};
}

/// Appends a character in a form that a terminal can show, and returns its width in columns.
unsigned appendShown(std::string& out, std::string_view line, size_t& offset) {
  const CodePoint character = decodeUtf8(line, offset);
  const std::string_view bytes = line.substr(offset, character.length);
  offset += character.length;
  if (character.valid && character.value == '\t') {
    out += ' ';
    return 1;
  }
  if (!character.valid || character.value < 0x20 || (character.value >= 0x7F && character.value < 0xA0)) {
    out += "\uFFFD";
    return 1;
  }
  out += bytes;
  return displayWidth(character.value);
}

/// Texts quoted from a source may contain anything; a terminal must not interpret it.
std::string printable(std::string_view text) {
  std::string out;
  for (size_t at = 0; at < text.size();) appendShown(out, text, at);
  return out;
}

class TextRenderer {
public:
  TextRenderer(const SourceManager& sources, RenderOptions options) : sources_(sources), options_(options) {}

  void diagnostic(const Diagnostic& d) {
    const bool isError = d.severity == Severity::Error;
    const std::string_view color = isError ? kRed : kYellow;
    place(d.range);
    paint(color, isError ? "error: " : "warning: ");
    paint(kBold, printable(messageOf(d)));
    out_ += fmt::format(" [{}]\n", diagInfo(d.id).code);
    snippet(d.range, '^', color, "");
    for (const DiagNote& label : d.labels) snippet(label.range, '-', kBlue, label.text);
    for (const DiagNote& note : d.notes) {
      place(note.range);
      paint(kBlue, "note: ");
      out_ += printable(note.text) + "\n";
      snippet(note.range, '^', kBlue, "");
    }
    // The fixes of one report belong together: the later ones do the same at other positions.
    if (!d.fixes.empty() && !d.fixes.front().noted) help(d.fixes.front());
  }

  void dropped(size_t count) {
    if (count != 0) out_ += fmt::format("({} more diagnostics are not shown)\n", count);
  }

  std::string take() { return std::move(out_); }

private:
  void paint(std::string_view color, std::string_view text) {
    if (options_.color) out_ += color;
    out_ += text;
    if (options_.color) out_ += kReset;
  }

  void place(SourceRange range) {
    if (!range.valid()) return;
    const LineCol at = sources_.lineCol(range.begin);
    paint(kBold, fmt::format("{}:{}:{}: ", text::withoutControls(at.file), at.line, at.column));
  }

  /// The first line of the range, underlined as far as the range and the window reach.
  void snippet(SourceRange range, char mark, std::string_view color, std::string_view text) {
    if (!range.valid()) return;
    const SourceManager::LineStart start = sources_.lineStart(range.begin);
    const std::string_view line = sources_.lineText(start.file, start.line);
    const size_t first = std::min(sources_.offsetOf(range.begin) - start.offset, line.size());
    const size_t length = range.end > range.begin ? range.end.value - range.begin.value : 0;
    const size_t last = std::min(first + length, line.size());
    const Window window = clip(line, first, options_.width);

    std::string shown = window.begin > 0 ? "..." : "";
    std::string under(shown.size(), ' ');
    std::string marks;
    for (size_t at = window.begin; at < window.end;) {
      const bool inside = at >= first && at < last;
      const bool before = at < first;
      const unsigned cells = appendShown(shown, line, at);
      if (before) under.append(cells, ' ');
      if (inside) marks.append(cells, mark);
    }
    if (window.end < line.size()) shown += "...";
    if (marks.empty()) marks = mark;
    if (mark == '^') std::replace(marks.begin() + 1, marks.end(), '^', '~');
    out_ += fmt::format("{:>5} | {}\n      | {}", start.line, shown, under);
    paint(color, text.empty() ? marks : fmt::format("{} {}", marks, printable(text)));
    out_ += '\n';
  }

  void help(const DiagFix& fix) {
    out_ += "      = ";
    paint(kBlue, "help: ");
    const std::string_view old = fix.range.valid() ? sources_.text(fix.range) : std::string_view();
    const std::string shownOld = shown(old);
    const std::string shownNew = shown(withoutPadding(fix.replacement));
    if (old.empty()) {
      out_ += fmt::format("insert '{}'\n", shownNew);
    } else if (fix.replacement.empty()) {
      out_ += fmt::format("remove '{}'\n", shownOld);
    } else {
      out_ += fmt::format("write '{}' instead of '{}'\n", shownNew, shownOld);
    }
  }

  /// Removes the blanks before a closing bracket that keep the columns of a drawing.
  static std::string withoutPadding(std::string text) {
    if (text.empty() || std::string_view("])}").find(text.back()) == std::string_view::npos) return text;
    const size_t end = text.find_last_not_of(' ', text.size() - 2) + 1;
    return text.erase(end, text.size() - 1 - end);
  }

  /// A text from the source, limited to the length of a line.
  std::string shown(std::string_view text) const {
    const Window window = clip(text, 0, options_.width);
    return printable(text.substr(0, window.end)) + (window.end < text.size() ? "..." : "");
  }

  const SourceManager& sources_;
  RenderOptions options_;
  std::string out_;
};

} // namespace

std::string renderText(const Diagnostics& diagnostics, const SourceManager& sources, RenderOptions options) {
  TextRenderer renderer(sources, options);
  for (const Diagnostic* d : diagnostics.sorted())
    if (options.warnings || d->severity == Severity::Error) renderer.diagnostic(*d);
  renderer.dropped(diagnostics.droppedCount());
  return renderer.take();
}

namespace {

std::string counted(size_t count, std::string_view what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

} // namespace

std::string closingLine(const Diagnostics& diagnostics) {
  const std::vector<const Diagnostic*> sorted = diagnostics.sorted();
  const auto first = std::ranges::find(sorted, Severity::Error, &Diagnostic::severity);
  if (first == sorted.end()) return "";
  std::string text = counted(diagnostics.errorCount(), "error");
  if (diagnostics.warningCount() > 0) text += ", " + counted(diagnostics.warningCount(), "warning");
  return fmt::format("{}; try `rungc explain {}`\n", text, diagInfo((*first)->id).code);
}

} // namespace rung

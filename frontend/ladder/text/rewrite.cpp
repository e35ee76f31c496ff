// See rewrite.h.
#include "frontend/ladder/text/rewrite.h"

#include <algorithm>
#include <deque>
#include <optional>
#include <span>
#include <utility>

#include "frontend/ladder/text/drawing.h"

namespace rung::frontend::ladder {
namespace {

class Rewriter {
public:
  Rewriter(const SourceManager& sources, FileId file, FindBox findBox, std::vector<Change> words)
      : sources_(sources), file_(file), findBox_(findBox), words_(std::move(words)) {}

  std::vector<Change> run() {
    Diagnostics discarded;
    const LadderFile ladder = parseLadder(sources_, file_, discarded, findBox_);
    for (const Rung& rung : ladder.rungs) {
      take(rung.range.begin);
      const auto end = std::ranges::find_if(words_.begin() + static_cast<std::ptrdiff_t>(next_), words_.end(),
                                            [&](const Change& word) { return word.range.begin >= rung.range.end; });
      const auto count = static_cast<size_t>(end - words_.begin()) - next_;
      if (count != 0 && !rung.bad && draw(rung, std::span(words_).subspan(next_, count))) next_ += count;
    }
    take({UINT32_MAX});
    return std::move(changes_);
  }

private:
  // Words before the position, as they are.
  void take(SourcePos end) {
    for (; next_ < words_.size() && words_[next_].range.begin < end; ++next_) changes_.push_back(words_[next_]);
  }

  bool draw(const Rung& rung, std::span<const Change> words) {
    Drawing drawing = readDrawing(sources_, file_, rung, findBox_);
    std::deque<std::string> texts; // which the words of the drawing refer to
    for (Word& operand : drawing.operands) replaceIn(operand, words, texts);
    const std::optional<std::vector<std::string>> lines = layOut(drawing);
    if (!lines || texts.size() != words.size()) return false;
    for (size_t i = 0; i < lines->size(); ++i) {
      const DrawnLine& drawn = drawing.lines[i];
      const SourceRange before = drawn.source.range(0, drawing.tokensOf(drawn).back().end);
      if (sources_.text(before) != (*lines)[i]) changes_.push_back({before, (*lines)[i]});
    }
    return true;
  }

  // From the last one, so that the places before it stay valid.
  static void replaceIn(Word& operand, std::span<const Change> words, std::deque<std::string>& texts) {
    std::string text(operand.text);
    bool changed = false;
    for (auto word = words.rbegin(); word != words.rend(); ++word) {
      if (word->range.begin < operand.range.begin || word->range.end > operand.range.end) continue;
      const size_t at = word->range.begin.value - operand.range.begin.value;
      text.replace(at, word->range.end.value - word->range.begin.value, word->text);
      changed = true;
      texts.emplace_back();
    }
    if (!changed) return;
    texts.back() = std::move(text);
    operand.text = texts.back();
  }

  const SourceManager& sources_;
  const FileId file_;
  const FindBox findBox_;
  const std::vector<Change> words_;
  size_t next_ = 0;
  std::vector<Change> changes_;
};

} // namespace

std::vector<Change> withDrawings(const SourceManager& sources, FileId file, FindBox findBox,
                                 std::vector<Change> words) {
  return Rewriter(sources, file, findBox, std::move(words)).run();
}

} // namespace rung::frontend::ladder

// See format.h.
#include "frontend/dialects/fanuc/format.h"

#include <algorithm>

#include <fmt/format.h>

#include "frontend/dialects/fanuc/read/mnemonic.h"
#include "frontend/dialects/fanuc/read/sections.h"
#include "frontend/syntax/page.h"
#include "rtlib/text/blanks.h"
#include "rtlib/text/letters.h"

namespace rung::frontend::fanuc {
namespace {

class Formatter {
public:
  Formatter(const network::Language& language, const SourceManager& sources, FileId file)
      : language_(language), page_(sources.text(file), kCommentColumn) {}

  void ladderLine(const SourceLine& line) {
    const bool begins = !inComment_ && text::trimmed(line.text).starts_with("(*");
    if (begins || inComment_) {
      inComment_ = line.text.find("*)") == std::string_view::npos;
      return page_.line(std::string(withoutTrailingSpace(line.text)));
    }
    splitWords(line, kMnemonicRules, words_);
    const std::string_view comment =
        words_.hasComment ? line.text.substr(words_.commentRange.begin.value - line.begin.value) : std::string_view();
    if (!words_.words.empty()) return page_.line(statement(), comment);
    if (words_.hasComment) return page_.comment(std::string(comment));
    page_.blank();
  }
  void otherLine(const SourceLine& line) { page_.line(std::string(withoutTrailingSpace(line.text))); }
  std::string take() { return page_.take(); }

private:
  // A command or a function in capitals, with its operands after it, and the SP after a name; anything else with single
  // blanks.
  std::string statement() const {
    std::string text;
    size_t first = 0;
    if (isNetworkNumber(words_.words[0].text)) text = std::string(words_.words[first++].text);
    for (size_t i = first; i < words_.words.size(); ++i) {
      const std::string_view word = words_.words[i].text;
      const bool isName = i == first && (isCommand(word) || language_.findFunction(word) != nullptr);
      if (!text.empty()) text += ' ';
      const bool isSp = i == first + 1 && i + 1 == words_.words.size() && text::equalsIgnoringCase(word, "SP");
      if (isName && i + 1 < words_.words.size())
        text += fmt::format("{:<{}}", text::upper(word), kOperandColumn - 1);
      else
        text += isName || isSp ? text::upper(word) : std::string(word);
    }
    return text;
  }

  const network::Language& language_;
  Page page_;
  LineWords words_;
  bool inComment_ = false; // of a network, over lines
};

} // namespace

std::optional<std::string> formatMnemonic(const network::Language& language, SourceManager& sources, FileId file,
                                          Diagnostics& diagnostics) {
  if (sources.undecoded(file) || sources.text(file).find('\0') != std::string_view::npos)
    if (!checkEncoding(sources, file, diagnostics)) return std::nullopt;
  Formatter formatter(language, sources, file);
  std::vector<bool> isLadder(sources.lineCount(file) + 2, false);
  for (const Section& section : sectionsOf(sources, file).list)
    if (section.kind == Section::Kind::Ladder)
      std::fill(isLadder.begin() + section.first, isLadder.begin() + std::min<size_t>(section.last, isLadder.size()),
                true);
  for (uint32_t number = 1; number <= sources.lineCount(file); ++number) {
    const SourceLine line = lineOf(sources, file, number);
    isLadder[number] ? formatter.ladderLine(line) : formatter.otherLine(line);
  }
  return formatter.take();
}

} // namespace rung::frontend::fanuc

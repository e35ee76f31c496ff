// Statements of ladder text that hold what a mnemonic file has in sections.
#pragma once
#include <string_view>

#include "frontend/syntax/word_lexer.h"
#include "ir/support/source.h"

namespace rung::frontend::fanuc {

// Whether the file is ladder text. A mnemonic file may name its dialect, too: text before the first section is a
// comment.
bool isLadderText(const SourceManager& sources, FileId file);

// Calls take(name, text) for each statement `KEYWORD NAME "text"` of ladder text. Others are reported by its parser.
template <class Take>
void eachStatement(const SourceManager& sources, FileId file, std::string_view keyword, Take take) {
  LineReader lines(sources, file);
  LineWords words;
  for (SourceLine line; lines.next(line);) {
    if (line.text.find(keyword) == std::string_view::npos) continue;
    splitWords(line, {}, words);
    if (words.words.size() != 3 || words.words[0].text != keyword || !words.words[2].quoted) continue;
    take(words.words[1], words.words[2]);
  }
}

} // namespace rung::frontend::fanuc
